// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The ear as a shell of concentric loops of ten points, from its root on the head over the back and the helix to the
// antihelix and the floor of the concha; and the pit of the nostril.

#include <cmath>

#include "head_cage.hpp"

namespace mien::samples {
namespace {

// u backwards and outwards along the ear's plane, v up along its long axis, w out of the plane.
Vec3 ear_point(const Vec3& uvw) {
    constexpr double flare = 0.48, tilt = 0.2;
    const Vec3 u{std::sin(flare), 0, -std::cos(flare)};
    const Vec3 v{0, std::cos(tilt), -std::sin(tilt)};
    const Vec3 w{std::cos(flare), 0, std::sin(flare)};
    return Vec3{70.5, -14, 6} + uvw.x * u + uvw.y * v + uvw.z * w;
}

std::vector<Vec3> in_ear_plane(const std::vector<Vec3>& points) {
    std::vector<Vec3> result;
    result.reserve(points.size());
    for (const Vec3& p : points) result.push_back(ear_point(p));
    return result;
}

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
        {"ear.root", .86, {{70.6,4,4},{72.2,8.2,-7},{73,3,-17},{72.6,-7,-20},{71.2,-18,-19.5},{69.8,-28,-15},{69.2,-34,-6},{69.4,-34,4.5},{70.3,-20,8.2},{70.4,-7,8.6}}},
        {"ear.back", .74, in_ear_plane({{3,18.6,0},{13,27,-2.5},{24,23.5,-3},{30,11,-3},{28,-4,-3},{20.5,-16,-2.5},{12,-26.5,-2},{3,-22.5,-.2},{.2,-6,.5},{.2,7,.5}})},
        {"ear.edge", .64, in_ear_plane({{1.8,20.5,2},{14,31,.5},{27,27,0},{34,13,0},{32,-4,0},{24,-17.5,0},{13.5,-29.5,.5},{4.5,-27,1},{.6,-6.5,2.4},{.4,7.5,2}})},
        {"ear.helix", .54, in_ear_plane({{4,19.8,4.2},{14,28.5,3.5},{25.5,25,3},{31.5,12,3},{29.3,-4,2.5},{22,-16.5,2},{12.8,-27,2},{6,-25,2.5},{2.8,-6.5,5},{2.4,7.5,4}})},
        {"ear.scapha", .43, in_ear_plane({{8,16.5,1.5},{14.5,23.5,.5},{22.5,20.5,.5},{26.5,10,.5},{24.5,-3.5,.5},{18.5,-13,1},{12,-19.5,1.5},{8,-17,2},{6.2,-7,3.5},{6,6,2}})},
        {"ear.antihelix", .32, in_ear_plane({{10,13,1},{14.5,17.5,2},{19,15,3},{21.5,7.5,3.5},{20,-3,3.5},{15.5,-10,3},{11.5,-12.5,3},{9.5,-11.5,2},{7.5,-7.5,2},{7.5,4,.5}})},
        {"ear.concha", .21, in_ear_plane({{10.5,9,-4},{13,10,-4},{16,8.5,-5},{17,4,-6},{16,-2,-6},{13.5,-6,-6},{11.5,-7,-5.5},{10,-6.5,-5},{9,-3,-5},{9,3,-5}})},
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
    const std::vector<std::uint32_t> mid = add_points(cage, in_ear_plane({{12.8, 4, -7}, {12.5, -2, -7}}));
    const Uv m0{centre.u, (t[9].v + t[3].v) / 2}, m1{centre.u, (t[8].v + t[4].v) / 2};
    cage.quads.push_back({{p[0], p[9], mid[0], p[1]}, {t[0], t[9], m0, t[1]}});
    cage.quads.push_back({{p[1], mid[0], p[3], p[2]}, {t[1], m0, t[3], t[2]}});
    cage.quads.push_back({{p[9], p[8], mid[1], mid[0]}, {t[9], t[8], m1, m0}});
    cage.quads.push_back({{mid[0], mid[1], p[4], p[3]}, {m0, m1, t[4], t[3]}});
    cage.quads.push_back({{p[8], p[7], p[6], mid[1]}, {t[8], t[7], t[6], m1}});
    cage.quads.push_back({{mid[1], p[6], p[5], p[4]}, {m1, t[6], t[5], t[4]}});
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
