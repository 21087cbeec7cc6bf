// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "mien/picture.hpp"

namespace mien {

/// PNG of every kind (palette, grey, 16 bits, interlaced), at most 2^26 pixels. What the file says of its colour space
/// is passed over, as glTF wants it. Throws Error naming the byte, what was expected and what was found.
Picture parse_png(std::span<const std::byte> bytes);

/// PNG of 8 bits a channel, without alpha where the whole picture is opaque. Equal pictures give equal bytes. Throws
/// Error if the picture has no pixels or not as many numbers as its size says.
std::vector<std::byte> format_png(const Picture& picture);

}  // namespace mien
