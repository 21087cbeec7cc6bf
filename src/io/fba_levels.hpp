// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// What the coder and the decoder of the face animation bitstream must do alike: which numbers of a frame are coded, how
// they are quantised, within which limits.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "io/fba_bits.hpp"

#include "mien/fap.hpp"

namespace mien::fba {

/// The numbers that a frame may code, in the order of coding: 3 of the viseme, 4 of the expression, then FAPs 3 to 68.
inline constexpr std::size_t first_expression_channel = 3, first_fap_channel = 7;
inline constexpr std::size_t channel_count = first_fap_channel + fap_count - 2;

template <class T>
using PerChannel = std::array<T, channel_count>;

constexpr std::size_t fap_of_channel(std::size_t channel) {
    return channel < first_expression_channel ? 0 : channel < first_fap_channel ? 1 : channel - first_fap_channel + 2;
}

/// The frame's numbers; 0 where nothing is sent.
PerChannel<std::int64_t> numbers_of(const FapFrame& frame);

/// Writes the numbers into the frame, by its mask.
void set_numbers(FapFrame& frame, const PerChannel<std::int64_t>& numbers);

/// What a channel holds: selects are never quantised, blends and intensities by the quantiser alone.
enum class ChannelKind { select, strength, fap };
ChannelKind kind_of(std::size_t channel);

/// Distance of two levels, in units of the number.
std::int64_t step_of(std::size_t channel, int quant);

/// The nearest level; halves go away from zero, but a whole half step still to zero.
std::int64_t level_of(std::int64_t number, std::int64_t step);

/// From the level back, on top of what is predicted.
std::int64_t rebuilt(std::size_t channel, std::int64_t predicted, std::int64_t level, std::int64_t step);

/// A limit is sent as 5 bits that stand for sixties of the step of the table; the coarser the quantiser, the fewer
/// levels it leaves.
inline constexpr int limit_unit = 60, most_limit = 31;
int levels_in(int limit, int quant);
/// The smallest limit that leaves room for a level (not negative); more than most_limit when none does.
int limit_for(std::int64_t level, int quant);

/// The limits that one intra plane sends, as they are sent: for FAPs 3 to 68, by channel.
struct Limits {
    PerChannel<std::uint8_t> intra_high{}, intra_low{}, inter_high{}, inter_low{};
};

/// The limits of the standard's table, which hold for parameters whose limits a plane does not send.
Limits standard_limits();

/// What can be coded in a channel: the alphabets of its two models.
Model intra_model(std::size_t channel, const Limits& limits, int quant);
Model inter_model(std::size_t channel, const Limits& limits, int quant);

}  // namespace mien::fba
