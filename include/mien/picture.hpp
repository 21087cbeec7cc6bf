// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mien {

/// A picture: `height` rows from the top, each of `width` pixels from the left, each of red, green, blue and alpha from
/// 0 to 255. Colours are sRGB; alpha is not multiplied into them.
struct Picture {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::uint8_t> rgba;  ///< 4 x width x height
};

}  // namespace mien
