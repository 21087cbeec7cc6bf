// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "io/glb.hpp"

#include "mien/affine.hpp"
#include "mien/scene.hpp"

namespace mien {

/// From the sixteen numbers of a matrix, column by column.
Affine affine_from_columns(std::span<const double, 16> m);

/// A node as the document gives it, without parent and weights; its rotation has length 1.
Node read_node(const nlohmann::json& value, std::size_t number);

/// Stands for the parent of a root.
inline constexpr auto no_parent = static_cast<std::size_t>(-1);

struct SceneNodes {
    std::vector<Affine> worlds;          ///< one per node of the document: from its space to the scene's
    std::vector<std::size_t> traversal;  ///< the nodes of the scene shown first, depth first, parents before children
    std::vector<std::size_t> order;      ///< all nodes of the document, parents before children
    std::vector<std::size_t> parents;    ///< one per node of the document
};

/// Goes through the nodes. Throws Error naming the JSON pointer, expected and found for cycles, nodes with two parents,
/// and transforms that are not finite.
SceneNodes scene_nodes(const GltfDocument& document);

}  // namespace mien
