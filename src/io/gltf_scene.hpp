// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstdint>
#include <vector>

#include "io/glb.hpp"
#include "io/gltf_primitive.hpp"

#include "mien/scene.hpp"

namespace mien {

/// Whether materials and their pictures are read, or every surface is plain.
enum class Looks : std::uint8_t { read, left_out };

/// What a document shows, before anything plays.
struct DocumentScene {
    Scene scene;                              ///< without channels
    std::vector<std::uint32_t> node_numbers;  ///< of each node of the document in scene.nodes
    ReadBudget budget;                        ///< what is left of it
};

/// Reads what a document that `load_plain_gltf` loaded shows. Throws Error naming the JSON pointer, expected and found.
DocumentScene read_document_scene(const GltfDocument& document, Looks looks);

}  // namespace mien
