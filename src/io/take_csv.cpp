// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Our table of a take. Commas between cells and points in numbers only: a file with semicolons or decimal commas is
// refused with a sentence that says so, because a guess between two readings of "1,234" would be wrong half of the
// time.

#include "mien/io/take_csv.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "io/text.hpp"
#include "io/tracks_text.hpp"

#include "mien/error.hpp"

namespace mien {

namespace {

constexpr std::size_t no_column = std::numeric_limits<std::size_t>::max();

// Where the table has what: the column of the time and, per point, of each axis.
struct Columns {
    std::size_t time = no_column, count = 0;
    std::vector<std::array<std::size_t, 3>> axes;
};

// "8.4.x" and "8.4_x" are x of 8.4.
std::optional<std::size_t> axis_of(std::string_view heading) {
    if (heading.size() < 3) return std::nullopt;
    const char separator = heading[heading.size() - 2];
    const std::size_t axis = std::string_view("xyz").find(heading.back());
    if ((separator != '.' && separator != '_') || axis == std::string_view::npos) return std::nullopt;
    return axis;
}

void refuse_semicolons(const Lines& lines) {
    if (lines.line().find(',') == std::string_view::npos && lines.line().find(';') != std::string_view::npos)
        lines.fail(fmt::format("expected commas between columns, not semicolons, found {}", shown(lines.line())));
}

void place(const Lines& lines, std::string_view heading, std::size_t column, std::size_t& slot) {
    if (slot != no_column)
        lines.fail(fmt::format("column {}: expected each column once, found {} twice", column + 1, shown(heading)));
    slot = column;
}

using PointNumbers = std::map<std::string, std::size_t, std::less<>>;

void read_heading(const Lines& lines, std::string_view heading, std::size_t column, PointNumbers& numbers,
                  Columns& columns, Take& take) {
    if (equal_but_case(heading, "time")) return place(lines, heading, column, columns.time);
    const std::optional<std::size_t> axis = axis_of(heading);
    if (!axis)
        lines.fail(fmt::format("column {}: expected time, <point>.x, <point>.y or <point>.z, found {}", column + 1,
                               shown(heading)));
    const std::string point(heading.substr(0, heading.size() - 2));
    if (!is_printable_name(point))
        lines.fail(fmt::format("column {}: expected the name of a point on one line without tabs, found {}", column + 1,
                               shown(point)));
    const auto [number, is_new] = numbers.try_emplace(point, take.points.size());
    if (is_new) {
        take.points.push_back(point);
        columns.axes.push_back({no_column, no_column, no_column});
    }
    place(lines, heading, column, columns.axes[number->second][*axis]);
}

// Every point has x and y; either all have z, or none has and the take is planar.
void check_columns(const Lines& lines, const Columns& columns, Take& take) {
    if (columns.time == no_column) lines.fail("expected a column time, found none");
    if (take.points.empty()) lines.fail("expected columns <point>.x, found none");
    const auto lacks = [](std::size_t axis) { return [axis](const auto& axes) { return axes[axis] == no_column; }; };
    take.planar = std::all_of(columns.axes.begin(), columns.axes.end(), lacks(2));
    for (std::size_t axis = 0; axis < (take.planar ? 2U : 3U); ++axis) {
        const auto bad = std::find_if(columns.axes.begin(), columns.axes.end(), lacks(axis));
        if (bad != columns.axes.end())
            lines.fail(fmt::format("expected a column {} of point {}, found none", std::string_view("xyz")[axis],
                                   shown(take.points[static_cast<std::size_t>(bad - columns.axes.begin())])));
    }
}

// The cells of a row; only a row with quotes needs copies of them.
struct Row {
    std::vector<std::string> copies;
    std::vector<std::string_view> cells;
};

void read_cells(const Lines& lines, Row& row) {
    if (lines.line().find('"') == std::string_view::npos) return split_cells(lines.line(), ',', row.cells);
    std::optional<std::vector<std::string>> cells = comma_cells(lines.line());
    if (!cells) lines.fail("expected a closing quote, found the end of the line");
    row.copies = std::move(*cells);
    row.cells.assign(row.copies.begin(), row.copies.end());
}

Columns read_header(Lines& lines, Take& take) {
    if (!lines.next_filled()) throw Error("csv: expected a line with column names, found an empty file");
    refuse_semicolons(lines);
    Row row;
    read_cells(lines, row);
    Columns columns;
    columns.count = row.cells.size();
    PointNumbers numbers;
    for (std::size_t c = 0; c < row.cells.size(); ++c) read_heading(lines, row.cells[c], c, numbers, columns, take);
    check_columns(lines, columns, take);
    return columns;
}

void read_row(const Lines& lines, const Columns& columns, const Row& row, Take& take) {
    if (row.cells.size() != columns.count)
        lines.fail(fmt::format("expected {} cells, found {}", columns.count, row.cells.size()));
    begin_row(lines, row.cells[columns.time], take);
    for (std::size_t p = 0; p < take.points.size(); ++p) {
        const auto& axes = columns.axes[p];
        const std::string_view z = take.planar ? std::string_view() : row.cells[axes[2]];
        take.samples.push_back(
            read_sample(lines, take.points[p], {row.cells[axes[0]], row.cells[axes[1]], z}, take.planar));
    }
}

}  // namespace

Take parse_take_csv(std::span<const std::byte> bytes) {
    check_text(bytes, "csv");
    Lines lines(as_text(bytes), "csv");
    Take take;
    const Columns columns = read_header(lines, take);
    Row row;
    while (lines.next_filled()) {
        read_cells(lines, row);
        read_row(lines, columns, row, take);
    }
    check_seen(take, "csv");
    return take;
}

namespace {

// A cell as it is, or in quotes when it has to be.
std::string cell(const std::string& text) {
    if (text.find_first_of(",\"") == std::string::npos) return text;
    std::string result = "\"";
    for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
    return result + '"';
}

}  // namespace

std::string format_take_csv(const Take& take) {
    check_printable(take, "csv");
    std::string text = "time";
    for (const std::string& point : take.points)
        for (const char axis : std::string_view(take.planar ? "xy" : "xyz")) text += ',' + cell(point + '.' + axis);
    text += '\n';
    for (std::size_t r = 0; r < row_count(take); ++r) {
        append_number(text, take.times[r]);
        for (const Vec3& sample : row(take, r)) append_sample(text, sample, take.planar, ',');
        text += '\n';
    }
    return text;
}

}  // namespace mien
