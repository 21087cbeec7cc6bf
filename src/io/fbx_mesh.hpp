// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Meshes and skins of an Assimp scene in a document of glTF.

#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "io/glb.hpp"

struct aiMesh;

namespace mien {

/// Meshes of Assimp that are one mesh of the file, which it takes apart by materials: equal names, equally many shapes.
using FbxParts = std::vector<const aiMesh*>;

/// Appends them as one mesh with its shapes, a primitive each; nothing where they have no triangles. `materials`: how
/// many the scene has; a part that names none of them gets the one behind. The joints that vertices name are the bones
/// in their order, and behind them the node that shows the mesh, for what hangs on no bone. Throws Error naming the
/// mesh, expected and found.
std::optional<std::size_t> append_fbx_mesh(GltfDocument& document, const FbxParts& parts, std::size_t materials);

/// Whether a skin binds any of them.
bool has_fbx_bones(const FbxParts& parts);

/// Appends the skin of a mesh that this node of the document shows. `node_of`: the node that a bone is called by.
std::size_t append_fbx_skin(GltfDocument& document, const FbxParts& parts, std::size_t node,
                            const std::function<std::optional<std::size_t>(const std::string& bone)>& node_of);

}  // namespace mien
