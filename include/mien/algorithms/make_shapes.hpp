// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <string>
#include <vector>

#include "mien/algorithms/expressions.hpp"
#include "mien/algorithms/retarget.hpp"
#include "mien/face.hpp"
#include "mien/mesh.hpp"
#include "mien/rig.hpp"

namespace mien {

/// How strongly one shape is made: 1 as it comes, 0 not at all.
struct ShapeGain {
    std::string shape;
    double gain = 1;
};

struct ShapesOptions {
    std::vector<ShapeSet> sets{ShapeSet::arkit, ShapeSet::visemes, ShapeSet::vrm};
    /// How motion goes from the table's face to this one. One map per point does for creatures too, since small mouths
    /// move in proportion.
    RetargetMethod method = RetargetMethod::local_affine;
    /// An artist's shapes on the same head, by the names of the standards. They are kept as they are, and the missing
    /// ones follow their style. Shapes of other names are left out.
    std::vector<MorphTarget> examples = {};
    std::vector<ShapeGain> gains = {};
    /// Degrees that eyeballs turn at full strength, 0 to 60.
    double look_aside = 30, look_up = 25, look_down = 30;
};

struct FaceShapes {
    std::vector<MorphTarget> shapes;   ///< those of the sets, in the order of `named_shapes`; some may move nothing
    std::vector<std::string> kept;     ///< of the examples, by their standard names
    std::vector<std::string> unknown;  ///< examples of names that are no standard's
    std::vector<std::string> notes;    ///< what the head lacks, a sentence each
    bool symmetric = false;            ///< the head is, so that left and right shapes mirror each other exactly
};

/// The face's points that the table of motions drives: what the rig that spreads them is made of.
std::vector<std::string> shape_points(const Face& face);

/// Gives a neutral head the shapes that programs expect: ARKit's 52, the visemes of Oculus, the expressions of VRM.
///
/// Feature points move as a table says that they do on an ordinary face, retargeted to this one, and `rig` spreads what
/// they do. Then what points cannot know is made true: blinks close along the whole edge of the lids; `jawOpen` leaves
/// the upper lip alone; `mouthClose` is what brings the lips back together from `jawOpen`, all along; eyeballs turn,
/// lids stay outside them, sockets that are closed behind the eyes keep still, the tongue comes out. Visemes and
/// expressions are sums (docs/shapes.md). Source of the table: ICT-FaceKit (MIT; src/algorithms/arkit_motions.cpp).
///
/// Shapes are linear and do not clamp: two of them together may cross the lips. To play many at once with contact, play
/// their points (play_shapes.hpp).
///
/// `rig`: of this face, any method, made of the points that `shape_points` names or more; the others keep still. A rig
/// that knows how faces move spreads better. Throws Error if the rig has other vertices, if the face shares fewer than
/// three points with the table, if an example has a vertex out of range, or if a gain or an angle is no finite number.
FaceShapes make_shapes(const Face& face, const Rig& rig, const ShapesOptions& options = {});

}  // namespace mien
