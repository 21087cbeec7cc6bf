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

struct RetargetOptions {
    /// `paper`: eq. 1-3 as written, scale per centre. `remedied`: with an affine term, so that a face maps to itself
    /// and the result does not depend on where the target's origin lies.
    Reading reading = Reading::remedied;
    NeutralOptions neutral;
};

/// Fits the map from a performer's feature points to a face's, by the ids they share. Paper: Dutreve et al., section 2,
/// eq. 1-3 (docs/papers/dutreve.md).
///
/// Flat and two-dimensional point sets are solved with a rank-revealing method. Throws Error if no id is shared, if two
/// source points or two target points coincide (nearer than 1e-6 of their box's diagonal), or if the residual at the
/// points exceeds 1e-6 of the target's diagonal.
Retarget fit_retarget(const Take& take, const Face& face, const RetargetOptions& options = {});

/// F(p): the place on the target that corresponds to `p` on the source. Does not throw or allocate.
Vec3 retarget(const Retarget& map, const Vec3& p) noexcept;

/// The take on the target: only the shared points, in the target's unit, at target neutral + F(sample) - F(neutral).
/// Lost samples stay lost, head poses are kept with their translation scaled to the target.
/// Throws Error if the take lacks a column of the map.
Take retarget(const Retarget& map, const Take& take);

}  // namespace mien
