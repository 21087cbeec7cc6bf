// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "io/fba_levels.hpp"

#include <algorithm>
#include <cstdlib>

namespace mien::fba {

PerChannel<std::int64_t> numbers_of(const FapFrame& frame) {
    const Viseme& v = frame.viseme;
    const Expression& e = frame.expression;
    PerChannel<std::int64_t> numbers{};
    if (frame.mask[0]) numbers = {v.select1, v.select2, v.blend};
    if (frame.mask[1])
        std::copy_n(std::array<std::int64_t, 4>{e.select1, e.intensity1, e.select2, e.intensity2}.begin(), 4,
                    numbers.begin() + first_expression_channel);
    for (std::size_t c = first_fap_channel; c < channel_count; ++c)
        if (const std::size_t i = fap_of_channel(c); frame.mask[i]) numbers[c] = frame.value[i];
    return numbers;
}

void set_numbers(FapFrame& frame, const PerChannel<std::int64_t>& numbers) {
    const auto small = [&](std::size_t channel) { return static_cast<std::uint8_t>(numbers[channel]); };
    Viseme& v = frame.viseme;
    Expression& e = frame.expression;
    if (frame.mask[0]) v.select1 = small(0), v.select2 = small(1), v.blend = small(2);
    if (frame.mask[1]) e.select1 = small(3), e.intensity1 = small(4), e.select2 = small(5), e.intensity2 = small(6);
    for (std::size_t c = first_fap_channel; c < channel_count; ++c)
        if (const std::size_t i = fap_of_channel(c); frame.mask[i])
            frame.value[i] = static_cast<std::int32_t>(numbers[c]);
}

ChannelKind kind_of(std::size_t channel) {
    if (channel >= first_fap_channel) return ChannelKind::fap;
    return channel == 2 || channel == 4 || channel == 6 ? ChannelKind::strength : ChannelKind::select;
}

std::int64_t step_of(std::size_t channel, int quant) {
    const ChannelKind kind = kind_of(channel);
    if (kind == ChannelKind::select || quant == 0) return 1;
    return kind == ChannelKind::strength ? quant : std::int64_t{quant} * faps[fap_of_channel(channel)].quant_step;
}

std::int64_t level_of(std::int64_t number, std::int64_t step) {
    const std::int64_t size = std::abs(number);
    if (size <= step / 2) return 0;
    const std::int64_t level = (size + step / 2) / step;
    return number < 0 ? -level : level;
}

// The last level of a strength may lie above 63, which is its end.
std::int64_t rebuilt(std::size_t channel, std::int64_t predicted, std::int64_t level, std::int64_t step) {
    const std::int64_t number = predicted + level * step;
    return kind_of(channel) == ChannelKind::strength ? std::clamp<std::int64_t>(number, 0, 63) : number;
}

int levels_in(int limit, int quant) {
    return limit * limit_unit / std::max(quant, 1);
}

int limit_for(std::int64_t level, int quant) {
    const std::int64_t sixties = (level * std::max(quant, 1) + limit_unit - 1) / limit_unit;
    return static_cast<int>(std::min<std::int64_t>(sixties, most_limit + 1));
}

Limits standard_limits() {
    const auto sixties = [](int level) { return static_cast<std::uint8_t>(limit_for(level, 1)); };
    Limits limits;
    for (std::size_t c = first_fap_channel; c < channel_count; ++c) {
        const Fap& fap = faps[fap_of_channel(c)];
        limits.intra_high[c] = sixties(fap.intra.high);
        limits.intra_low[c] = sixties(-fap.intra.low);
        limits.inter_high[c] = sixties(fap.inter.high);
        limits.inter_low[c] = sixties(-fap.inter.low);
    }
    return limits;
}

namespace {

// The largest level of a channel whose limits are not sent.
int most_choice(std::size_t channel, int quant) {
    if (kind_of(channel) == ChannelKind::strength) return (63 + quant / 2) / std::max(quant, 1);
    return channel < first_expression_channel ? static_cast<int>(viseme_names.size()) - 1
                                              : static_cast<int>(expression_names.size()) - 1;
}

}  // namespace

Model intra_model(std::size_t channel, const Limits& limits, int quant) {
    if (channel < first_fap_channel) return {0, most_choice(channel, quant)};
    return {-levels_in(limits.intra_low[channel], quant), levels_in(limits.intra_high[channel], quant)};
}

Model inter_model(std::size_t channel, const Limits& limits, int quant) {
    if (channel < first_fap_channel) return {-most_choice(channel, quant), most_choice(channel, quant)};
    return {-levels_in(limits.inter_low[channel], quant), levels_in(limits.inter_high[channel], quant)};
}

}  // namespace mien::fba
