// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "io/tracks_text.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <set>

#include "mien/error.hpp"

namespace mien {

namespace {

double read_coordinate(const Lines& lines, std::string_view point, char axis, std::string_view cell) {
    if (cell.empty()) return std::numeric_limits<double>::quiet_NaN();
    const std::optional<double> number = parse_double(cell);
    if (!number || std::abs(*number) > largest_coordinate)
        lines.fail(fmt::format("expected a coordinate {} of {} within 1e15, or an empty cell, found {}", axis,
                               shown(point), shown(cell)));
    return *number;
}

bool is_plain_zero(double number) {
    return number == 0 && !std::signbit(number);
}

}  // namespace

Vec3 read_sample(const Lines& lines, std::string_view point, const std::array<std::string_view, 3>& cells,
                 bool planar) {
    const Vec3 sample{read_coordinate(lines, point, 'x', cells[0]), read_coordinate(lines, point, 'y', cells[1]),
                      planar ? 0 : read_coordinate(lines, point, 'z', cells[2])};
    const bool zero = is_plain_zero(sample.x) && is_plain_zero(sample.y) && is_plain_zero(sample.z);
    return zero || !is_finite(sample) ? lost_sample : sample;
}

void append_sample(std::string& text, const Vec3& sample, bool planar, char separator) {
    const std::array<double, 3> numbers{sample == Vec3{} ? -0.0 : sample.x, sample.y, sample.z};
    for (std::size_t axis = 0; axis < (planar ? 2U : 3U); ++axis) {
        text += separator;
        if (is_finite(sample)) append_number(text, numbers[axis]);
    }
}

void begin_row(const Lines& lines, std::string_view cell, Take& take) {
    const std::optional<double> time = parse_double(cell);
    if (!time || !std::isfinite(*time)) lines.fail(fmt::format("expected a time in seconds, found {}", shown(cell)));
    if (!take.times.empty() && *time < take.times.back())
        lines.fail(fmt::format("expected a time from {}, found {}", take.times.back(), shown(cell)));
    if (!take.times.empty() && *time == take.times.back()) {
        take.samples.resize(take.samples.size() - take.points.size());
        ++take.repeated_rows;
    } else {
        take.times.push_back(*time);
    }
}

void check_seen(const Take& take, std::string_view format) {
    if (take.times.empty()) throw Error(fmt::format("{}: expected rows of samples, found none", format));
    if (!take.points.empty() && std::none_of(take.samples.begin(), take.samples.end(), is_finite<double>))
        throw Error(fmt::format("{}: expected samples, found no sample at all: every one of {} rows is lost", format,
                                take.times.size()));
}

bool is_printable_name(std::string_view name) {
    return !name.empty() && trimmed(name) == name && name.find_first_of("\t\r\n") == std::string_view::npos;
}

void check_printable(const Take& take, std::string_view format) {
    for (const std::string& name : take.points)
        if (!is_printable_name(name))
            throw Error(fmt::format("{}: expected the name of a point on one line without tabs, found {}", format,
                                    shown(name)));
}

std::string odd_names(const Take& take) {
    std::set<std::string_view> names;
    for (const std::string& name : take.points) {
        if (!is_printable_name(name))
            return fmt::format("expected the name of a point on one line without tabs, found {}", shown(name));
        if (!names.insert(name).second) return fmt::format("expected each point once, found {} twice", shown(name));
    }
    return {};
}

void check_names(const Lines& lines, const Take& take) {
    if (const std::string odd = odd_names(take); !odd.empty()) lines.fail(odd);
}

}  // namespace mien
