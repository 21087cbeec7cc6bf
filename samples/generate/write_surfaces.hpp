// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <span>
#include <string>

#include "head.hpp"

namespace mien::samples {

/// Wavefront OBJ in metres: one object per part, quads kept, texture coordinates.
std::string format_obj(std::span<const Surface> parts);

/// Binary glTF in metres, its pictures as PNG inside it: one mesh per part, one primitive per material, normals,
/// texture coordinates, colours. In a part of one material vertex i is vertex i of the part; copies for texture seams
/// come after them.
std::string format_glb(const Head& head);

/// The number, within its mesh of the GLB, of a part's vertex: its first copy, counted over the mesh's primitives.
std::size_t vertex_in_glb(const Surface& part, std::uint32_t vertex);

/// Feature points by mesh and vertex, for the GLB, and by vertex alone, for the OBJ.
std::string format_points_by_mesh(const Head& head);
std::string format_points_by_vertex(const Head& head);

}  // namespace mien::samples
