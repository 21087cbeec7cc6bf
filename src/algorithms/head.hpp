// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <optional>
#include <span>
#include <vector>

#include "mien/vec.hpp"

namespace mien {

/// Whether points tell a head's pose: two places in a picture, three that are not on a line in space.
bool tell_a_pose(std::span<const Vec3> markers, bool planar);

/// The pose that takes markers from their places at reference onto those of a row, in the least-squares sense. Nothing
/// where either side does not tell a pose.
std::optional<Pose> least_squares_pose(std::span<const Vec3> reference, std::span<const Vec3> now, bool planar);

/// Kshirsagar et al., eq. 6-10, from the widest three of the markers (two in a picture). Nothing where either side of
/// those does not tell a pose.
std::optional<Pose> three_marker_pose(std::span<const Vec3> reference, std::span<const Vec3> now, bool planar);

/// Poses for the rows that have none: turned and shifted evenly in time between the rows around, held at the ends.
/// `pivot` is the middle of the head in the reference row: it runs straight from pose to pose.
std::vector<Pose> carry_over(std::span<const std::optional<Pose>> poses, std::span<const double> times,
                             const Vec3& pivot);

}  // namespace mien
