// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <array>
#include <span>

#include "mien/vec.hpp"

namespace mien {

/// First a, then b, as one turn: rotate(b * a, v) = rotate(b, rotate(a, v)).
constexpr Quaternion operator*(const Quaternion& b, const Quaternion& a) {
    return {b.w * a.x + b.x * a.w + b.y * a.z - b.z * a.y, b.w * a.y - b.x * a.z + b.y * a.w + b.z * a.x,
            b.w * a.z + b.x * a.y - b.y * a.x + b.z * a.w, b.w * a.w - b.x * a.x - b.y * a.y - b.z * a.z};
}

/// First a, then b, as one motion.
constexpr Pose operator*(const Pose& b, const Pose& a) {
    return {b.rotation * a.rotation, apply(b, a.translation)};
}

constexpr Pose inverse(const Pose& pose) {
    return {conjugate(pose.rotation), -rotate(conjugate(pose.rotation), pose.translation)};
}

/// The mean of some points; zero for none.
Vec3 centre(std::span<const Vec3> points);

/// The spreads of a point set about its centre along its principal axes (root of the sum of squares), largest first.
/// The second is zero for points on a line, the third for points in a plane.
std::array<double, 3> spreads(std::span<const Vec3> points);

/// The turn that takes the points of `from`, seen from their centre, best onto those of `to`, in the least-squares
/// sense; never a mirror image. Points on a line leave the turn about it open: then it turns no more than needed.
Quaternion best_rotation(std::span<const Vec3> from, std::span<const Vec3> to);

/// The same among the turns about z, for points of a picture.
Quaternion best_rotation_in_plane(std::span<const Vec3> from, std::span<const Vec3> to);

/// The turn nearest to a linear map given by its columns.
Quaternion nearest_rotation(const std::array<Vec3, 3>& columns);

}  // namespace mien
