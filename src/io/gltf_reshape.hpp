// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// A head whose vertices were moved after it was read keeps its document; what the document says of its surface has to
// follow them.

#pragma once

#include <span>
#include <string>

#include "io/gltf_document.hpp"

#include "mien/mesh.hpp"

namespace mien {

/// Whether the vertices of a part are at other places than where the document puts them.
bool is_reshaped(const Mesh& mesh, const Part& part, std::span<const Vec3> placed);

/// Turns the normals of a primitive as the surface round each vertex turned, and takes its tangents out: programs make
/// those from normals and texture coordinates. `placed`: where the document puts the part's vertices.
void turn_surface(GltfDocument& document, nlohmann::json& attributes, const Mesh& mesh, const Part& part,
                  std::span<const Vec3> placed, const std::string& pointer);

}  // namespace mien
