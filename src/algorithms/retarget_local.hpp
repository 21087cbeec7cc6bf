// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include "algorithms/face_frame.hpp"

#include "mien/retarget.hpp"

namespace mien {

/// Fits one linear map per point to the neutral points that `map` holds. Throws Error if the points are so far apart
/// that the maps are not finite.
void fit_local_affine(Retarget& map, const FaceFrames& frames);

}  // namespace mien
