// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mien/algorithms/reading.hpp"
#include "mien/face.hpp"
#include "mien/mesh_sequence.hpp"
#include "mien/take.hpp"

namespace mien {

/// An animated head whose face looks along +z with +y up and whose head keeps still, and what was taken out of it:
/// source row = apply(source, apply(head[row], row of `sequence`)).
struct UprightSequence {
    MeshSequence sequence;             ///< its mesh is the neutral head
    std::vector<FeaturePoint> points;  ///< on that
    Pose source;                       ///< where the neutral head stands in the source
    std::vector<Pose> head;            ///< one per row
    std::vector<std::uint32_t>
        skull;                ///< the vertices that told the head's motion; of `Reading::paper` its three points
    double skull_motion = 0;  ///< root mean square of what is left of those vertices' motion, in eye distances
};

/// Takes out of an animated head what is motion of the whole head. Paper: Laftsidis et al., section 2.
///
/// As written: the first row is the neutral face. It is turned so that chin (2.1), top (11.4) and back of the head
/// (7.1) lie in the plane x = 0, then about x until the upper and lower lids (3.1 over 3.3, 3.2 over 3.4; the mean of
/// both eyes) stand in one vertical. In every row 7.1 is brought back to its neutral place, 11.4 and 9.15 to the plane
/// through it, and 11.4 by a turn about x to its direction.
///
/// Remedied: the sequence's mesh is the neutral face. It is turned where `face_turn` sees it turned; a nod below 20
/// degrees is left as it was modelled, and the head stays at its place. In every row the best rigid motion of the skull
/// is taken back: of those vertices above the eyes that keep their distances best over the animation, whatever the
/// points are. The turn is that of a face with at least three MPEG-4 points; other heads are taken as they stand.
///
/// The mesh of the result has no shapes and, where it was turned, no document. Throws Error when the sequence has no
/// row, when a vertex of a point does not exist, and, as written, when one of those points is missing or they lie on a
/// line.
UprightSequence upright(const MeshSequence& sequence, std::span<const FeaturePoint> points,
                        Reading reading = Reading::remedied);

/// The points of the face over time, with the poses of the head: columns are the points, rows those of the sequence.
Take point_tracks(const UprightSequence& upright);

/// The rows that show the animation at so many frames per second, each the nearest to its time. Throws Error if the
/// rate is not above 0 or the sequence has no row.
MeshSequence at_rate(const MeshSequence& sequence, double rate);

}  // namespace mien
