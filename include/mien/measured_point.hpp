// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <string>

#include "mien/vec.hpp"

namespace mien {

/// Where a feature point of somebody was measured: in space, or in a picture, which shows only two of three
/// coordinates. Axes are those of a face: +x to its left, +y up, +z out of it.
struct MeasuredPoint {
    std::string id;
    Vec3 place;  ///< NaN where it was not measured
};

}  // namespace mien
