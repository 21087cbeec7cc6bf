// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Small meshes and takes that tests are built from: the reader sees input and expectation on one screen.

#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "mien/face.hpp"
#include "mien/mesh.hpp"

namespace mien::shapes {

/// A flat grid of quads in the plane z = 0: columns x rows quads of side `step`, lower left corner at the origin.
/// Vertex (i, j) has index j * (columns + 1) + i.
inline Mesh grid(std::uint32_t columns, std::uint32_t rows, float step = 1) {
    Mesh mesh;
    for (std::uint32_t j = 0; j <= rows; ++j)
        for (std::uint32_t i = 0; i <= columns; ++i)
            mesh.positions.push_back({step * static_cast<float>(i), step * static_cast<float>(j), 0});
    const std::uint32_t across = columns + 1;
    for (std::uint32_t j = 0; j < rows; ++j)
        for (std::uint32_t i = 0; i < columns; ++i) {
            const std::uint32_t v = j * across + i;
            add_face(mesh, std::array{v, v + 1, v + 1 + across, v + across});
        }
    return mesh;
}

/// A strip of `quads` unit squares along x.
inline Mesh strip(std::uint32_t quads) {
    return grid(quads, 1);
}

/// Adds another mesh as an island of its own.
inline void append(Mesh& mesh, const Mesh& other, Vec3f offset = {}) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const Vec3f& p : other.positions) mesh.positions.push_back(p + offset);
    for (std::size_t f = 0; f < face_count(other); ++f) {
        std::vector<std::uint32_t> corners;
        for (const std::uint32_t v : face(other, f)) corners.push_back(v + first);
        add_face(mesh, corners);
    }
}

/// A feature point at a vertex of the mesh.
inline FeaturePoint point_at(const Mesh& mesh, std::string id, std::uint32_t vertex) {
    return {std::move(id), vertex, to_double(mesh.positions[vertex]), {}, 0};
}

}  // namespace mien::shapes
