// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <span>
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
    fapu,          ///< motion in each face's own MPEG-4 units (FAPU), for creatures of other proportions
    rbf,           ///< a radial basis function network with an affine term, a warp of space (Dutreve et al.)
};

/// The opening of the target's lips, in its eye distances, where the performer's are sealed: for faces whose mouth
/// stands open at rest. Where the performer's mouth is closed at rest, the target's rest is then closed to that, too.
struct SealedOpening {
    std::string upper;  ///< the upper point of the pair: 2.2, 2.6, 2.7, 8.1, 8.5, 8.6, or a lid
    double opening = 0;
};

struct RetargetOptions {
    RetargetMethod method = RetargetMethod::local_affine;
    /// `paper`: eq. 1-3 of Dutreve et al. as written, scale per centre, whatever `method` says.
    Reading reading = Reading::remedied;
    NeutralOptions neutral;
    bool contact = true;  ///< lids and lips that meet on the source meet on the target; not for networks
    std::vector<SealedOpening> sealed = {};  ///< pairs with an opening of their own
};

/// Fits the map from a performer's feature points to a face's, by the ids they share. The default is one linear map per
/// point (docs/methods.md); `fapu` scales each axis of the face by the ratio of the unit that MPEG-4 gives the point
/// there, and by the linear map where either face lacks the unit's points. Both keep contact: pairs of lids and lips
/// that close on the source close on the target, by the same share, and never cross; a lower lid that the source lacks
/// is taken to be still. A mouth narrower than 0.8 of the source's, by the eye distance, takes the lower face's motion
/// in proportion to its width. Paper of the network: Dutreve et al., section 2, eq. 1-3 (docs/papers/dutreve.md).
///
/// In every method a face maps to itself (with contact: where its lids and lips do not cross), the neutral maps to the
/// neutral, and the result does not depend on where either side's origin lies or how large it is. Flat and
/// two-dimensional point sets are fine. Throws Error if no id is shared, if two source points or two target points
/// coincide (nearer than 1e-6 of their box's diagonal), if `sealed` names no pair, or if the network's residual at the
/// points exceeds 1e-6 of the target's diagonal.
Retarget fit_retarget(const Take& take, const Face& face, const RetargetOptions& options = {});

/// F(p) of a network: the place on the target that corresponds to `p` on the source. Zero for a map of the other kind.
/// Does not throw or allocate.
Vec3 retarget(const Retarget& map, const Vec3& p) noexcept;

/// One frame: where the target's points go when the source's are at `source`, both one per point of the map. A lost
/// point stays lost and touches no other. Does not throw or allocate.
void retarget(const Retarget& map, std::span<const Vec3> source, std::span<Vec3> target) noexcept;

/// The take on the target: only the shared points, in the target's unit, at the target's neutral plus the mapped
/// motion. Lost samples stay lost, head poses are kept with their translation scaled to the target. Throws Error if the
/// take lacks a column of the map.
Take retarget(const Retarget& map, const Take& take);

}  // namespace mien
