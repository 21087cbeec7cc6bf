// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "mien/face.hpp"
#include "mien/mesh_sequence.hpp"

namespace mien {

/// How far a replayed animation is from the true one in a region of the face.
struct ReplayRegion {
    std::string name;          ///< as in `RegionFigures`
    std::size_t vertices = 0;  ///< of the file
    double mean = 0, max = 0;  ///< distance of a vertex from the truth, over all rows, in eye distances
    double error = 0;  ///< RMS distance / RMS true motion; 0 where neither moves, infinite where the replay alone
};

/// How far a replayed animation is from the true one.
struct ReplayError {
    double mean = 0, max = 0, error = 0;  ///< as of a region, over all vertices
    std::vector<double> rows;             ///< per row the mean distance of its vertices, in eye distances
    std::vector<ReplayRegion> regions;    ///< those with vertices, in the order of `Evaluation`
    std::vector<double> vertices;         ///< per vertex the RMS distance, in the unit of the mesh
};

/// Compares row by row. True motion is counted from the neutral of `face`, whose mesh and points both are of; rows of
/// `truth` are named by `rows`, one for each of the replay's. Throws Error if there is no row, if numbers of rows or
/// vertices differ, or if the points have no size.
ReplayError replay_error(const Face& face, const MeshSequence& truth, std::span<const std::size_t> rows,
                         const MeshSequence& replay);

/// RMS of `part` over RMS of `whole`, both one number per vertex, in each region of `ReplayError` in its order, and at
/// last over all.
std::vector<double> shares_by_region(const Face& face, std::span<const double> part, std::span<const double> whole);

/// The row of an animation that shows each frame of a stream: the nearest to its time, counted from the first row.
/// Frames after the animation's end are left out. Throws Error if the animation has no row.
std::vector<std::size_t> rows_of_frames(const MeshSequence& sequence, std::span<const double> times);

}  // namespace mien
