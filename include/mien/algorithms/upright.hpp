// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <optional>
#include <span>

#include "mien/algorithms/tracks.hpp"
#include "mien/face.hpp"
#include "mien/take.hpp"

namespace mien {

/// How a face lies in its coordinates: the turn that takes a face's own axes (+x the subject's left, +y up, +z forward)
/// to those of its points, by the best rotation of a generic face onto the points of skull, eyes and nose (all points
/// where those are too few). Nothing when the points do not say: fewer than three MPEG-4 points, or all on a line.
std::optional<Quaternion> face_turn(std::span<const FeaturePoint> points);

/// The same of a performer's face in a take, from its neutral; in the plane for a planar take. A nod of less than 20
/// degrees is left alone: points do not tell it well.
std::optional<Quaternion> face_turn(const Take& take, const NeutralOptions& neutral = {});

/// The take turned back by it about the origin: what axes of the face mean holds for the axes of the samples then, as
/// animation parameters need it. Head poses turn along.
Take upright(const Take& take, const Quaternion& turn);

}  // namespace mien
