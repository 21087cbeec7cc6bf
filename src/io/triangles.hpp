// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// A mesh of polygons as viewers want it: triangles, and one texture coordinate and normal a vertex.

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mien/mesh.hpp"

namespace mien {

/// Adds the corners of the triangles of face `f`, as indices into `Mesh::face_vertices`: a fan from its first corner.
void append_fan(const Mesh& mesh, std::size_t f, std::vector<std::uint32_t>& corners);

/// One normal per vertex of the mesh, weighted by angle and smooth across vertices at one place; +z where there is no
/// surface.
std::vector<Vec3f> vertex_normals(const Mesh& mesh);

/// The vertices of some triangles: one per pair of a mesh vertex and a texture coordinate, ascending by vertex.
struct SplitVertices {
    std::vector<std::uint32_t> vertices;  ///< mesh vertex behind each
    std::vector<Vec2f> uvs;               ///< empty, or one for each
    std::vector<std::uint32_t> indices;   ///< one per corner
};
SplitVertices split_at_seams(const Mesh& mesh, std::span<const std::uint32_t> corners);

/// What a mesh has at these vertices.
std::vector<Vec3f> picked(std::span<const Vec3f> values, std::span<const std::uint32_t> vertices);

}  // namespace mien
