// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "io/glb.hpp"

#include "mien/affine.hpp"

namespace mien {

/// From the sixteen numbers of a matrix, column by column.
Affine affine_from_columns(const std::array<double, 16>& m);

struct SceneNodes {
    std::vector<Affine> worlds;          ///< one per node of the document: from its space to the scene's
    std::vector<std::size_t> traversal;  ///< the nodes of the scene shown first, depth first, parents before children
};

/// Goes through the nodes. Throws Error naming the JSON pointer, expected and found for cycles, nodes with two parents,
/// and transforms that are not finite.
SceneNodes scene_nodes(const GltfDocument& document);

}  // namespace mien
