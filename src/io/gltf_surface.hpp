// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "io/gltf_material.hpp"
#include "io/gltf_primitive.hpp"

#include "mien/scene.hpp"

namespace mien {

/// Positions, normals, texture coordinates, triangles and morph targets of a primitive in its node's space, taken out
/// of the budget. Throws Error naming the JSON pointer, expected and found.
Surface read_surface(const Primitive& primitive, const PictureMapping& mapping, const std::vector<std::string>& morphs,
                     ReadBudget& budget);

/// Binds a surface to a skin of `joints` joints by the sets of its primitive; without sets it stays unbound.
void bind_surface(Surface& surface, const Primitive& primitive, std::uint32_t skin, std::size_t joints,
                  ReadBudget& budget);

}  // namespace mien
