// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <span>

#include "mien/mesh.hpp"

namespace mien {

/// Wavefront OBJ: quads and n-gons kept, texture coordinates per corner. `f` with fewer than three corners, lines,
/// points, curves and materials are passed over; colours and weights behind a vertex too. A run of faces under one
/// name, of the last `g` or `o`, is a part; its vertices run from the lowest to the highest that its faces use, so
/// parts may overlap. Runs that share a name are primitives of one mesh. Throws Error naming the line or byte, what was
/// expected and what was found.
Mesh parse_obj(std::span<const std::byte> bytes);

}  // namespace mien
