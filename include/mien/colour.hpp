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

/// How numbers become colours.
enum class ColourScale {
    heat,      ///< from dark violet over rose and orange to light yellow: something from none to much
    opposite,  ///< from blue over light grey to red: something to both sides of a middle
};

/// The colour of `share` on a scale: what surfaces are painted with and legends show. A share outside 0 to 1 takes the
/// nearer end; NaN is grey.
///
/// Equal steps look equally large, and a grey copy of `heat` keeps the order: it is a helix in the perceptual space
/// OKLab (B. Ottosson, "A perceptual color space for image processing", 2020) in which lightness and hue grow evenly at
/// constant chroma. The idea of a helix of even lightness is D. A. Green's cubehelix ("A colour scheme for the display
/// of astronomical intensity images", 2011). `opposite` runs straight in that space from either end to the middle.
Colour colour_at(ColourScale scale, double share);

}  // namespace mien
