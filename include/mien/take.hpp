// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mien/vec.hpp"

namespace mien {

/// A performance as tracks of points over time: one row per time, one column per point. Positions are absolute, in
/// `unit`; a NaN sample was lost. Rows need not be evenly spaced; times strictly increase.
struct Take {
    std::vector<std::string> points;  ///< ids of the columns, unique: feature points or marker names
    std::vector<double> times;        ///< seconds, one per row, strictly increasing
    std::vector<Vec3> samples;        ///< rows x columns, row after row
    std::vector<Pose> head;  ///< empty, or one head pose per row: samples were p = pose^-1 applied to the capture
    std::string unit;        ///< the unit the file states ("mm", "cm", "m"); empty when it states none
    bool planar = false;     ///< a 2D source: z is absent and held at 0
    /// Rows of the file that gave way to the next one because it has the same time. For reports.
    std::size_t repeated_rows = 0;
    /// Rows that the file promises beyond its end. For reports.
    std::size_t missing_rows = 0;
};

/// One row of a take; also what a live source hands over.
struct Frame {
    double time = 0;           ///< seconds
    std::vector<Vec3> points;  ///< one per column of the take it belongs to; NaN when lost
    Pose head;
};

inline std::size_t row_count(const Take& take) {
    return take.times.size();
}

/// Row `row` of the samples: one position per point.
inline std::span<const Vec3> row(const Take& take, std::size_t row) {
    return std::span(take.samples).subspan(row * take.points.size(), take.points.size());
}
inline std::span<Vec3> row(Take& take, std::size_t row) {
    return std::span(take.samples).subspan(row * take.points.size(), take.points.size());
}

/// The take at `time` (seconds): linear between rows, held before the first and after the last. A sample that is lost
/// in one of the two rows is lost. Head poses are those of the nearer row. Throws Error if the take has no row.
Frame frame_at(const Take& take, double time);

/// Column of the point called `id`, or nothing.
std::optional<std::size_t> find_column(const Take& take, std::string_view id);

/// Rows per second: the inverse of the median time step; 0 for fewer than two rows.
double frame_rate(const Take& take);

/// Renames columns by `names` (marker name -> feature point id) and drops the columns that map to an empty id or are
/// not in the map at all. Names that the take does not have are ignored. Throws Error if two columns would get one id.
struct Rename {
    std::string from, to;  ///< an empty `to` drops the column
};
Take rename_points(const Take& take, std::span<const Rename> names);

}  // namespace mien
