// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "mien/algorithms/weld.hpp"
#include "mien/mesh.hpp"

namespace mien {

/// The polygon edges of a welded surface as adjacency: place p has the neighbours starts[p] .. starts[p+1]-1.
struct EdgeGraph {
    std::vector<std::uint32_t> starts;      ///< places + 1 entries
    std::vector<std::uint32_t> neighbours;  ///< ascending within a place
    std::vector<double> lengths;            ///< one per neighbour, in the mesh's unit
};

/// Edges run along polygon sides only: a quad has no diagonal. Zero-area and repeated faces do no harm.
EdgeGraph edge_graph(const Mesh& mesh, const Weld& weld);

/// Length of the shortest path along edges from `source` to every place; infinity where there is none: the
/// *surface distance* of Kshirsagar et al., section 2. Paths longer than `limit` are left at infinity.
std::vector<double> surface_distances(const EdgeGraph& graph, std::uint32_t source,
                                      double limit = std::numeric_limits<double>::infinity());

}  // namespace mien
