// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "mien/mesh.hpp"

namespace mien {

/// A mesh over time: a baked result, or an animated head as source. Rows are asked for one at a time, so that a long
/// take on a large head needs no more memory than one frame.
struct MeshSequence {
    Mesh mesh;                  ///< the neutral head
    std::vector<double> times;  ///< seconds, one per row
    /// Fills `positions` (one per vertex of the mesh, file order) with the row's. May be called in any order.
    std::function<void(std::size_t row, std::span<Vec3f> positions)> positions;
};

/// A mesh over time as a few morph targets and their weights: positions(row) = neutral + sum_k weights(row, k)
/// target_k, and then the head's pose.
struct MorphTrack {
    std::vector<MorphTarget> targets;
    std::vector<double> times;   ///< seconds, one per row
    std::vector<float> weights;  ///< rows x targets, row after row
    double mean_error = 0;       ///< root mean square distance to the sequence it was made from, in the mesh's unit
    double max_error = 0;        ///< largest distance of any vertex in any row
    std::vector<Pose> head;      ///< empty, or what the whole head does after that, one pose per row
};

}  // namespace mien
