// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Meshes and skins of an Assimp scene in a document of glTF.

#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

#include "io/glb.hpp"

struct aiMesh;

namespace mien {

/// Appends a mesh with its shapes, of the material of this number; nothing where it has no triangles. The joints that
/// its vertices name are its bones in their order, and behind them the node that shows it, for what hangs on no bone.
/// Throws Error naming the mesh, expected and found.
std::optional<std::size_t> append_fbx_mesh(GltfDocument& document, const aiMesh& mesh, std::size_t material);

/// Appends the skin of a mesh that this node of the document shows. `node_of`: the node that a bone is called by.
std::size_t append_fbx_skin(GltfDocument& document, const aiMesh& mesh, std::size_t node,
                            const std::function<std::optional<std::size_t>(const std::string& bone)>& node_of);

}  // namespace mien
