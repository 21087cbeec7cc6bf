// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "io/gltf_primitive.hpp"

#include "mien/scene.hpp"

namespace mien {

/// The channels of the document's first animation, taken out of the budget. `nodes`: those of the scene, with as many
/// weights as they have morph targets; `numbers`: for each node of the document its number among them. What cannot be
/// played is said in `left_out`. Throws Error naming the JSON pointer, expected and found.
std::vector<Channel> read_channels(const GltfDocument& document, std::span<const Node> nodes,
                                   std::span<const std::uint32_t> numbers, ReadBudget& budget,
                                   std::vector<std::string>& left_out);

}  // namespace mien
