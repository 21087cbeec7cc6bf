// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <span>
#include <vector>

#include "mien/measured_point.hpp"
#include "mien/rig.hpp"

namespace mien {

/// What was measured in several pictures of a person as one set: a coordinate that more than one of them shows is their
/// mean.
std::vector<MeasuredPoint> merged(std::span<const std::vector<MeasuredPoint>> pictures);

/// Reshapes a generic head to measured feature points: Kshirsagar et al., section 3.1. The head is moved, turned and
/// scaled onto them first, and then deformed by the rig, as in animation, with what is left as displacements. The paper
/// does not say how it aligns the two; without that step what lies far from every point kept its size and place.
///
/// Gives one position per vertex of the rig. Measured points are met exactly, but for rounding to single precision. A
/// coordinate that was not measured is that of the aligned generic head. Eyeballs keep their shape and go with the
/// points round their eye. A head that is morphed to its own points stays as it is, bit for bit.
///
/// `rig`: bound to the measured points alone, since a point that is not moved would hold its surroundings fast. Throws
/// Error if no point is shared, if fewer than three points have all three coordinates and not all have x and y, if
/// those lie on a line or two at one place.
std::vector<Vec3f> morph(const Rig& rig, std::span<const MeasuredPoint> measured);

/// A rig of the generic head carried over to the reshaped one: the same weights on other places.
Rig carried_over(const Rig& rig, std::span<const Vec3f> positions);

}  // namespace mien
