// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "surface.hpp"

#include "mien/vec.hpp"

namespace mien::samples {

struct CageQuad {
    std::array<std::uint32_t, 4> corners{};
    std::array<Uv, 4> uvs{};
    Region region = Region::skin;
};

/// How many quads an edge of the cage becomes. All edges that lie opposite to each other in a strip of quads agree.
struct EdgeCount {
    std::uint32_t a = 0, b = 0;
    int count = 0;
};

/// The coarse left half of the head's skin. Its points are places on the finished surface, not Catmull-Clark control
/// points.
struct Cage {
    std::vector<Vec3> points;
    std::vector<CageQuad> quads;
    std::vector<EdgeCount> counts;
    std::map<std::string, std::vector<std::uint32_t>> rings;  ///< named loops and rows of points, for landmarks
};

std::uint32_t add_point(Cage& cage, const Vec3& p);
std::vector<std::uint32_t> add_points(Cage& cage, const std::vector<Vec3>& points);

}  // namespace mien::samples
