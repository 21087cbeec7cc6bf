// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "mien/measured_point.hpp"

namespace mien {

/// Measured feature points from JSON: a map id -> [x, y, z] at top level or under "points", null for a coordinate that
/// a picture does not show; keys that start with `_` are ignored. Throws Error naming the JSON pointer: no points, a
/// value that is no such list, no coordinate at all, one that is not finite, a key given twice.
std::vector<MeasuredPoint> parse_measured_points(std::span<const std::byte> bytes);

}  // namespace mien
