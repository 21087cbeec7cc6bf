// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "mien/take.hpp"

namespace mien {

/// Marker names to feature point ids: a two-column CSV, or JSON with a "markers" object (null: not used).
/// Throws Error naming the line or JSON pointer; a name given twice is refused.
std::vector<Rename> parse_marker_map(std::span<const std::byte> bytes);

}  // namespace mien
