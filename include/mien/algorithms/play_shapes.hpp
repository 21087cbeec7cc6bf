// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <span>
#include <string>
#include <vector>

#include "mien/algorithms/make_shapes.hpp"
#include "mien/face.hpp"
#include "mien/retarget.hpp"

namespace mien {

/// Plays weights of ARKit shapes with contact: what shapes alone, being linear, cannot keep. The motions of all shapes
/// are added up on the table's face and retargeted as one frame, so that lips that meet there meet here, and no lids or
/// lips cross, whatever is mixed.
struct ShapePlayer {
    Retarget map;                            ///< from the table's face to this one, with its pairs in contact
    std::vector<std::string> points;         ///< ids of the points that it moves, in the face's order
    std::vector<std::vector<Vec3>> motions;  ///< one list per ARKit shape in the order of `named_shapes`: one motion
                                             ///< per point, on the table's face, in eye distances
};

/// Throws Error as `make_shapes` does for points that are too few.
ShapePlayer fit_shape_player(const Face& face, const ShapesOptions& options = {});

/// Where the player's points go. `weights`: one per ARKit shape; `displacements`: one per point, in the mesh's unit,
/// filled: what `deform` takes for a rig of these points. `sums`: room for two per point. Does not throw or allocate.
void play_shapes(const ShapePlayer& player, std::span<const float> weights, std::span<Vec3> sums,
                 std::span<Vec3f> displacements) noexcept;

}  // namespace mien
