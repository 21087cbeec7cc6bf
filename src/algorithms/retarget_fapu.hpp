// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include "algorithms/face_frame.hpp"

#include "mien/algorithms/tracks.hpp"
#include "mien/face.hpp"
#include "mien/retarget.hpp"
#include "mien/take.hpp"

namespace mien {

/// Puts the ratios of MPEG-4 units in the place of the local maps that `map` holds. The units are measured on all
/// points of the take's neutral and of the face, shared or not; where one of them lacks a unit's points, or has it not
/// above zero, the axis keeps what the local map does along it.
void fit_fapu(Retarget& map, const FaceFrames& frames, const Take& take, const Face& face,
              const NeutralOptions& neutral);

}  // namespace mien
