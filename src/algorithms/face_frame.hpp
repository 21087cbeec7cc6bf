// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include "mien/retarget.hpp"

namespace mien {

/// How a face lies in its coordinates, and how large it is.
struct FaceFrame {
    Quaternion turn;  ///< takes the face's own axes (+x the subject's left, +y up, +z forward) to those of its points
    double eyes = 1;  ///< the eye distance, in the unit of the points
};

/// The frames of the two neutral faces that a map holds.
struct FaceFrames {
    FaceFrame source, target;
    bool known = false;  ///< false: too few MPEG-4 points; then the source's axes stand in for those of its face
};

/// Turns by the best rotation of a generic face onto each one's points, among the turns of the picture for a planar
/// source; eye distances from the points that both have. `eyes`: the target's, from all its points, in case the shared
/// ones are not enough.
FaceFrames face_frames(const Retarget& map, double eyes);

}  // namespace mien
