// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mien/algorithms/weld.hpp"
#include "mien/rig.hpp"

namespace mien {

/// One weight of a vertex: which rig point, how much along each axis.
struct PointWeight {
    std::uint16_t point = 0;
    Vec3f weight;
};

/// The weights of every place along one axis: place p has the entries starts[p] .. starts[p+1]-1, points ascending.
struct WeightRows {
    std::vector<std::uint32_t> starts{0};
    std::vector<std::uint16_t> points;
    std::vector<double> weights;
};

/// Gives every vertex of the rig the row of its place, the three axes side by side. Axes may be the same object.
void spread_rows(Rig& rig, const Weld& weld, const std::array<const WeightRows*, 3>& axes);

/// Whether the point moves along an axis (0 x, 1 y, 2 z).
bool moves_along(const FeaturePoint& point, int axis);

}  // namespace mien
