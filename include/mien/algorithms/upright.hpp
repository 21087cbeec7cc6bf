// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <optional>

#include "mien/algorithms/tracks.hpp"
#include "mien/take.hpp"

namespace mien {

/// How a performer's face lies in the coordinates of the take: the turn that takes its own axes (+x to its left, +y up,
/// +z out of it) to those of the samples, by the best rotation of a generic face onto the neutral one; in the plane for
/// a planar take. Eyes, brows and nose tell it where there are enough of them. A nod of less than 20 degrees is left
/// alone: points do not tell it well. Nothing when too few MPEG-4 points are there.
std::optional<Quaternion> face_turn(const Take& take, const NeutralOptions& neutral = {});

/// The take turned back by it about the origin: what axes of the face mean holds for the axes of the samples then, as
/// animation parameters need it. Head poses turn along.
Take upright(const Take& take, const Quaternion& turn);

}  // namespace mien
