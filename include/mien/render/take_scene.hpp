// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include "mien/scene.hpp"
#include "mien/take.hpp"

namespace mien {

/// The points of a take as small white balls that move as it does: what was captured, to look at beside what it became.
///
/// One node per column, called like it, with its samples as translations; a ball whose sample is lost shrinks to
/// nothing until the next one. `size`: the radius of a ball as a share of the largest distance between two points of
/// the first row that are not lost. Throws Error if the take has no sample that is not lost.
Scene scene_of(const Take& take, double size = 0.018);

}  // namespace mien
