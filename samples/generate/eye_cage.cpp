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
        {"eye.hood", .86, 2, Region::skin, {{18,8.5,84.5},{31,12.2,84.8},{43.5,9.8,77},{49,.8,69.3},{45.5,-10.5,73.6},{31,-15,81.6},{18.5,-12.5,82.5},{11.8,-2,82.6}}},
        {"eye.fold", .76, 2, Region::skin, {{18.8,7,82},{31,10.6,81.4},{42.2,8,74.8},{47.4,.6,69.8},{43.5,-7.8,75},{31,-11.5,81},{20,-9.3,81.3},{13.5,-2.2,80.4}}},
        {"eye.lid", .66, 2, Region::skin, {{20.5,6.3,81.6},{31,8.7,82.6},{41,6.4,78},{46.2,.9,70.9},{41.7,-5.6,77},{31,-8.3,82.1},{21,-7.1,80.7},{14.9,-2.1,78.8}}},
        {"eye.margin", .55, 2, Region::skin, {{21.8,4.4,80.2},{30.4,6.5,82.9},{39.8,4.3,79.7},{45.1,1.6,71.9},{40.2,-3.4,79.3},{31.4,-5.7,82.7},{22,-4.5,79.7},{15.9,-2.2,77.3}}},
        {"eye.margin_back", .48, 1, Region::lid_margin, {{22.2,3.9,78.9},{30.4,6,81.7},{39.3,3.8,78.5},{44.3,1.6,71.2},{39.8,-3.1,78.2},{31.4,-5.3,81.5},{22.6,-4.1,78.6},{17.2,-2.2,76.6}}},
        {"eye.behind", .36, 2, Region::lid_margin, {{21.8,7,77},{31,9.3,78.9},{40,6.8,76},{43,.9,71.2},{40.3,-6,76},{31,-9,79.2},{21.8,-7,76.8},{20.2,-1.9,75.1}}},
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
