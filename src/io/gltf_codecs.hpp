// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <span>

#include "io/glb.hpp"

#include "mien/io/gltf.hpp"

namespace mien {

/// Takes EXT_meshopt_compression and KHR_draco_mesh_compression out of a document: their data become plain buffer views
/// and accessors. Throws Error naming the JSON pointer, expected and found.
void decompress(GltfDocument& document);

/// A glTF, text or binary, as one self-contained document (`load_gltf`) without compression whose accessors all say
/// something possible.
GltfDocument load_plain_gltf(std::span<const std::byte> bytes, const Fetch& fetch);

}  // namespace mien
