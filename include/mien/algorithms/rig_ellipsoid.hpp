// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include "mien/algorithms/reading.hpp"
#include "mien/rig.hpp"

namespace mien {

struct EllipsoidOptions {
    /// `paper`: straight lines, the four largest weights, normalised, exactly as written. `remedied`: the way along the
    /// surface, coverage, the points held, one smoothing step (docs/papers/dutreve.md has each deviation and why).
    Reading reading = Reading::remedied;
};

/// Builds a rig in which each feature point moves what lies in an ellipsoid round it, most at its middle and not at all
/// at its rim: the automatic rig of Dutreve et al., section 3.2.
///
/// w = max(0, 1 - (dx^2/rx^2 + dy^2/ry^2 + dz^2/rz^2)), normalised to a sum of 1 over the largest. The paper takes the
/// radii from how the points lie to each other and gives one example; here the radius along x or y is 1.5 times the
/// distance to the nearest point that lies along that axis, and that along z the larger of the two.
///
/// - The axes are those of the mesh: x to the subject's left, y up, z forward, as in the paper. Size does not matter.
/// - As written, a point's own vertex moves by less than the point where another ellipsoid covers it, and lips that
///   touch follow each other. Remedied, a vertex at a feature point follows it exactly and lips stay apart.
/// - Vertices in no ellipsoid keep an empty row and do not move; `Rig::unreached` counts them.
/// - A point constrained along an axis has no weights there; the others share its surroundings.
///
/// Throws Error if the face has no feature point, or one whose vertex the mesh does not have.
Rig rig_ellipsoid(const Face& face, const EllipsoidOptions& options = {});

}  // namespace mien
