// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <vector>

#include "io/gltf_scene.hpp"

#include "mien/scene.hpp"

namespace mien {

/// The channels of the document's animation number `number`, which it has to have, for the nodes that were `read` from
/// it; taken out of the budget. What cannot be played is said in `left_out` of the scene. Throws Error naming the JSON
/// pointer, expected and found.
std::vector<Channel> read_channels(const GltfDocument& document, std::size_t number, DocumentScene& read);

}  // namespace mien
