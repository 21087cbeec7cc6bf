// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Small meshes and takes that tests are built from: the reader sees input and expectation on one screen.

#pragma once

#include <array>
#include <cmath>
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

/// A ball of rings and sectors round `centre`, poles on the z axis; `open` rings are left out behind.
inline Mesh ball(Vec3f centre, float radius, std::uint32_t rings = 12, std::uint32_t sectors = 16,
                 std::uint32_t open = 0) {
    Mesh mesh;
    mesh.positions.push_back(centre + Vec3f{0, 0, radius});
    for (std::uint32_t r = 1; r < rings - open; ++r)
        for (std::uint32_t s = 0; s < sectors; ++s) {
            const double polar = 3.14159265358979 * r / rings, round = 2 * 3.14159265358979 * s / sectors;
            const Vec3 out{std::sin(polar) * std::cos(round), std::sin(polar) * std::sin(round), std::cos(polar)};
            mesh.positions.push_back(centre + radius * to_float(out));
        }
    for (std::uint32_t s = 0; s < sectors; ++s) add_face(mesh, std::array{0U, 1 + s, 1 + (s + 1) % sectors});
    for (std::uint32_t r = 1; r + 1 < rings - open; ++r)
        for (std::uint32_t s = 0; s < sectors; ++s) {
            const std::uint32_t a = 1 + (r - 1) * sectors, b = a + sectors, next = (s + 1) % sectors;
            add_face(mesh, std::array{a + s, b + s, b + next, a + next});
        }
    return mesh;
}

/// A mask: a dome of 24 x 24 quads that bulges to +z, mirror symmetric about x = 0, with feature points of eyes, lips,
/// brows, cheeks and chin. Its eyes are 1.0 apart. Vertex (i, j) has index j * 25 + i.
inline Face mask() {
    Face face{grid(24, 24, 0.125F), {}};
    for (Vec3f& p : face.mesh.positions) {
        p -= {1.5F, 2.0F, 0};
        p.z = -0.3F * (p.x * p.x + 0.5F * p.y * p.y);
    }
    const auto add = [&](const char* id, std::uint32_t i, std::uint32_t j) {
        face.points.push_back(point_at(face.mesh, id, j * 25 + i));
    };
    add("2.2", 12, 10), add("2.3", 12, 9), add("2.10", 12, 4), add("2.4", 15, 9), add("2.5", 9, 9);
    add("3.7", 18, 16), add("3.11", 14, 16), add("3.8", 6, 16), add("3.12", 10, 16);
    add("4.1", 14, 19), add("4.2", 10, 19), add("5.3", 18, 12), add("5.4", 6, 12), add("11.1", 12, 23);
    return face;
}

}  // namespace mien::shapes
