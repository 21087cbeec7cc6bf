// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <span>

#include "mien/mesh.hpp"

namespace mien {

/// Object File Format: OFF, COFF, NOFF and STOFF headers, text, one vertex or face a line; colours, normals and texture
/// coordinates are passed over, and so are faces of fewer than three corners.
/// Throws Error naming the line or byte, what was expected and what was found.
Mesh parse_off(std::span<const std::byte> bytes);

}  // namespace mien
