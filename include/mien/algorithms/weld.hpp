// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstdint>
#include <vector>

#include "mien/mesh.hpp"

namespace mien {

/// Which vertices of a mesh are one place of the surface. File formats split vertices at texture seams; riggers work on
/// the joined surface and spread the result back, so that seams do not tear.
struct Weld {
    std::vector<std::uint32_t> place;   ///< one per vertex: its place, numbered 0 .. places-1 by first appearance
    std::vector<std::uint32_t> vertex;  ///< one per place: its first vertex
};

struct WeldOptions {
    /// Vertices nearer than this share of the bounding box's height are joined; 0 joins equal positions only.
    /// At most 1e-4: at 1e-3 lips and lids that touch are fused.
    double tolerance = 1e-6;
};

/// Joins vertices by position. Deterministic: the lowest vertex of a place stands for it.
/// Throws Error if the tolerance is negative or above 1e-4.
Weld weld(const Mesh& mesh, const WeldOptions& options = {});

/// Numbers the connected pieces of the welded surface: one island number per place, by first appearance. A place that
/// no face uses is an island of its own.
std::vector<std::uint32_t> islands(const Mesh& mesh, const Weld& weld);

}  // namespace mien
