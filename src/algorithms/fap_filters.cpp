// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// What an editor does to streams of face animation parameters. A stream may leave values to its decoder (they hold, or
// come from the other side of the face), which filters that only move frames keep; those that mix streams first say
// them outright.

#include "mien/algorithms/fap_filters.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <string>

#include "mien/algorithms/resolve_faps.hpp"
#include "mien/error.hpp"

namespace mien {

namespace {

constexpr double most_frames = 4e6;  // that a filter makes: 44 hours at 25 a second, 1.3 GB
constexpr double most_number = 2e9;

void expect_frames(const FapStream& stream, std::string_view what) {
    if (stream.frames.empty()) throw Error(fmt::format("{}: expected a stream with frames, found none", what));
}

std::int32_t rounded(double value) {
    return static_cast<std::int32_t>(std::lround(std::clamp(value, -most_number, most_number)));
}

double time_of(const FapStream& stream, const FapFrame& frame) {
    return frame.number / stream.rate;
}

FapStream without_frames(const FapStream& stream) {
    return {stream.version, stream.name, stream.rate, {}};
}

}  // namespace

FapStream mirrored(const FapStream& stream) {
    FapStream result = stream;
    for (std::size_t f = 0; f < stream.frames.size(); ++f)
        for (std::size_t i = 2; i < fap_count; ++i) {
            const std::size_t other = fap_index(faps[i].mirror);
            result.frames[f].mask[other] = stream.frames[f].mask[i];
            result.frames[f].value[other] = faps[i].mirror_sign * stream.frames[f].value[i];
        }
    return result;
}

FapFrame frame_at(const FapStream& stream, double time) {
    expect_frames(stream, "frame of a stream");
    const auto after = std::upper_bound(stream.frames.begin(), stream.frames.end(), time,
                                        [&](double t, const FapFrame& frame) { return t < time_of(stream, frame); });
    const FapFrame& a = after == stream.frames.begin() ? *after : *std::prev(after);
    const FapFrame& b = after == stream.frames.end() ? a : *after;
    const double span = time_of(stream, b) - time_of(stream, a);
    const double share = span > 0 ? std::clamp((time - time_of(stream, a)) / span, 0.0, 1.0) : 0;
    FapFrame frame = share <= 0.5 ? a : b;
    frame.number = 0;
    for (std::size_t i = 2; i < fap_count; ++i)
        if (a.mask[i] && b.mask[i]) frame.value[i] = rounded((1 - share) * a.value[i] + share * b.value[i]);
    return frame;
}

FapStream retimed(const FapStream& stream, const RetimeOptions& options) {
    expect_frames(stream, "retime");
    if (!(options.speed > 0) || !std::isfinite(options.speed))
        throw Error(fmt::format("retime: expected a speed above 0, found {}", options.speed));
    if (!(options.rate >= 0) || !std::isfinite(options.rate))
        throw Error(fmt::format("retime: expected a rate from 0, found {}", options.rate));
    FapStream result = without_frames(stream);
    if (options.rate > 0) result.rate = options.rate;
    constexpr double slack = 1e-6;  // of a frame: what dividing by rates loses
    const double numbers = result.rate / options.speed;
    const double first = std::ceil(time_of(stream, stream.frames.front()) * numbers - slack);
    const double last = std::floor(time_of(stream, stream.frames.back()) * numbers + slack);
    if (!(last < most_frames)) throw Error(fmt::format("retime: expected at most 4e6 frames, found {}", last));
    const auto begin = static_cast<std::uint32_t>(first), end = static_cast<std::uint32_t>(std::max(first, last));
    for (std::uint32_t number = begin; number <= end; ++number) {
        result.frames.push_back(frame_at(stream, number / numbers));
        result.frames.back().number = number;
    }
    return result;
}

std::vector<int> part_faps(std::string_view part) {
    Take points;  // without rows: the points that parameters move
    for (const Fap& fap : faps)
        if (!fap.point.empty() && !find_column(points, fap.point)) points.points.emplace_back(fap.point);
    std::vector<std::string> ids;
    const auto named = std::find_if(faps.begin(), faps.end(), [&](const Fap& fap) { return fap.name == part; });
    if (named != faps.end()) return {static_cast<int>(named - faps.begin()) + 1};
    for (const std::size_t column : part_columns(points, part == "head" ? "7.1" : part))
        ids.push_back(points.points[column]);
    std::vector<int> numbers;
    for (int fap = 3; fap <= static_cast<int>(fap_count); ++fap)
        if (std::find(ids.begin(), ids.end(), fap_info(fap).point) != ids.end()) numbers.push_back(fap);
    return numbers;
}

FapStream scaled(const FapStream& stream, std::span<const PartStrength> strengths) {
    std::array<double, fap_count> factor{};
    factor.fill(1);
    for (const PartStrength& part : strengths) {
        if (!std::isfinite(part.strength))
            throw Error(fmt::format("strength of {}: expected a finite number, found {}", part.part, part.strength));
        for (const int fap : part_faps(part.part)) factor[fap_index(fap)] = part.strength;
    }
    FapStream result = stream;
    for (FapFrame& frame : result.frames)
        for (std::size_t i = 2; i < fap_count; ++i) frame.value[i] = rounded(factor[i] * frame.value[i]);
    return result;
}

namespace {

FapMask all_sent(const FapStream& stream) {
    FapMask mask;
    for (const FapFrame& frame : stream.frames) mask |= frame.mask;
    return mask;
}

}  // namespace

FapStream concatenated(std::span<const FapStream> streams) {
    if (streams.empty()) throw Error("concatenate: expected streams, found none");
    for (const FapStream& stream : streams) expect_frames(stream, "concatenate");
    FapStream result = without_frames(streams.front());
    FapMask moved;  // by the streams so far
    for (const FapStream& next : streams) {
        FapStream stream = resolve_faps(next);
        if (stream.rate != result.rate) stream = retimed(stream, {.speed = 1, .rate = result.rate});
        const std::uint32_t from = stream.frames.front().number;
        const std::uint64_t start = result.frames.empty() ? from : std::uint64_t{result.frames.back().number} + 1;
        for (FapFrame& frame : stream.frames) {
            const std::uint64_t number = start + (frame.number - from);
            if (!(static_cast<double>(number) < most_number))
                throw Error(fmt::format("concatenate: expected a frame number below 2e9, found {}", number));
            frame.number = static_cast<std::uint32_t>(number);
            frame.mask |= moved;
            result.frames.push_back(frame);
        }
        moved |= all_sent(stream);
    }
    return result;
}

FapStream blended(const FapStream& a, const FapStream& b, double share) {
    expect_frames(a, "blend");
    expect_frames(b, "blend");
    if (!std::isfinite(share)) throw Error(fmt::format("blend: expected a share that is finite, found {}", share));
    const FapStream first = resolve_faps(a), second = resolve_faps(b);
    FapStream result = without_frames(a);
    const double last = std::max(time_of(a, a.frames.back()), time_of(b, b.frames.back())) * a.rate;
    if (!(last < most_frames)) throw Error(fmt::format("blend: expected at most 4e6 frames, found {}", last));
    for (std::uint32_t number = 0; number <= std::floor(last + 1e-6); ++number) {
        const FapFrame x = frame_at(first, number / a.rate), y = frame_at(second, number / a.rate);
        FapFrame& frame = result.frames.emplace_back();
        frame.number = number;
        frame.mask = x.mask | y.mask;
        for (std::size_t i = 2; i < fap_count; ++i)
            frame.value[i] = rounded((1 - share) * x.value[i] + share * y.value[i]);
    }
    return result;
}

namespace {

FapStatistics statistics_of(const FapStream& stream, int number) {
    const Fap& fap = fap_info(number);
    const std::size_t i = fap_index(number);
    FapStatistics result{.fap = number};
    double sum = 0, squares = 0;
    for (const FapFrame& frame : stream.frames) {
        if (!frame.mask[i]) continue;
        const std::int32_t value = frame.value[i];
        result.low = result.frames == 0 ? value : std::min(result.low, value);
        result.high = result.frames == 0 ? value : std::max(result.high, value);
        ++result.frames;
        sum += value;
        squares += static_cast<double>(value) * value;
        const bool negative = fap.unidirectional && value < 0;
        result.negative += negative ? 1 : 0;
        const double level = static_cast<double>(value) / fap.quant_step;
        result.outside += !negative && (level < fap.intra.low || level > fap.intra.high) ? 1 : 0;
    }
    if (result.frames == 0) return result;
    const auto count = static_cast<double>(result.frames);
    result.mean = sum / count;
    result.deviation = std::sqrt(std::max(0.0, squares / count - result.mean * result.mean));
    return result;
}

}  // namespace

std::vector<FapStatistics> statistics(const FapStream& stream) {
    std::vector<FapStatistics> rows;
    for (int fap = 3; fap <= static_cast<int>(fap_count); ++fap)
        if (const FapStatistics row = statistics_of(stream, fap); row.frames > 0) rows.push_back(row);
    return rows;
}

}  // namespace mien
