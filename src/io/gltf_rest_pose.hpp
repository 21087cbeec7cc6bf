// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "io/glb.hpp"
#include "io/gltf_nodes.hpp"
#include "io/gltf_primitive.hpp"

namespace mien {

/// Where a mesh of the document lies in the scene.
struct Standing {
    std::optional<std::size_t> node;  ///< the first node of the traversal that uses the mesh
    Affine world;                     ///< of that node
    bool skinned = false;             ///< whether that node has a skin
    std::vector<Affine> joints;       ///< of the skin: joint to scene after inverse bind
};

/// Where every mesh of the document lies. A mesh that no node of the scene uses lies as it is.
std::vector<Standing> standings(const GltfDocument& document);

/// The maps of a primitive's vertices to the scene: one for all of them, or for a skinned primitive one a vertex,
/// Σ weight · joint.
std::vector<Affine> vertex_maps(const Standing& standing, const Primitive& primitive);

}  // namespace mien
