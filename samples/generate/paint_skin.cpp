// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Every texel finds the place of the neutral head that it shows, and is coloured from there: warm where blood lies near
// (cheeks, nose, ears, lips), darker round the eyes, mottled by noise.

#include <algorithm>
#include <array>
#include <cmath>

#include "noise.hpp"
#include "paint.hpp"
#include "shell.hpp"

namespace mien::samples {
namespace {

constexpr std::uint32_t size = 1024;

// What a vertex, or a texel between vertices, shows.
struct Ground {
    Vec3 place;
    double lip = 0, lid = 0, inner = 0, lashes = 0, hair = 0;
};

Ground operator+(const Ground& a, const Ground& b) {
    return {a.place + b.place, a.lip + b.lip, a.lid + b.lid, a.inner + b.inner, a.lashes + b.lashes, a.hair + b.hair};
}
Ground operator*(double s, const Ground& g) {
    return {s * g.place, s * g.lip, s * g.lid, s * g.inner, s * g.lashes, s * g.hair};
}

std::vector<Ground> grounds_of(const Skin& skin, const std::vector<double>& hair_cover) {
    std::vector<Ground> grounds(skin.neutral.size());
    std::vector<double> faces(skin.neutral.size(), 0);
    for (const SurfaceFace& face : skin.mesh.surface.faces)
        for (const auto c : face.corners) {
            faces[c] += 1;
            grounds[c].lip += face.region == Region::lip;
            grounds[c].lid += face.region == Region::lid_margin;
            grounds[c].inner += face.region == Region::inner_mouth;
        }
    for (std::size_t v = 0; v < grounds.size(); ++v) {
        grounds[v] = (1 / faces[v]) * grounds[v];
        grounds[v].place = skin.neutral[v];
        grounds[v].hair = hair_cover[v];
    }
    const auto& ring = skin.cage.rings.at("eye.margin");
    for (const auto v : chain(skin.mesh, {ring[0], ring[1], ring[2], ring[3]}))
        grounds[v].lashes = grounds[skin.mesh.mirror[v]].lashes = 1;
    for (const auto v : chain(skin.mesh, {ring[3], ring[4], ring[5]}))
        grounds[v].lashes = grounds[skin.mesh.mirror[v]].lashes = .5;
    return grounds;
}

struct Spot {
    Vec3 from, to;
    double radius, amount;
};
double sum_of(std::span<const Spot> spots, const Vec3& place) {
    double sum = 0;
    for (const Spot& s : spots) sum += s.amount * share(s.from, s.to, s.radius, place);
    return std::min(sum, 1.0);
}

// clang-format off
constexpr Spot flushed[]{
    {{38,-32,84}, {52,-24,70}, 30, .8}, {{0,-31,118}, {0,-26,114}, 17, .7}, {{16,-35,100}, {14,-36,103}, 10, .5}, {{0,-98,100}, {0,-98,100}, 20, .35},
    {{84,10,-12}, {78,-38,-2}, 26, .8}, {{0,-44,100}, {16,-45,98}, 9, .3}, {{30,26,90}, {44,24,82}, 16, .2},
};
constexpr Spot shaded[]{
    {{17,6,84}, {42,8,76}, 11, .5}, {{18,-9,83}, {30,-14,82}, 9, .55}, {{13,-2,82}, {14,4,84}, 8, .4},
    {{83,-5,-8}, {82,-14,-2}, 7, .9}, {{0,-84,97}, {14,-84,94}, 8, .25},
};
constexpr Spot pale[]{
    {{0,50,96}, {30,52,88}, 34, .5}, {{0,-4,97}, {0,-20,109}, 7, .4}, {{0,-52,104}, {8,-53,105}, 6, .2},
};
constexpr Spot bearded[]{
    {{0,-50,104}, {22,-54,96}, 11, .9}, {{0,-86,97}, {0,-106,98}, 19, 1}, {{20,-90,92}, {46,-84,50}, 19, 1}, {{48,-84,46}, {56,-60,8}, 17, 1},
    {{60,-52,12}, {66,-14,16}, 11, .8}, {{0,-116,74}, {34,-106,40}, 20, .75}, {{30,-70,88}, {34,-84,80}, 12, .6},
};
constexpr Spot painted_lid[]{{{20,7,82}, {42,7,77}, 7.5, 1}};
// clang-format on

Tint mix(const Tint& a, const Tint& b, double t) {
    return a + t * (b - a);
}
Tint times(const Tint& a, const Tint& b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}

double brow_share(const BrowLook& look, const Vec3& place) {
    if (place.z < 30 || place.y < 10 || place.y > 60) return 0;
    double share = 0;
    for (int i = 0; i <= 24; ++i) {
        const double t = i / 24.0;
        const Vec3 d = place - on_curve(look.path, t);
        const double half = look.half_width * smooth_step(-.15, .15, t) * (1 - .7 * smooth_step(.5, 1.05, t)) + .6;
        share = std::max(share, 1 - smooth_step(.4, 1.35, std::hypot(d.y, .6 * d.x) / half));
    }
    return share;
}

Tint skin_tint(const Character& character, const Ground& g) {
    const SkinLook& look = character.skin;
    const Vec3 p{std::abs(g.place.x), g.place.y, g.place.z};
    const double wide = noise(g.place / 11.0), middle = noise(g.place / 4.0), fine = noise(g.place / 1.3);
    Tint tint = look.skin;
    tint = mix(tint, look.flush, std::clamp(look.flushing * sum_of(flushed, p) + .05 * wide, 0.0, 1.0));
    tint = mix(tint, times(look.skin, {.8, .66, .66}), .4 * sum_of(shaded, p));
    tint = mix(tint, times(look.skin, {1.05, 1.06, 1.05}), .6 * sum_of(pale, p));
    tint = tint * (1 + .014 * wide + .014 * middle + .008 * fine);
    if (look.freckles > 0)
        tint = mix(tint, times(look.skin, {.72, .56, .46}),
                   look.freckles * smooth_step(.5, .7, noise(g.place / 1.2 + Vec3{5, 5, 5})) *
                       smooth_step(.1, .5, sum_of(flushed, p)));
    const double beard = sum_of(bearded, p) * (1 - .25 * (noise(g.place / .9) + 1));
    tint = mix(tint, mix(times(look.skin, {.56, .56, .6}), {66, 66, 72}, .35), look.beard * beard);
    return mix(tint, {112, 70, 60}, look.make_up * sum_of(painted_lid, p));
}

Tint lip_tint(const Character& character, const Ground& g) {
    const double off = std::abs(g.place.y + 65.1), line = noise({g.place.x / .8, g.place.y / 5, g.place.z / 5});
    Tint tint = character.skin.lips * (1 + .035 * line);
    tint = mix(times(tint, {.66, .55, .55}), tint, smooth_step(-.5, 3, off));
    return mix(tint, times(tint, {1.07, 1.1, 1.1}), share({-9, -70.5, 104.5}, {9, -70.5, 104.5}, 4.5, g.place));
}

Tint tint_of(const Character& character, const Ground& g) {
    Tint tint = skin_tint(character, g);
    tint =
        mix(tint, character.brow.colour, .34 * brow_share(character.brow, {std::abs(g.place.x), g.place.y, g.place.z}));
    const double strands = .5 + .5 * noise({g.place.x / 1.6, g.place.y / 5, g.place.z / 2});
    tint = mix(tint, mix(character.hair.dark, character.hair.light, .35),
               g.hair * (.55 + .45 * std::min(1.0, g.hair + strands)) * .95);
    tint = mix(tint, lip_tint(character, g), smooth_step(.3, .8, g.lip + .05 * noise(g.place / .9)));
    const bool nostril = g.place.z > 90 && g.place.y > -46;
    const Tint flesh = nostril ? Tint{84, 36, 32} : mix({168, 82, 78}, {186, 96, 90}, smooth_step(46, 90, g.place.z));
    tint = mix(tint, flesh, smooth_step(.2, nostril ? 1 : .7, g.inner));
    const Tint margin = mix(times(character.skin.skin, {.97, .84, .8}), times(character.skin.skin, {1, .78, .74}),
                            smooth_step(78, 75, g.place.z));
    tint = mix(tint, margin, smooth_step(.2, .9, g.lid));
    return mix(tint, character.lash.colour, g.lashes * (.5 + .4 * character.skin.make_up));
}

struct Canvas {
    std::vector<Tint> tints = std::vector<Tint>(static_cast<std::size_t>(size) * size);
    std::vector<bool> painted = std::vector<bool>(static_cast<std::size_t>(size) * size, false);
};

using Corner = std::pair<Uv, const Ground*>;

void fill(Canvas& canvas, const Character& character, const std::array<Corner, 3>& t) {
    const Uv &a = t[0].first, &b = t[1].first, &c = t[2].first;
    const double area = (b.u - a.u) * (c.v - a.v) - (c.u - a.u) * (b.v - a.v);
    if (area == 0) return;
    const auto [u0, u1] = std::minmax({a.u, b.u, c.u});
    const auto [v0, v1] = std::minmax({a.v, b.v, c.v});
    const auto texel = [](double x) { return static_cast<std::uint32_t>(std::clamp(x * size, 0.0, size - 1.0)); };
    for (std::uint32_t j = texel(v0); j <= texel(v1); ++j)
        for (std::uint32_t i = texel(u0); i <= texel(u1); ++i) {
            const double u = (i + .5) / size, v = (j + .5) / size;
            const double s = ((u - a.u) * (c.v - a.v) - (c.u - a.u) * (v - a.v)) / area;
            const double r = ((b.u - a.u) * (v - a.v) - (u - a.u) * (b.v - a.v)) / area;
            if (s < -1e-9 || r < -1e-9 || s + r > 1 + 1e-9) continue;
            const std::size_t k = static_cast<std::size_t>(j) * size + i;
            canvas.tints[k] = tint_of(character, (1 - s - r) * *t[0].second + s * *t[1].second + r * *t[2].second);
            canvas.painted[k] = true;
        }
}

// Colours run a few texels over every border, so that no filter brings in what lies beside the skin.
void bleed(Canvas& canvas) {
    for (int step = 0; step < 6; ++step) {
        const Canvas before = canvas;
        for (std::size_t j = 1; j + 1 < size; ++j)
            for (std::size_t i = 1; i + 1 < size; ++i) {
                const std::size_t k = j * size + i;
                if (before.painted[k]) continue;
                Tint sum;
                int count = 0;
                for (const std::size_t n : {k - 1, k + 1, k - size, k + size})
                    if (before.painted[n]) sum += before.tints[n], ++count;
                if (count == 0) continue;
                canvas.tints[k] = sum / static_cast<double>(count);
                canvas.painted[k] = true;
            }
    }
}

}  // namespace

Picture paint_skin(const Character& character, const Skin& skin, const std::vector<double>& hair_cover) {
    const std::vector<Ground> grounds = grounds_of(skin, hair_cover);
    Canvas canvas;
    for (const SurfaceFace& face : skin.mesh.surface.faces)
        for (std::size_t k = 1; k < 3; ++k)
            fill(canvas, character,
                 {Corner{face.uvs[0], &grounds[face.corners[0]]},
                  {face.uvs[k], &grounds[face.corners[k]]},
                  {face.uvs[k + 1], &grounds[face.corners[k + 1]]}});
    bleed(canvas);
    Picture picture{size, size, {}};
    for (std::size_t k = 0; k < canvas.tints.size(); ++k) {
        const Tint tint = canvas.painted[k] ? canvas.tints[k] : character.skin.skin;
        for (const double c : {tint.x, tint.y, tint.z})
            picture.rgba.push_back(static_cast<std::uint8_t>(std::lround(std::clamp(c, 0.0, 255.0))));
        picture.rgba.push_back(255);
    }
    return picture;
}

}  // namespace mien::samples
