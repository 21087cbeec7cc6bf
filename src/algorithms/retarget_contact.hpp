// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <span>

#include "algorithms/face_frame.hpp"

#include "mien/algorithms/retarget.hpp"
#include "mien/face.hpp"
#include "mien/retarget.hpp"

namespace mien {

/// Adds the pairs of lids and lips to a map whose local maps are fitted. `face`: the target's points, for lower lids
/// that the source lacks. Throws Error if `sealed` names a point that is the upper one of no pair.
void fit_contact(Retarget& map, const FaceFrames& frames, std::span<const FeaturePoint> face,
                 std::span<const SealedOpening> sealed);

/// Corrects the target's displacements of one frame, so that what meets on the source meets on the target and nothing
/// crosses. `source`: the source's points, `moved`: the target's displacements by the local maps; both one per point of
/// the map. A pair with a lost point is left alone. Does not throw or allocate.
void keep_contact(const Retarget& map, std::span<const Vec3> source, std::span<Vec3> moved) noexcept;

}  // namespace mien
