// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// What the text formats of takes share: one rule for lost samples, for times, and for numbers that are no coordinates.

#pragma once

#include <array>
#include <string>
#include <string_view>

#include "io/text.hpp"

#include "mien/take.hpp"

namespace mien {

/// Squares and single precision of numbers up to here stay finite; no unit of length makes a face larger.
inline constexpr double largest_coordinate = 1e15;

/// One sample from its cells. It is lost, all three coordinates, when one cell is empty or NaN, or when every cell is
/// an exact, unsigned zero, the habit of some capture systems. A planar sample has no z cell. Throws Error at anything
/// that is no number, infinite or larger than 1e15, naming line, point and axis.
Vec3 read_sample(const Lines& lines, std::string_view point, const std::array<std::string_view, 3>& cells, bool planar);

/// The cells of a sample, each behind `separator`, so that read_sample reads equal numbers: empty when lost; a sample
/// that is seen exactly at the origin begins with "-0".
void append_sample(std::string& text, const Vec3& sample, bool planar, char separator);

/// Begins a row at a time. A row at the time of the one before takes its place: coarse clocks stamp two rows alike, and
/// the later one is fresher. Throws Error unless the time is finite and does not go back.
void begin_row(const Lines& lines, std::string_view cell, Take& take);

/// Throws Error when the take has no row, or points but no sample that was seen.
void check_seen(const Take& take, std::string_view format);

/// Whether a name can stand in a line of text and be read back: not empty, no blanks at its ends, no tab, no end of a
/// line.
bool is_printable_name(std::string_view name);

/// Throws Error when the take's names cannot stand in a line of text: one holds a tab or the end of a line.
void check_printable(const Take& take, std::string_view format);

/// What is wrong with the names of a take: one comes twice, is empty or could not be written again. Empty when nothing.
std::string odd_names(const Take& take);

/// Throws Error when something is.
void check_names(const Lines& lines, const Take& take);

}  // namespace mien
