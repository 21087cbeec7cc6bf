// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// A head and the nodes of its table as a scene graph: nodes in nodes, and in each of them the shapes that are its own.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mien/fat.hpp"
#include "mien/mesh.hpp"

namespace mien {

/// The faces of one part of the mesh in one node.
struct TreeShape {
    std::string name;                  ///< of the part
    std::vector<std::uint32_t> faces;  ///< ascending
};

struct TreeNode {
    std::vector<std::uint32_t> nodes;  ///< that lie right in it
    std::vector<TreeShape> shapes;     ///< that lie in none of these, in the order of their first faces
};

struct SceneTree {
    std::vector<TreeNode> nodes;  ///< one per node of the table, and the scene itself as the last
};

/// Throws Error if the faces of a node are not whole, if it has other vertices than those faces (or all, where it holds
/// every face), if two nodes overlap, or if they lie in each other more than 24 deep.
SceneTree scene_tree(const Mesh& mesh, const Fat& fat);

}  // namespace mien
