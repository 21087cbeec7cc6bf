// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <span>

#include "mien/mesh.hpp"

namespace mien {

/// Stanford PLY: text and binary, both byte orders; elements and properties other than x, y, z and
/// the face list (vertex_indices or vertex_index) are skipped, and so are faces of fewer than three corners.
/// Throws Error naming the line or byte, what was expected and what was found.
Mesh parse_ply(std::span<const std::byte> bytes);

}  // namespace mien
