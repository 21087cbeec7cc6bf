// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstdint>
#include <span>

#include "mien/vec.hpp"

namespace mien {

/// Twice the area of a polygon along its normal. Summed from its first corner, so that coordinates stay small.
inline Vec3 area_vector(std::span<const Vec3f> positions, std::span<const std::uint32_t> corners) {
    Vec3 sum;
    const Vec3 origin = to_double(positions[corners[0]]);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
        sum += cross(to_double(positions[corners[i]]) - origin, to_double(positions[corners[i + 1]]) - origin);
    return sum;
}

}  // namespace mien
