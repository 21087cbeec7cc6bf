// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "paint.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "noise.hpp"

namespace mien::samples {
namespace {

Tint mix(const Tint& a, const Tint& b, double t) {
    return a + t * (b - a);
}

void put(Picture& picture, std::uint32_t x, std::uint32_t y, const Tint& tint) {
    std::uint8_t* to = &picture.rgba[4 * (static_cast<std::size_t>(y) * picture.width + x)];
    for (const double c : {tint.x, tint.y, tint.z})
        *to++ = static_cast<std::uint8_t>(std::lround(std::clamp(c, 0.0, 255.0)));
    *to = 255;
}

Picture blank(std::uint32_t width, std::uint32_t height) {
    return {width, height, std::vector<std::uint8_t>(4 * static_cast<std::size_t>(width) * height, 0)};
}

constexpr Tint white{233, 227, 222}, rim{206, 150, 140}, vein{196, 108, 100};

// r is 1 at the limbus. Threads of the iris run along the radius; a lighter collar lies round the pupil.
Tint iris_tint(const IrisLook& look, double r, double angle) {
    const Vec3 ring{9 * std::cos(angle), 9 * std::sin(angle), 1.2 * r};
    const double threads = noise(ring) + .7 * noise(2.7 * ring + Vec3{3, 1, 4});
    const double collar = smooth_step(look.pupil + .22, look.pupil + .06, r + .06 * threads);
    Tint tint = mix(look.outer, look.inner, .75 * collar + .18 * smooth_step(1, .4, r));
    tint = tint * (1 + .24 * threads);
    tint = mix(tint, .34 * look.outer, .85 * smooth_step(.8, 1, r));
    return mix({8, 7, 8}, tint, smooth_step(look.pupil - .03, look.pupil + .04, r));
}

Tint white_tint(double r, const Vec3& place) {
    const Tint tint = mix(white, rim, .5 * smooth_step(1.2, 2, r) + .05 * noise(14.0 * place));
    const double line = std::abs(noise(17.0 * place) + .4 * noise(40.0 * place));
    return mix(tint, vein, .3 * smooth_step(.05, 0, line) * smooth_step(1.15, 1.7, r));
}

}  // namespace

Picture paint_eye(const IrisLook& look) {
    constexpr std::uint32_t size = 256;
    Picture picture = blank(size, size);
    for (std::uint32_t j = 0; j < size; ++j)
        for (std::uint32_t i = 0; i < size; ++i) {
            const double u = (i + .5) / size - .5, v = (j + .5) / size - .5;
            const double r = std::sqrt(u * u + v * v) / iris_in_picture;
            put(picture, i, j,
                mix(iris_tint(look, std::min(r, 1.0), std::atan2(v, u)), white_tint(r, {u, v, 0}),
                    smooth_step(.96, 1.08, r)));
        }
    return picture;
}

Picture paint_hair(const HairLook& look) {
    constexpr std::uint32_t width = 512, height = 128;
    Picture picture = blank(width, height);
    for (std::uint32_t j = 0; j < height; ++j)
        for (std::uint32_t i = 0; i < width; ++i) {
            const double angle = 2 * std::numbers::pi * ((i + .5) / width - .02) / .96, v = (j + .5) / height;
            const Vec3 ring{std::cos(angle), std::sin(angle), 0};
            double light = .5;
            for (const double strands : {7.0, 19.0, 38.0})
                light += .3 * noise(strands * ring + Vec3{0, 0, strands + 2.2 * v});
            put(picture, i, j, mix(look.dark, look.light, std::clamp(light, 0.0, 1.0)));
        }
    return picture;
}

}  // namespace mien::samples
