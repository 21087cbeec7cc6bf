// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <span>

#include "mien/picture.hpp"

namespace mien {

/// JPEG, baseline or progressive, grey or in colour, at most 2^26 pixels; opaque. What the file says of its colour
/// space and of the camera's attitude is passed over, as glTF wants it. Throws Error naming the byte, what was expected
/// and what was found; four inks (CMYK) are refused.
Picture parse_jpeg(std::span<const std::byte> bytes);

}  // namespace mien
