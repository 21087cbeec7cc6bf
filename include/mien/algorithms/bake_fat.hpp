// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mien/fap.hpp"
#include "mien/fat.hpp"
#include "mien/mesh.hpp"
#include "mien/mesh_sequence.hpp"
#include "mien/rig.hpp"

namespace mien {

struct BakeFatOptions {
    /// The parameters that streams will send. The points of the others are carried by the skin, as when such a stream
    /// plays on the rig.
    FapMask sent = FapMask().set();
    /// Borders are put in until a parameter alone is met to within this share of the eye distance, between them too.
    double tolerance = 5e-4;
    /// Vertices that a parameter moves less than this share of the farthest that it moves any are left out of its
    /// table.
    double sparsity = 1e-4;
    bool head = true;  ///< FAPs 48 to 50 turn the whole head about its neck
};

/// How far a table is from what it stands for, in the unit of the head: root mean square over all vertices and rows,
/// and the largest distance.
struct FatError {
    double mean = 0, max = 0;
};

struct BakedFat {
    Fat fat;
    FatError alone;  ///< each parameter by itself, at the borders and at values between them
};

/// A face animation table that does what a rig does: each parameter alone is played on the rig at values over its
/// range, and what the vertices do there becomes their displacements. Eyeballs turn as nodes, by FAPs 23 to 26, and so
/// does the head. What is not linear in one parameter (lids that slide over an eye, shapes of a prior) costs borders;
/// what two parameters do together beyond the sum of both (contact of the lips, such shapes again) no table can say:
/// measure it with `fat_error`.
///
/// `mesh`: the head of the rig. `fapu`: its units, which the table is good for. Throws Error if the mesh is not that of
/// the rig, or if no parameter that is sent moves a point of it.
BakedFat bake_fat(const Rig& rig, const Mesh& mesh, const Fapu& fapu, const BakeFatOptions& options = {});

/// Example shapes bent into a table: the table nearest to `base` that gives the shapes back, when each is played by the
/// parameters that its own feature points show (eq. 1 of Laftsidis et al.; least squares, `ridge` against the size of
/// the change). 52 shapes of ARKit do not say what 66 parameters do, since several points move in each; `base`, as
/// `bake_fat` makes it of a rig, says the rest. What a shape does that no point shows comes back in part, as far as the
/// shapes have different parameters.
///
/// Shapes that go by the names of ARKit are taken for the parameters 3 to 22 and 31 to 68. The common names of visemes
/// ("viseme_aa") and VRM's "happy", "sad", "angry" and "surprised" become tables of FAPs 1 and 2. All others are left
/// out. Eyeballs keep turning as in `base`. `alone` is how well each shape comes back.
///
/// `points`: the feature points on the vertices of the mesh. Throws Error if no shape has a name that is known, if one
/// has vertices that the head lacks, or if `base` does not fit the head.
struct FatOfShapesOptions {
    double ridge = 1e-3;  ///< share of the mean square of the shapes' parameters
};
BakedFat fat_of_shapes(const Fat& base, const Mesh& mesh, const Fapu& fapu, std::span<const FeaturePoint> points,
                       std::span<const MorphTarget> shapes, const FatOfShapesOptions& options = {});

/// How far the table is from a mesh over time that the same stream was played on: one row per frame. Throws Error if
/// the numbers of vertices or rows differ.
FatError fat_error(const Fat& fat, const FapStream& stream, const MeshSequence& truth);

/// The table as morph targets, for engines that know no tables: a target per parameter and interval, intervals that do
/// the same made one, named "open_jaw", "open_jaw_below" and so on, so that sums of targets are exactly what the
/// table's meshes say. With a stream also what nodes do: the turn, scale and shift of a node is linear in the nine
/// entries of a matrix and three of a shift, which have a target each ("left eye xz"), those that stay zero left out.
/// The node that holds every vertex is none of them: its turn is the track's head. Weight 1 is the value at the
/// interval's outer border. Without frames targets have no weights, and nodes none.
///
/// The track's error is measured: it is what vertices that both a mesh table and a node move are off.
MorphTrack fat_morphs(const Fat& fat, const Mesh& mesh, const FapStream& stream);

}  // namespace mien
