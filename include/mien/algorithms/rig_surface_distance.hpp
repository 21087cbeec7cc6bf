// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include "mien/algorithms/reading.hpp"
#include "mien/rig.hpp"

namespace mien {

struct SurfaceDistanceOptions {
    /// `paper`: eq. 1-5 exactly as written. `remedied`: metric regions, smooth angles, coverage, one smoothing step
    /// (docs/papers/kshirsagar.md has each deviation and its reason).
    Reading reading = Reading::remedied;
};

/// Builds a rig in which each feature point moves the vertices near it *along the surface*, so the lips stay apart
/// although they touch in space.
///
/// Distances run over mesh edges from every feature point at once; a vertex is shared between the points that reach it
/// before their neighbours do. Paper: Kshirsagar et al., section 2, eq. 1-5 (docs/papers/kshirsagar.md).
///
/// - Distances are in the unit of `face.mesh.positions`; the result does not depend on it.
/// - A vertex at a feature point follows it exactly.
/// - Vertices that no feature point reaches keep an empty row and do not move; `Rig::unreached` counts them.
/// - A point constrained along an axis has no weights there; the others share its surroundings.
///
/// Throws Error if the face has no feature point, or one whose vertex the mesh does not have.
Rig rig_surface_distance(const Face& face, const SurfaceDistanceOptions& options = {});

}  // namespace mien
