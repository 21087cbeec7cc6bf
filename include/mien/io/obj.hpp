// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <span>

#include "mien/mesh.hpp"

namespace mien {

/// Wavefront OBJ: quads and n-gons kept, groups and objects as parts, texture coordinates per corner.
/// Throws Error naming the line or byte, what was expected and what was found.
Mesh parse_obj(std::span<const std::byte> bytes);

}  // namespace mien
