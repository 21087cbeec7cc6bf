// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/weight_rows.hpp"

namespace mien {

/// The places that are held: place and the one rig point that moves it, with weight 1.
struct HeldPlace {
    std::uint32_t place = 0;
    std::uint16_t point = 0;
};

/// One implicit step of diffusion over the surface, for the time `length` squared, with the held places fixed:
/// (M + length^2 L) W' = M W. L has cotangent weights, those of obtuse corners raised to zero, so that no weight leaves
/// [0, 1]; M has the areas round the places. Only places on islands with a held place change. Open borders are natural.
WeightRows smooth_weights(const WeightRows& rows, const Mesh& mesh, const Weld& weld, const std::vector<bool>& solved,
                          std::span<const HeldPlace> held, double length);

}  // namespace mien
