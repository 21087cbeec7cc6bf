// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "sculpt.hpp"

#include <algorithm>

#include "noise.hpp"

namespace mien::samples {
namespace {

// clang-format off
constexpr Stroke strokes[]{
    // philtrum, its ridges, cupid's bow, tubercle
    {{0,-45.5,103.5}, {0,-55,105.5}, 3.6, {0,0,-1.3}},
    {{3.6,-46,103.5}, {4.8,-55.5,106.3}, 3, {0,0,.6}},
    {{0,-57.4,106.5}, {0,-57.4,106.5}, 4.2, {0,-.9,0}},
    {{4.8,-56.2,107}, {4.8,-56.2,107}, 4, {0,.5,.2}},
    {{0,-62.5,108}, {0,-62.5,108}, 4, {0,0,.5}},
    // corner of the mouth, nasolabial fold and the cheek beside it
    {{29,-65.8,88}, {29,-65.8,88}, 5, {-.3,0,-1.6}},
    {{21.5,-40,93.5}, {28,-54,91}, 5, {-.2,0,-1}},
    {{28,-54,91}, {32,-64,87}, 6, {-.2,0,-.8}},
    {{36,-44,87}, {38,-50,84}, 14, {.8,0,1.2}},
    // wing of the nose, its crease, supratip
    {{16.5,-34,100}, {16.5,-35,99}, 7, {.3,0,.3}},
    {{16.5,-27.5,98}, {20,-32,93.5}, 3.4, {-1.1,0,-1.3}},
    {{20,-32,93.5}, {18.5,-39,95}, 3.4, {-1.1,0,-1.3}},
    {{0,-23.5,113.5}, {0,-23.5,113.5}, 6, {0,0,-.7}},
    {{5.5,-31,117}, {5.5,-31,117}, 5.5, {.5,0,.3}},
    // tear trough, inner orbit, outer brow, temple
    {{15,-10,84}, {28,-18,84}, 5.5, {0,0,-.9}},
    {{16,9,85}, {20,11,85}, 7, {0,0,-1.3}},
    {{42,22,82}, {48,20,77}, 12, {.5,0,1}},
    {{64,18,50}, {64,22,46}, 22, {-1.2,0,-.6}},
    // cheek bone and the hollow under it
    {{46,-24,77}, {60,-22,55}, 18, {1.4,0,1.6}},
    {{50,-54,66}, {56,-56,48}, 18, {-1.6,0,-.8}},
    // chin
    {{0,-98,101}, {6,-99,100}, 12, {0,0,.6}},
    // sternomastoid, the notch over the breast bone, larynx
    {{58,-66,-16}, {22,-172,27}, 13, {1.8,0,1.6}},
    {{0,-172,32}, {0,-160,34}, 15, {0,0,-3}},
    {{0,-134,40}, {0,-138,40}, 12, {0,0,1.2}},
};
// clang-format on

Vec3 swollen_once(const Swell& s, const Vec3& p) {
    const Vec3 d = p - s.centre;
    const double share = 1 - smooth_step(s.inner, s.outer, length(d));
    return s.centre + (1 + (s.scale - 1) * share) * d;
}

}  // namespace

double share(const Vec3& from, const Vec3& to, double radius, const Vec3& place) {
    const Vec3 along = to - from;
    const double square = dot(along, along);
    const double t = square == 0 ? 0 : std::clamp(dot(place - from, along) / square, 0.0, 1.0);
    const Vec3 off = place - from - t * along;
    const double d = dot(off, off) / (radius * radius);
    return d >= 1 ? 0 : (1 - d) * (1 - d);
}

Vec3 swollen(std::span<const Swell> swells, const Vec3& place) {
    Vec3 p = place;
    for (Swell s : swells) {
        const double side = p.x < 0 && s.centre.x > 0 ? -1 : 1;
        p.x *= side;
        p = swollen_once(s, p);
        p.x *= side;
    }
    return p;
}

Vec3 stroke_sum(std::span<const Stroke> all, const Vec3& place) {
    Vec3 sum;
    for (const Stroke& s : all) sum += share(s.from, s.to, s.radius, place) * s.move;
    return sum;
}

std::span<const Stroke> face_strokes() {
    return strokes;
}

}  // namespace mien::samples
