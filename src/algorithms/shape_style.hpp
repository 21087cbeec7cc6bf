// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <array>
#include <span>
#include <vector>

#include "mien/face.hpp"

namespace mien {

/// How the same expression moves the same points in two hands: the table's, already on this face, and the artist's.
struct StylePair {
    std::vector<Vec3> ours, theirs;  ///< one displacement per point, in the mesh's unit
};

/// What an artist does to the table's motions, point by point: a linear map of a displacement.
struct Style {
    std::vector<std::array<Vec3, 3>> maps;  ///< columns, one map per point
};

/// One map per region of the face (mouth, jaw, brows, lids, nose, cheeks), the same for both sides but mirrored:
///
///     minimise over A:  sum |theirs - A ours|^2 + 0.3 S |A - g|^2,  S = sum |ours|^2 / 3,  g = the region's gain
///
/// with g = sum theirs.ours / sum |ours|^2, within 0.3 to 3. So few examples say how much, many also which way. Regions
/// that no example moves, and points of no region, take the gain of the whole face; without examples it is 1.
/// `across`: the direction from one half of the face to the other, of length 1.
Style fit_style(std::span<const FeaturePoint> points, std::span<const StylePair> pairs, const Vec3& across);

/// The motions in the artist's style.
std::vector<Vec3> styled(const Style& style, std::span<const Vec3> motions);

}  // namespace mien
