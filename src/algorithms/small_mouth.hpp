// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include "algorithms/face_frame.hpp"

#include "mien/retarget.hpp"

namespace mien {

/// How much of its motion a mouth takes that is so much narrower than expected: all of it down to 0.8, below that in
/// proportion.
double mouth_share(double width, double expected);

/// Shortens the maps of the lower face where the target's mouth is narrow beside the source's, each by its own eye
/// distance. Without the corners of both mouths nothing changes.
void fit_small_mouth(Retarget& map, const FaceFrames& frames);

}  // namespace mien
