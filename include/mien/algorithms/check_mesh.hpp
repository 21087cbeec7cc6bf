// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>

#include "mien/mesh.hpp"

namespace mien {

/// What is odd about a mesh, for reports: riggers work in spite of all of it. Counted on the welded surface.
struct MeshCheck {
    std::size_t places = 0;             ///< vertices after joining equal positions
    std::size_t islands = 0;            ///< connected pieces
    std::size_t unused_vertices = 0;    ///< vertices that no face uses
    std::size_t border_edges = 0;       ///< edges with one face: rims of openings
    std::size_t nonmanifold_edges = 0;  ///< edges with three faces or more
    std::size_t mixed_edges = 0;        ///< edges whose two faces wind against each other
    std::size_t flat_faces = 0;         ///< faces without area
    std::size_t repeated_faces = 0;     ///< faces whose corners another face has too
    std::size_t triangles = 0, quads = 0, larger_faces = 0;
};

/// Counts them in one pass over sorted edges and faces.
MeshCheck check_mesh(const Mesh& mesh);

}  // namespace mien
