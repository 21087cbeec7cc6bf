// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// TRC of Motion Analysis, as its writers fill it: five header lines, then perhaps a blank one, then rows. The header's
// number of frames is not believed, since writers leave it wrong when a take is cut; rate, unit and the number of
// markers are.

#include "mien/io/trc.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <string_view>
#include <vector>

#include "io/text.hpp"
#include "io/tracks_text.hpp"

#include "mien/error.hpp"

namespace mien {

namespace {

using Cells = std::vector<std::string_view>;

void next_cells(Lines& lines, std::string_view what, Cells& cells) {
    if (!lines.next())
        throw Error(fmt::format("trc line {}: expected {}, found the end of the file", lines.number() + 1, what));
    split_cells(lines.line(), '\t', cells);
}

void expect_first(const Lines& lines, const Cells& cells, std::string_view word) {
    if (!equal_but_case(cells.front(), word))
        lines.fail(fmt::format("expected {}, found {}", word, shown(cells.front())));
}

// The value under a heading of line 2; empty when there is none.
std::string_view value_of(const Cells& headings, const Cells& values, std::string_view heading) {
    for (std::size_t i = 0; i < headings.size() && i < values.size(); ++i)
        if (equal_but_case(headings[i], heading)) return values[i];
    return {};
}

std::int64_t read_count(const Lines& lines, const Cells& headings, const Cells& values, std::string_view heading) {
    const std::string_view text = value_of(headings, values, heading);
    const std::optional<std::int64_t> number = parse_integer(text);
    if (!number || *number < 0) lines.fail(fmt::format("expected a count as {}, found {}", heading, shown(text)));
    return *number;
}

void check_rate(const Lines& lines, std::string_view text) {
    const std::optional<double> rate = parse_double(text);
    if (!rate || !std::isfinite(*rate) || *rate <= 0)
        lines.fail(fmt::format("expected a DataRate above 0, found {}", shown(text)));
}

std::string read_unit(const Lines& lines, std::string_view text) {
    for (const std::string_view unit : {"mm", "cm", "m"})
        if (equal_but_case(text, unit)) return std::string(unit);
    lines.fail(fmt::format("expected mm, cm or m as Units, found {}", shown(text)));
}

struct Facts {
    std::int64_t markers = 0;
    std::string unit;
};

Facts read_facts(Lines& lines) {
    Cells headings, values;
    next_cells(lines, "PathFileType", headings);
    expect_first(lines, headings, "PathFileType");
    next_cells(lines, "DataRate and the other headings", headings);
    expect_first(lines, headings, "DataRate");
    next_cells(lines, "the values under the headings", values);
    check_rate(lines, value_of(headings, values, "DataRate"));
    read_count(lines, headings, values, "NumFrames");
    return {read_count(lines, headings, values, "NumMarkers"), read_unit(lines, value_of(headings, values, "Units"))};
}

// "Name_x" "Name_y" "Name_z" in three cells, as some writers put it: the name without the axis.
bool is_named_by_axis(const Cells& cells, std::size_t first) {
    constexpr std::string_view axes = "xyz";
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (first + axis >= cells.size()) return false;
        const std::string_view cell = cells[first + axis];
        if (cell.size() < 3 || !equal_but_case(cell.substr(cell.size() - 1), axes.substr(axis, 1))) return false;
        if (cell.substr(0, cell.size() - 1) != cells[first].substr(0, cells[first].size() - 1)) return false;
    }
    return true;
}

std::string marker_name(const Lines& lines, const Cells& cells, std::size_t first) {
    if (is_named_by_axis(cells, first)) return std::string(cells[first].substr(0, cells[first].size() - 2));
    for (std::size_t c = first + 1; c < first + 3 && c < cells.size(); ++c)
        if (!cells[c].empty())
            lines.fail(
                fmt::format("expected a marker name over three cells, found {} in column {}", shown(cells[c]), c + 1));
    return std::string(cells[first]);
}

void read_names(Lines& lines, std::int64_t markers, Take& take) {
    Cells cells;
    next_cells(lines, "Frame#, Time and the marker names", cells);
    expect_first(lines, cells, "Frame#");
    if (cells.size() < 2 || !equal_but_case(cells[1], "Time")) lines.fail("expected Time in the second column");
    while (cells.size() > 2 && cells.back().empty()) cells.pop_back();
    for (std::size_t c = 2; c < cells.size(); c += 3) take.points.push_back(marker_name(lines, cells, c));
    if (take.points.size() != static_cast<std::uint64_t>(markers))
        lines.fail(fmt::format("expected {} marker names as NumMarkers says, found {}", markers, take.points.size()));
    check_names(lines, take);
}

// The line with X1 Y1 Z1 X2 ...; its first two cells are empty.
void read_axes(Lines& lines) {
    Cells cells;
    next_cells(lines, "the line with X1 Y1 Z1", cells);
    if (!cells[0].empty())
        lines.fail(fmt::format("expected two empty cells, then X1 Y1 Z1, found {}", shown(cells[0])));
}

// Behind the named markers a row may end in empty cells. A file that names no marker at all holds unlabelled ones, as
// many as were seen in each row: nothing that could be followed.
void read_row(const Lines& lines, const Cells& cells, Take& take) {
    if (!parse_double(cells[0])) lines.fail(fmt::format("expected a frame number, found {}", shown(cells[0])));
    const std::size_t wanted = 2 + 3 * take.points.size();
    if (cells.size() < wanted) lines.fail(fmt::format("expected {} cells, found {}", wanted, cells.size()));
    for (std::size_t c = wanted; c < cells.size() && !take.points.empty(); ++c)
        if (!cells[c].empty())
            lines.fail(fmt::format("expected {} cells, found {} in column {}", wanted, shown(cells[c]), c + 1));
    begin_row(lines, cells[1], take);
    for (std::size_t p = 0; p < take.points.size(); ++p) {
        const std::size_t c = 2 + 3 * p;
        take.samples.push_back(read_sample(lines, take.points[p], {cells[c], cells[c + 1], cells[c + 2]}, false));
    }
}

}  // namespace

Take parse_trc(std::span<const std::byte> bytes) {
    check_text(bytes, "trc");
    Lines lines(as_text(bytes), "trc");
    const Facts facts = read_facts(lines);
    Take take;
    take.unit = facts.unit;
    read_names(lines, facts.markers, take);
    read_axes(lines);
    Cells cells;
    while (lines.next_filled()) {
        split_cells(lines.line(), '\t', cells);
        read_row(lines, cells, take);
    }
    check_seen(take, "trc");
    return take;
}

namespace {

// A take without two rows, or with times too close, has no rate of its own; the header needs a number above zero.
double header_rate(const Take& take) {
    const double rate = frame_rate(take);
    return rate > 0 && std::isfinite(rate) ? rate : 1;
}

void check_unit(const Take& take) {
    if (!take.unit.empty() && take.unit != "mm" && take.unit != "cm" && take.unit != "m")
        throw Error(fmt::format("trc: expected mm, cm or m as the unit, found {}", shown(take.unit)));
}

void append_header(std::string& text, const Take& take) {
    const double rate = header_rate(take);
    const std::size_t rows = row_count(take);
    text += "PathFileType\t4\t(X/Y/Z)\ttake.trc\n";
    text += "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\tOrigNumFrames\n";
    text += fmt::format("{}\t{}\t{}\t{}\t{}\t{}\t1\t{}\n", rate, rate, rows, take.points.size(),
                        take.unit.empty() ? "mm" : take.unit, rate, rows);
    text += "Frame#\tTime";
    for (const std::string& point : take.points) text += '\t' + point + "\t\t";
    text += "\n\t";
    for (std::size_t p = 1; p <= take.points.size(); ++p) text += fmt::format("\tX{}\tY{}\tZ{}", p, p, p);
    text += "\n\n";
}

}  // namespace

std::string format_trc(const Take& take) {
    check_printable(take, "trc");
    check_unit(take);
    std::string text;
    append_header(text, take);
    for (std::size_t r = 0; r < row_count(take); ++r) {
        text += fmt::format("{}\t", r + 1);
        append_number(text, take.times[r]);
        for (const Vec3& sample : row(take, r)) append_sample(text, sample, false, '\t');
        text += '\n';
    }
    return text;
}

}  // namespace mien
