// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The ear as a shell of concentric loops of ten points, from its root on the head over the back and the helix to the
// antihelix and the floor of the concha; and the pit of the nostril.

#include <cmath>

#include "head_cage.hpp"
#include "sculpt.hpp"

namespace mien::samples {
namespace {

// u backwards and outwards along the ear's plane, v up along its long axis, w out of the plane.
Vec3 ear_point(const Vec3& uvw) {
    constexpr double flare = 0.48, tilt = 0.2;
    const Vec3 u{std::sin(flare), 0, -std::cos(flare)};
    const Vec3 v{0, std::cos(tilt), -std::sin(tilt)};
    const Vec3 w{std::cos(flare), 0, std::sin(flare)};
    return Vec3{70, -12.5, 6} + uvw.x * u + uvw.y * v + uvw.z * w;
}

std::vector<Vec3> in_ear_plane(const std::vector<Vec3>& points) {
    std::vector<Vec3> result;
    result.reserve(points.size());
    for (const Vec3& p : points) result.push_back(ear_point(p));
    return result;
}

// Relief in the ear's plane: u, v and radius, and how far it rises along w.
struct Relief {
    double u0, v0, u1, v1, radius, rise;
};
// clang-format off
constexpr Relief reliefs[]{
    // helix
    {2.5,13, 4,20, 3,1.5}, {4,20, 13.5,28.5, 3,1.5}, {13.5,28.5, 25,26, 3,1.5}, {25,26, 31.5,14, 3,1.5}, {31.5,14, 30.8,-2, 3,1.4}, {30.8,-2, 25,-14, 3,.8},
    // scapha
    {14,23.5, 23,22, 3.4,-2}, {23,22, 27.5,12, 3.4,-2}, {27.5,12, 26.5,-3, 3.4,-2}, {26.5,-3, 21.5,-12, 3.2,-1.2},
    // antihelix, its crura and the fossa between them
    {20.5,-6, 22,6, 3.6,2.2}, {22,6, 18.5,14, 3.6,2}, {18.5,14, 14.5,20.5, 2.8,1.6}, {18.5,13, 10.5,11.5, 2.6,2}, {12.5,16, 11,16, 3,-2},
    // concha, crus of the helix, tragus, antitragus, the notch between them, lobe
    {13.5,6, 14,6, 6,-3}, {13,-3, 12,-4, 7,-5}, {2.5,6, 12,2.5, 2.8,3}, {5.5,-4, 5.8,-5, 4.6,3.6}, {12.5,-13, 16.5,-11, 3.4,2.4}, {8.5,-11.5, 8.5,-12, 2.8,-3}, {11,-22, 14,-22, 7,.8}, {8,-29, 15,-29, 9,-2.6},
};
// clang-format on

}  // namespace

void add_ear(Cage& cage, const Loop& root) {
    struct Ring {
        const char* name;
        double shrink;
        std::vector<Vec3> points;
    };
    // From the top front over the top, down the back, along the lobe and up the front.
    // clang-format off
    const std::vector<Ring> rings{
        {"ear.root", .86, {{70.3,5,4},{72,9.5,-7},{73,4.5,-17},{72.6,-5,-20},{71,-17,-19.5},{69.5,-28,-15},{68.6,-35,-6},{68.9,-34,8},{69.6,-20,9},{70,-6,7}}},
        {"ear.back", .74, in_ear_plane({{2.5,18.6,-.5},{12.5,27,-3},{24,24.5,-4},{30.5,13,-4.5},{29.5,-3,-4.5},{23.5,-14.5,-4},{14.5,-25.5,-2},{5,-24,-.5},{.3,-7.65,.5},{.3,7,.5}})},
        {"ear.edge", .64, in_ear_plane({{1.5,21,1.5},{13,31,.5},{26.5,28,0},{34,15,0},{33,-2,0},{26.5,-15,0},{16,-29.5,1},{6,-28.5,1.5},{1.4,-7.8,1.2},{1.2,7,1.4}})},
        {"ear.helix", .54, in_ear_plane({{3.8,19.6,4.5},{13.5,28,4.4},{25,25,4},{31,14,4},{30.2,-2.5,3.5},{24.3,-14,2.6},{15.5,-26.5,2.4},{7,-26.5,2.6},{2.6,-8,3.6},{2.4,7.5,3.8}})},
        {"ear.scapha", .43, in_ear_plane({{6.8,16.5,2},{13.5,24,1},{22.8,21.8,0},{27.3,12,-.3},{26.4,-3,0},{20.5,-12.2,1},{13.5,-21,1.8},{8.8,-19.5,2.4},{6.4,-8,5.2},{4.8,6.5,4.2}})},
        {"ear.antihelix", .32, in_ear_plane({{9.5,13.5,1.5},{13.5,18.5,2.4},{19.5,16.5,4},{23,9.5,5},{22,-2.5,5},{17.3,-9.8,4.6},{12.6,-14,4.6},{9.8,-12.5,3.6},{7.8,-6.5,3.6},{7,4.5,2.2}})},
        {"ear.concha", .21, in_ear_plane({{11.3,9.5,-1},{13.8,12.5,-2},{17.2,11,-3.5},{18.8,5.5,-6},{18,-2,-7.5},{15,-6.8,-7.5},{12.4,-8.6,-7},{10.4,-7.8,-7},{9.2,-3.5,-8},{9.8,3.4,-4}})},
    };
    // clang-format on
    cage.rings["ear.surround"] = root.points;
    const Uv centre{(root.uvs[0].u + root.uvs[5].u) / 2, (root.uvs[0].v + root.uvs[5].v) / 2};
    Loop loop = root;
    for (const Ring& ring : rings) {
        loop = add_strip(cage, loop, {ring.points, shrunk(root.uvs, centre, ring.shrink, ring.shrink), 2});
        cage.rings[ring.name] = loop.points;
    }
    // The floor of the concha: 2 by 3 cells.
    const auto& p = loop.points;
    const auto& t = loop.uvs;
    const std::vector<std::uint32_t> mid = add_points(cage, in_ear_plane({{13.6, 4.5, -6.5}, {13.2, -2, -9}}));
    const Uv m0{centre.u, (t[9].v + t[3].v) / 2}, m1{centre.u, (t[8].v + t[4].v) / 2};
    cage.quads.push_back({{p[0], p[9], mid[0], p[1]}, {t[0], t[9], m0, t[1]}});
    cage.quads.push_back({{p[1], mid[0], p[3], p[2]}, {t[1], m0, t[3], t[2]}});
    cage.quads.push_back({{p[9], p[8], mid[1], mid[0]}, {t[9], t[8], m1, m0}});
    cage.quads.push_back({{mid[0], mid[1], p[4], p[3]}, {m0, m1, t[4], t[3]}});
    cage.quads.push_back({{p[8], p[7], p[6], mid[1]}, {t[8], t[7], t[6], m1}});
    cage.quads.push_back({{mid[1], p[6], p[5], p[4]}, {m1, t[6], t[5], t[4]}});
}

std::vector<Stroke> ear_strokes() {
    const Vec3 origin = ear_point({0, 0, 0});
    std::vector<Stroke> strokes;
    for (const Relief& r : reliefs)
        strokes.push_back(
            {ear_point({r.u0, r.v0, 2}), ear_point({r.u1, r.v1, 2}), r.radius, ear_point({0, 0, r.rise}) - origin});
    return strokes;
}

void add_nostril(Cage& cage, const Loop& rim) {
    const Uv centre{(rim.uvs[0].u + rim.uvs[2].u) / 2, (rim.uvs[0].v + rim.uvs[2].v) / 2};
    // Corners: front inner, front outer, back outer, back inner.
    Loop loop = add_strip(cage, rim,
                          {{{6.2, -38.6, 110.3}, {12.4, -38.6, 105}, {12.3, -40, 101}, {7.3, -40.8, 103.4}},
                           shrunk(rim.uvs, centre, .7, .7),
                           1});
    cage.rings["nostril.rim"] = loop.points;
    loop = add_strip(cage, loop,
                     {{{6.6, -33, 107.5}, {11, -33, 104.5}, {11, -33.5, 101.5}, {7.3, -33.5, 103}},
                      shrunk(rim.uvs, centre, .4, .4),
                      2,
                      Region::inner_mouth});
    cage.quads.push_back({{loop.points[0], loop.points[3], loop.points[2], loop.points[1]},
                          {loop.uvs[0], loop.uvs[3], loop.uvs[2], loop.uvs[1]},
                          Region::inner_mouth});
}

}  // namespace mien::samples
