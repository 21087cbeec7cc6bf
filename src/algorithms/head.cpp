// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Global head motion taken out of a take: Kshirsagar et al., section 4.1. The pose per row comes from head_pose.cpp
// (eq. 6-10, or least squares). The paper compares two instants; here every row is compared with one reference row, so
// that errors do not add up. Lost markers are not in the paper: a marker that is lost in the reference row gets its
// place there from the nearest row that shows it together with others.

#include "algorithms/head.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>
#include <utility>

#include "algorithms/rotation.hpp"

#include "mien/algorithms/head.hpp"
#include "mien/error.hpp"

namespace mien {

namespace {

std::vector<std::size_t> marker_columns(const Take& take, const HeadOptions& options) {
    const std::vector<std::string> names = options.markers.empty() ? head_markers(take) : options.markers;
    if (names.empty())
        throw Error(
            fmt::format("head motion: expected columns that keep their distances to each other, found none among the "
                        "take's {}; name the markers on the head",
                        take.points.size()));
    std::vector<std::size_t> columns;
    for (const std::string& name : names) {
        const auto column = find_column(take, name);
        if (!column) throw Error(fmt::format("head motion: expected a column {} in the take, found none", name));
        if (std::find(columns.begin(), columns.end(), *column) == columns.end()) columns.push_back(*column);
    }
    const std::size_t fewest = take.planar ? 2 : 3;
    if (columns.size() < fewest)
        throw Error(fmt::format("head motion: expected at least {} head markers, found {}", fewest, columns.size()));
    return columns;
}

// The head markers in the pose of the reference row. Lost ones are NaN.
using Model = std::vector<Vec3>;

// Where the markers that are in the model and seen in the row go from the one to the other.
std::optional<Pose> pose_in_row(const Take& take, std::size_t r, const std::vector<std::size_t>& columns,
                                const Model& model, HeadOptions::Method method) {
    std::vector<Vec3> reference, now;
    for (std::size_t k = 0; k < columns.size(); ++k) {
        const Vec3& p = row(take, r)[columns[k]];
        if (!is_finite(p) || !is_finite(model[k])) continue;
        reference.push_back(model[k]);
        now.push_back(p);
    }
    return method == HeadOptions::Method::three_markers ? three_marker_pose(reference, now, take.planar)
                                                        : least_squares_pose(reference, now, take.planar);
}

std::vector<std::size_t> rows_by_nearness(const Take& take, std::size_t reference) {
    std::vector<std::size_t> rows(row_count(take));
    std::iota(rows.begin(), rows.end(), std::size_t{0});
    const auto away = [&](std::size_t r) { return std::abs(take.times[r] - take.times[reference]); };
    std::stable_sort(rows.begin(), rows.end(), [&](std::size_t a, std::size_t b) { return away(a) < away(b); });
    return rows;
}

// Markers of the row that the model has not, brought into its pose.
void add_markers(Model& model, const Take& take, std::size_t r, const std::vector<std::size_t>& columns) {
    std::vector<std::size_t> missing;
    for (std::size_t k = 0; k < columns.size(); ++k)
        if (!is_finite(model[k]) && is_finite(row(take, r)[columns[k]])) missing.push_back(k);
    if (missing.empty()) return;
    const auto pose = pose_in_row(take, r, columns, model, HeadOptions::Method::least_squares);
    if (!pose) return;
    for (const std::size_t k : missing) model[k] = apply(inverse(*pose), row(take, r)[columns[k]]);
}

// The reference row, or the nearest to it that shows enough markers, is the pose in which nothing is turned.
Model reference_model(const Take& take, std::size_t reference, const std::vector<std::size_t>& columns) {
    const std::vector<std::size_t> rows = rows_by_nearness(take, reference);
    for (const std::size_t first : rows) {
        Model model, seen;
        for (const std::size_t c : columns) {
            model.push_back(row(take, first)[c]);
            if (is_finite(model.back())) seen.push_back(model.back());
        }
        if (!tell_a_pose(seen, take.planar)) continue;
        for (const std::size_t r : rows) add_markers(model, take, r, columns);
        return model;
    }
    throw Error(fmt::format(
        "head motion: expected a row in which {} or more of the {} head markers are seen at places that are "
        "not {}, found none",
        take.planar ? 2 : 3, columns.size(), take.planar ? "the same" : "on a line"));
}

Vec3 middle_of(const Model& model) {
    Model seen;
    std::copy_if(model.begin(), model.end(), std::back_inserter(seen), [](const Vec3& p) { return is_finite(p); });
    return centre(seen);
}

std::vector<Pose> head_poses(const Take& take, const HeadOptions& options) {
    const std::vector<std::size_t> columns = marker_columns(take, options);
    const Model model = reference_model(take, options.reference, columns);
    std::vector<std::optional<Pose>> poses;
    for (std::size_t r = 0; r < row_count(take); ++r)
        poses.push_back(pose_in_row(take, r, columns, model, options.method));
    return carry_over(poses, take.times, middle_of(model));
}

}  // namespace

Take remove_head_motion(const Take& take, const HeadOptions& options) {
    if (options.reference >= row_count(take))
        throw Error(
            fmt::format("head motion: expected a reference row below {}, the number of the take's rows, found {}",
                        row_count(take), options.reference));
    const std::vector<Pose> poses = head_poses(take, options);
    Take result = take;
    result.head.resize(row_count(take));
    for (std::size_t r = 0; r < row_count(take); ++r) {
        result.head[r] = result.head[r] * poses[r];
        const Pose back = inverse(poses[r]);
        for (Vec3& p : row(result, r)) p = apply(back, p);
    }
    return result;
}

}  // namespace mien
