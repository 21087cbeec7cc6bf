// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The colour scales are few fixed colours with straight lines between them in sRGB. Lightness rises steadily along
// `heat`, and from the ends to the middle of `opposite`, so that they read in grey too.

#include "mien/render/look.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace mien {

namespace {

constexpr std::array<Colour, 6> heat{
    Colour{0.13F, 0.10F, 0.32F}, {0.15F, 0.32F, 0.55F}, {0.10F, 0.52F, 0.55F},
    {0.30F, 0.70F, 0.42F},       {0.70F, 0.83F, 0.25F}, {0.99F, 0.92F, 0.35F},
};
constexpr std::array<Colour, 5> opposite{
    Colour{0.10F, 0.22F, 0.55F}, {0.42F, 0.60F, 0.85F}, {0.93F, 0.92F, 0.90F},
    {0.90F, 0.53F, 0.40F},       {0.60F, 0.06F, 0.13F},
};

}  // namespace

Colour colour_at(ColourScale scale, double share) {
    const std::span<const Colour> stops = scale == ColourScale::heat ? std::span<const Colour>(heat) : opposite;
    const double place = (share > 0 ? std::min(share, 1.0) : 0.0) * static_cast<double>(stops.size() - 1);
    const auto first = std::min(static_cast<std::size_t>(place), stops.size() - 2);
    const auto rest = static_cast<float>(place - static_cast<double>(first));
    Colour colour{};
    for (std::size_t c = 0; c < 3; ++c) colour[c] = stops[first][c] + rest * (stops[first + 1][c] - stops[first][c]);
    return colour;
}

}  // namespace mien
