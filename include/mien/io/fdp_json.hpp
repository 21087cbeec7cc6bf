// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "mien/fdp.hpp"

namespace mien {

/// A face definition as JSON, mien's own form of it (docs/fat.md): the keys `unit`, `units`, `points`, `positions`,
/// `faces`, `uvs`, `parts`, `nodes` and `tables`, each of them optional; keys that start with `_` are ignored. Numbers
/// are those of `Fdp`: displacements in the model's unit per FAP unit, angles in radians. Throws Error naming the JSON
/// pointer: another key, a value of another kind, an index out of range, a table that `check_fat` refuses.
Fdp parse_fdp_json(std::span<const std::byte> bytes);

/// The same file back: it reads back equal, but for the `Mesh::gltf` and the shapes of the mesh, which it does not
/// hold.
std::string format_fdp_json(const Fdp& fdp);

}  // namespace mien
