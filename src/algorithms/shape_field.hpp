// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <vector>

#include "mien/vec.hpp"

namespace mien {

/// A shape while it is made: how far it moves each place of the welded head, in the mesh's unit.
using ShapeField = std::vector<Vec3>;

}  // namespace mien
