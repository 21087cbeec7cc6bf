// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstdint>

namespace mien {

/// A colour as pictures hold it: sRGB from 0 to 255, alpha not multiplied into it.
struct Colour {
    std::uint8_t r = 0, g = 0, b = 0, a = 255;
    friend constexpr bool operator==(const Colour&, const Colour&) = default;
};

/// The colour for a value from 0 (dark violet) over rose and orange to 1 (light yellow), in which equal steps of the
/// value look equally large and a grey copy keeps the order. Values outside take the nearer end; NaN is grey.
///
/// A helix in the perceptual space OKLab (B. Ottosson, "A perceptual color space for image processing", 2020):
/// lightness and hue grow evenly at constant chroma, so the speed is the same everywhere. The idea of a helix of even
/// lightness is D. A. Green's cubehelix ("A colour scheme for the display of astronomical intensity images", 2011).
Colour heat_colour(double value);

}  // namespace mien
