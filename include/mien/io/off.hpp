// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <span>

#include "mien/mesh.hpp"

namespace mien {

/// Object File Format: OFF, COFF, NOFF and STOFF headers, text.
/// Throws Error naming the line or byte, what was expected and what was found.
Mesh parse_off(std::span<const std::byte> bytes);

}  // namespace mien
