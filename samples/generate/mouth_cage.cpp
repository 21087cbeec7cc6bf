// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Half loops round the mouth, nine points each from the midline above over the corner to the midline below, from the
// skin over the vermilion to the line where the lips touch, and behind it the bag of the inner mouth, closed at its
// back.

#include <string_view>

#include "head_cage.hpp"

namespace mien::samples {
namespace {

struct Ring {
    const char* name;
    double su, sv;  // texture: shrunk from the surround, or the size in the island of the inner mouth
    int count;
    std::vector<Vec3> points;
};

// clang-format off
const std::vector<Ring>& outer_rings() {
    static const std::vector<Ring> rings{
        {"mouth.skin", .88, .74, 2, {{0,-49.5,104.2},{5.6,-49.8,105},{13,-50.5,102.2},{21.5,-54.5,96.2},{29.5,-65.5,88},{21.5,-78.5,92.3},{14,-79.5,96},{6.5,-79.5,98.4},{0,-79.5,99.2}}},
        {"mouth.border", .78, .44, 2, {{0,-57.4,106.4},{4.6,-56.2,107.4},{12,-58.3,104.6},{19.5,-61.9,98.6},{25.9,-65.6,90.2},{19,-71,96.6},{12,-74.2,100.8},{6,-75.2,103},{0,-75.4,103.6}}},
        {"mouth.vermilion", .72, .22, 2, {{0,-61.5,108.6},{5,-60.6,108.6},{12,-61.8,105.4},{18.8,-63.6,99},{24.9,-65.4,91},{18.3,-67.9,98.2},{11.8,-70.3,103.4},{5.8,-71.2,106},{0,-71.3,106.5}}},
        {"mouth.contact", .68, 0, 2, {{0,-65.9,105},{5,-65.2,104.6},{11.5,-64.4,101.8},{18,-64.7,96.8},{23.9,-65.4,90.4},{18,-64.7,96.8},{11.5,-64.4,101.8},{5,-65.2,104.6},{0,-65.9,105}}},
    };
    return rings;
}

const std::vector<Ring>& inner_rings() {
    static const std::vector<Ring> rings{
        {"mouth.behind", .92, .92, 1, {{0,-65.9,101.8},{5,-65.2,101.3},{11,-64.5,98.6},{17.3,-64.7,94},{22.8,-65.4,89},{17.3,-64.7,94},{11,-64.5,98.6},{5,-65.2,101.3},{0,-65.9,101.8}}},
        {"mouth.inner", .80, .80, 1, {{0,-60.5,99.8},{5,-60.5,99.3},{11,-60.7,96.6},{17.5,-61.5,92},{24,-65,86},{17.5,-69,91.5},{11,-70.2,95.5},{5,-70.6,98},{0,-70.7,98.5}}},
        {"mouth.vestibule", .64, .64, 2, {{0,-51.5,98},{5,-51.5,97.5},{12,-52.5,95},{20.5,-54,87.5},{29.5,-65,77.5},{20.5,-78,86},{12,-79.5,90.5},{5,-80.5,93},{0,-80.5,93.5}}},
        {"mouth.roof", .42, .42, 2, {{0,-45.5,76},{6,-45.5,76},{15,-45.5,74},{27,-47.5,70},{33,-65,64},{26.5,-85,67},{15,-88,70},{6,-89,71},{0,-89,71.5}}},
        {"mouth.throat", .22, .22, 2, {{0,-48,46},{6,-48,46},{14,-49,46},{23,-53,46},{27,-66,45},{23,-79,45},{14,-83,46},{6,-84,46},{0,-84,46}}},
    };
    return rings;
}
// clang-format on

// The inner mouth is an island of its own in the texture: nested half discs.
std::vector<Uv> island(double scale) {
    constexpr Uv centre{.42, .14};
    constexpr double du[9]{0, .35, .7, .93, 1, .93, .7, .35, 0};
    constexpr double dv[9]{-1, -.94, -.71, -.38, 0, .38, .71, .94, 1};
    std::vector<Uv> uvs;
    uvs.reserve(9);
    for (int i = 0; i < 9; ++i) uvs.push_back({centre.u + .12 * scale * du[i], centre.v + .12 * scale * dv[i]});
    return uvs;
}

// The back of the inner mouth: 2 by 4 cells inside the last loop.
void close_throat(Cage& cage, const Loop& loop) {
    std::array<std::array<std::uint32_t, 5>, 3> point{};
    std::array<std::array<Uv, 5>, 3> uv{};
    for (std::size_t i = 0; i <= 2; ++i) {
        point[i][0] = loop.points[i], uv[i][0] = loop.uvs[i];
        point[i][4] = loop.points[8 - i], uv[i][4] = loop.uvs[8 - i];
    }
    for (std::size_t j = 0; j <= 4; ++j) point[2][j] = loop.points[2 + j], uv[2][j] = loop.uvs[2 + j];
    for (std::size_t j = 1; j < 4; ++j)
        for (std::size_t i = 0; i < 2; ++i) {
            const double s = static_cast<double>(i) / 2, t = static_cast<double>(j) / 4;
            const Vec3 a = cage.points[point[i][0]], b = cage.points[point[i][4]], c = cage.points[point[2][j]];
            const Vec3 column = a + t * (b - a);
            point[i][j] = add_point(cage, {s * c.x, (1 - s) * column.y + s * c.y, 43});
            uv[i][j] = {uv[0][0].u + s * (uv[2][j].u - uv[0][0].u), uv[i][0].v + t * (uv[i][4].v - uv[i][0].v)};
        }
    for (std::size_t j = 0; j < 4; ++j)
        for (std::size_t i = 0; i < 2; ++i)
            cage.quads.push_back({{point[i][j], point[i][j + 1], point[i + 1][j + 1], point[i + 1][j]},
                                  {uv[i][j], uv[i][j + 1], uv[i + 1][j + 1], uv[i + 1][j]},
                                  Region::inner_mouth});
}

}  // namespace

void add_mouth(Cage& cage, const Loop& surround) {
    cage.rings["mouth.surround"] = surround.points;
    const Uv centre{surround.uvs[0].u, surround.uvs[4].v};
    Loop loop = surround;
    for (const Ring& ring : outer_rings()) {
        const bool lip =
            std::string_view(ring.name) == "mouth.vermilion" || std::string_view(ring.name) == "mouth.contact";
        loop = add_strip(cage, loop,
                         {ring.points, shrunk(surround.uvs, centre, ring.su, ring.sv), ring.count,
                          lip ? Region::lip : Region::skin});
        cage.rings[ring.name] = loop.points;
    }
    loop.uvs = island(1);
    for (const Ring& ring : inner_rings()) {
        loop = add_strip(cage, loop, {ring.points, island(ring.su), ring.count, Region::inner_mouth});
        cage.rings[ring.name] = loop.points;
    }
    close_throat(cage, loop);
}

}  // namespace mien::samples
