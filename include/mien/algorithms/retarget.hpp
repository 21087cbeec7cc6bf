// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <string>
#include <vector>

#include "mien/algorithms/reading.hpp"
#include "mien/algorithms/tracks.hpp"
#include "mien/face.hpp"
#include "mien/retarget.hpp"
#include "mien/take.hpp"

namespace mien {

/// How the motion of a point is carried from one face to another.
enum class RetargetMethod {
    local_affine,  ///< one linear map per point, from how the two neutral faces lie to each other around it
    rbf,           ///< a radial basis function network with an affine term, a warp of space (Dutreve et al.)
};

struct RetargetOptions {
    RetargetMethod method = RetargetMethod::local_affine;
    /// `paper`: eq. 1-3 of Dutreve et al. as written, scale per centre, whatever `method` says.
    Reading reading = Reading::remedied;
    NeutralOptions neutral;
};

/// Fits the map from a performer's feature points to a face's, by the ids they share. Paper: Dutreve et al., section 2,
/// eq. 1-3 (docs/papers/dutreve.md); the default is a local affine map instead, which between two people of one model
/// misses a third of what the network does (docs/methods.md).
///
/// In both methods a face maps to itself, and the result does not depend on where either side's origin lies or how
/// large it is. Flat and two-dimensional point sets are fine. Throws Error if no id is shared, if two source points or
/// two target points coincide (nearer than 1e-6 of their box's diagonal), or if the network's residual at the points
/// exceeds 1e-6 of the target's diagonal.
Retarget fit_retarget(const Take& take, const Face& face, const RetargetOptions& options = {});

/// F(p) of a network: the place on the target that corresponds to `p` on the source. Zero for a map of the other kind.
/// Does not throw or allocate.
Vec3 retarget(const Retarget& map, const Vec3& p) noexcept;

/// The take on the target: only the shared points, in the target's unit, at the target's neutral plus the mapped
/// motion. Lost samples stay lost, head poses are kept with their translation scaled to the target. Throws Error if the
/// take lacks a column of the map.
Take retarget(const Retarget& map, const Take& take);

}  // namespace mien
