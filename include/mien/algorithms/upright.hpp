// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <optional>
#include <span>

#include "mien/face.hpp"

namespace mien {

/// How a face lies in its coordinates: the turn that takes a face's own axes (+x the subject's left, +y up, +z forward)
/// to those of its points, by the best rotation of a generic face onto the points of skull, eyes and nose (all points
/// where those are too few). Nothing when the points do not say: fewer than three MPEG-4 points, or all on a line.
std::optional<Quaternion> face_turn(std::span<const FeaturePoint> points);

}  // namespace mien
