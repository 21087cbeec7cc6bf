// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <vector>

#include "cage.hpp"
#include "surface.hpp"

namespace mien::samples {

/// A whole surface sampled from a half cage, and where the cage's points and edges went.
struct MirroredSurface {
    Surface surface;
    std::vector<std::uint32_t> mirror;  ///< per vertex its mirror image; a vertex of the midline is its own
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> edges;
    ///< per cage edge (lower point first) its vertices, both ends included
};

/// Samples the Catmull-Clark limit surface through the points of the half cage and its mirror image. Vertex i < points
/// is cage point i. The first half of the faces is the left half.
MirroredSurface limit_surface(const Cage& half);

/// The vertices along a chain of cage points, each once, in order.
std::vector<std::uint32_t> chain(const MirroredSurface& surface, const std::vector<std::uint32_t>& points);

}  // namespace mien::samples
