// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "algorithms/island.hpp"

namespace mien {

struct Sphere {
    Vec3 centre;
    double radius = 0;
    double roughness = 0;  ///< root mean square distance of the points from it, as a share of the radius
};

/// The sphere that most of the points lie on: least absolute distance, so that the bulge of a cornea does not pull it.
/// `weights`: one per point, not negative. Radius 0 when the points lie in a plane.
Sphere fit_sphere(std::span<const Vec3> points, std::span<const double> weights);

/// The islands that turn together as one eyeball: the ball and what lies inside it (iris, pupil, cornea).
struct EyeballIslands {
    Sphere ball;
    std::vector<std::uint32_t> islands;  ///< the ball first
};

/// Islands that are nearly spherical, of an eye's size and at an eye, with no feature point on them but 3.5 or 3.6.
std::vector<EyeballIslands> find_eyeballs(const Face& face, const Weld& weld, std::span<const Island> islands);

/// The mean of the feature points at the eyes (3.x); nothing where there is none.
std::optional<Vec3> middle_of_eyes(std::span<const FeaturePoint> points);

}  // namespace mien
