// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <span>

#include "io/glb.hpp"

#include "mien/io/gltf.hpp"

namespace mien {

/// A glTF, text or binary, as one self-contained document: every buffer and picture lies in the one binary. Buffer
/// views lie in it too, those apart whose buffer is the empty fallback of EXT_meshopt_compression, which decompression
/// fills. A picture that cannot be fetched is taken out and named in `left_out`. Throws Error naming the JSON pointer
/// or byte, expected and found.
GltfDocument load_gltf(std::span<const std::byte> bytes, const Fetch& fetch);

/// Throws Error unless a buffer view lies in the binary.
void check_view(const GltfDocument& document, std::size_t view);

}  // namespace mien
