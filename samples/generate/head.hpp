// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <string>
#include <vector>

#include "surface.hpp"

namespace mien::samples {

/// An MPEG-4 feature point of the sample head: a vertex of one of its parts.
struct HeadPoint {
    std::string id;
    std::size_t part = 0;
    std::uint32_t vertex = 0;
};

struct Head {
    std::vector<Surface> parts;  ///< head, eye_left, eye_right, teeth_upper, teeth_lower, tongue
    std::vector<HeadPoint> points;
};

Head make_head();

Vec3 place(const Head& head, const HeadPoint& point);

}  // namespace mien::samples
