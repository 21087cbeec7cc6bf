// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Eight loops from the orbit over the lid's fold and margin into the socket. Eight points each: top inner, top, top
// outer, outer corner, bottom outer, bottom, bottom inner, inner corner.

#include "head_cage.hpp"

namespace mien::samples {

void add_eye(Cage& cage, const Loop& orbit) {
    struct Ring {
        const char* name;
        double shrink;
        int count;
        Region region;
        std::vector<Vec3> points;
    };
    // clang-format off
    const std::vector<Ring> rings{
        {"eye.hood", .86, 2, Region::skin, {{17.5,8.5,85.5},{31,12.8,84},{43.5,9.8,75.5},{48.6,.2,69.2},{45.5,-10,73},{31,-14.5,81.3},{18.5,-12.5,83},{12.3,-2,83.5}}},
        {"eye.fold", .76, 2, Region::skin, {{19,7.2,83},{31,10.8,81.3},{42,8,75.3},{47.2,.4,69.9},{43.5,-7.3,74.5},{31,-11,80.8},{20,-9,81.5},{13.7,-2,81}}},
        {"eye.lid", .66, 2, Region::skin, {{20.5,6.2,81.6},{31,8.2,82.3},{40.7,6.3,78.2},{46,.7,70.9},{41.5,-5.2,77},{31,-7.8,81.9},{21,-6.6,80.8},{14.9,-1.9,79}}},
        {"eye.margin", .55, 2, Region::skin, {{22.3,4.6,80.2},{31,5.6,82.9},{39.3,4.3,80},{44.6,1,72.3},{39.6,-3.6,79.8},{31,-5.5,82.7},{22,-4.5,79.7},{16,-1.8,77.3}}},
        {"eye.margin_back", .48, 1, Region::lid_margin, {{22.5,4.2,79},{31,5.2,81.8},{39,3.9,78.8},{44.1,1,71.6},{39.3,-3.3,78.7},{31,-5.1,81.6},{22.3,-4.2,78.7},{16.7,-1.7,76.2}}},
        {"eye.behind", .36, 2, Region::lid_margin, {{21.8,7,77},{31,9.3,78.9},{40,6.8,76},{43,.9,71.2},{40.3,-6,76},{31,-9,79.2},{21.8,-7,76.8},{19,-1.6,74.3}}},
        {"eye.socket", .22, 2, Region::lid_margin, {{21.5,9,72.5},{31,12.7,73},{40.7,8.8,72},{43.4,.5,67.5},{40.7,-8.5,72},{31,-12.6,73},{21.5,-8.8,72.5},{18.6,-1,70.5}}},
    };
    // clang-format on
    cage.rings["eye.orbit"] = orbit.points;
    const Uv centre{(orbit.uvs[0].u + orbit.uvs[4].u) / 2, (orbit.uvs[0].v + orbit.uvs[4].v) / 2};
    Loop loop = orbit;
    for (const Ring& ring : rings) {
        loop = add_strip(cage, loop,
                         {ring.points, shrunk(orbit.uvs, centre, ring.shrink, ring.shrink), ring.count, ring.region});
        cage.rings[ring.name] = loop.points;
    }
}

}  // namespace mien::samples
