// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include "io/glb.hpp"

namespace mien {

/// Takes EXT_meshopt_compression and KHR_draco_mesh_compression out of a document: their data become plain buffer views
/// and accessors. Throws Error naming the JSON pointer, expected and found.
void decompress(GltfDocument& document);

}  // namespace mien
