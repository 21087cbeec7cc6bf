// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/colour.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mien {

namespace {

// The helix: lightness and hue at both ends, and its chroma. Every colour on it lies inside sRGB; more chroma would
// leave it at the dark end and at the orange.
constexpr double dark = 0.28, light = 0.92;
constexpr double first_turn = 285.0 / 360, last_turn = 468.0 / 360;
constexpr double chroma = 0.16;

constexpr double cube(double x) {
    return x * x * x;
}

// The curve of sRGB (IEC 61966-2-1) over linear light, in 8 bits.
std::uint8_t encode(double linear) {
    const double light_part = std::clamp(linear, 0.0, 1.0);
    const double coded = light_part <= 0.0031308 ? 12.92 * light_part : 1.055 * std::pow(light_part, 1 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::lround(255 * coded));
}

// OKLab to sRGB, with the coefficients of Ottosson's paper.
Colour from_oklab(double lightness, double a, double b) {
    const double l = cube(lightness + 0.3963377774 * a + 0.2158037573 * b);
    const double m = cube(lightness - 0.1055613458 * a - 0.0638541728 * b);
    const double s = cube(lightness - 0.0894841775 * a - 1.2914855480 * b);
    return {encode(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
            encode(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
            encode(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

// From blue (hue 260 degrees) at 0 and from red (27 degrees) at 1 straight to the light grey of the middle.
constexpr double end_lightness = 0.42, middle_lightness = 0.93, end_chroma = 0.14;
constexpr double blue_turn = 260.0 / 360, red_turn = 27.0 / 360;

Colour on_helix(double t) {
    const double angle = 2 * std::numbers::pi * std::lerp(first_turn, last_turn, t);
    return from_oklab(std::lerp(dark, light, t), chroma * std::cos(angle), chroma * std::sin(angle));
}

Colour on_opposites(double t) {
    const double away = std::abs(2 * t - 1);
    const double angle = 2 * std::numbers::pi * (t < 0.5 ? blue_turn : red_turn);
    return from_oklab(std::lerp(middle_lightness, end_lightness, away), away * end_chroma * std::cos(angle),
                      away * end_chroma * std::sin(angle));
}

}  // namespace

Colour colour_at(ColourScale scale, double share) {
    if (std::isnan(share)) return {128, 128, 128};
    const double t = std::clamp(share, 0.0, 1.0);
    return scale == ColourScale::heat ? on_helix(t) : on_opposites(t);
}

}  // namespace mien
