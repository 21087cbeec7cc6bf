// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <span>
#include <string>
#include <vector>

#include "mien/vec.hpp"

namespace mien {

/// How the points `ids` move in 25 expressions of an ordinary face, at full strength, in eye distances: one vector per
/// expression, one motion per id, zero where a point is not known or does not move.
std::vector<std::vector<Vec3>> shape_motions(std::span<const std::string> ids);

}  // namespace mien
