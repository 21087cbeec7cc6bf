// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstdint>

#include "mien/colour.hpp"

namespace mien {

/// Lays a colour over a pixel of a picture, by its alpha (Porter and Duff's "over", the pixel's alpha counted too).
inline void lay_over(std::uint8_t* pixel, const Colour& colour) {
    if (colour.a == 255) {
        pixel[0] = colour.r;
        pixel[1] = colour.g;
        pixel[2] = colour.b;
        pixel[3] = 255;
        return;
    }
    const std::uint32_t above = 255U * colour.a, below = (255U - colour.a) * pixel[3], sum = above + below;
    if (sum == 0) return;
    const auto mixed = [&](std::uint32_t a, std::uint32_t b) {
        return static_cast<std::uint8_t>((above * a + below * b + sum / 2) / sum);
    };
    pixel[0] = mixed(colour.r, pixel[0]);
    pixel[1] = mixed(colour.g, pixel[1]);
    pixel[2] = mixed(colour.b, pixel[2]);
    pixel[3] = static_cast<std::uint8_t>((sum + 127) / 255);
}

}  // namespace mien
