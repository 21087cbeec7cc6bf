// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstdint>

#include "io/glb.hpp"

namespace mien {

/// Gives every node of the scene that shows a mesh which another shows before it a copy of its own, behind all meshes
/// of the file: so nothing that is shown is lost, and the vertices of the file's own meshes keep their numbers. A copy
/// shares its accessors; one of "eye" is called "eye_2", the next "eye_3". Throws Error naming the node when the
/// JSON of all copies takes more than `most_json` bytes, and what scene_nodes throws.
void copy_instances(GltfDocument& document, std::uint64_t most_json);

}  // namespace mien
