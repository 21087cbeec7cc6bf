// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Riggers solve on places and per axis; a rig keeps one row per vertex with a weight for each axis. Three sets differ
// only where feature points are constrained (Kshirsagar et al., section 2, "movement constraint").

#include "algorithms/weight_rows.hpp"

#include <algorithm>

namespace mien {

bool moves_along(const FeaturePoint& point, int axis) {
    return axis == 0 ? point.moves.x : axis == 1 ? point.moves.y : point.moves.z;
}

namespace {

constexpr std::array<float Vec3f::*, 3> axis_members{&Vec3f::x, &Vec3f::y, &Vec3f::z};

// The three rows of a place merged by point, ascending.
std::vector<PointWeight> merged_row(const std::array<const WeightRows*, 3>& axes, std::uint32_t place) {
    std::vector<PointWeight> row;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const WeightRows& rows = *axes[axis];
        for (std::uint32_t e = rows.starts[place]; e < rows.starts[place + 1]; ++e) {
            const auto at = std::lower_bound(row.begin(), row.end(), rows.points[e],
                                             [](const PointWeight& w, std::uint16_t p) { return w.point < p; });
            const bool known = at != row.end() && at->point == rows.points[e];
            const auto entry = known ? at : row.insert(at, PointWeight{rows.points[e], {}});
            entry->weight.*axis_members[axis] = static_cast<float>(rows.weights[e]);
        }
    }
    return row;
}

}  // namespace

void spread_rows(Rig& rig, const Weld& weld, const std::array<const WeightRows*, 3>& axes) {
    rig.row_starts.assign(1, 0);
    rig.row_points.clear();
    rig.weights.clear();
    for (const std::uint32_t place : weld.place) {
        for (const PointWeight& entry : merged_row(axes, place)) {
            rig.row_points.push_back(entry.point);
            rig.weights.push_back(entry.weight);
        }
        rig.row_starts.push_back(static_cast<std::uint32_t>(rig.row_points.size()));
    }
}

}  // namespace mien
