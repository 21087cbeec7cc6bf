// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "hairs.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "noise.hpp"
#include "shell.hpp"

namespace mien::samples {
namespace {

Vec3 unit(const Vec3& v) {
    return v / length(v);
}

// A ribbon along `line`, as wide as `width` at its root and a point at its tip.
void add_ribbon(Surface& hairs, const std::vector<Vec3>& line, const Vec3& side, double width, const Uv& uv) {
    const auto first = static_cast<std::uint32_t>(hairs.positions.size());
    const std::size_t steps = line.size() - 1;
    for (std::size_t i = 0; i < steps; ++i) {
        const double share = 1 - 0.6 * static_cast<double>(i) / static_cast<double>(steps);
        const Vec3 half = (width * share / 2) * side;
        hairs.positions.push_back(line[i] - half);
        hairs.positions.push_back(line[i] + half);
    }
    hairs.positions.push_back(line[steps]);
    for (std::uint32_t i = 0; i + 1 < steps; ++i) {
        const std::uint32_t a = first + 2 * i;
        hairs.faces.push_back({{a, a + 1, a + 3, a + 2}, {uv, uv, uv, uv}});
    }
    const std::uint32_t end = first + 2 * static_cast<std::uint32_t>(steps - 1);
    hairs.faces.push_back({{end, end + 1, end + 2, no_vertex}, {uv, uv, uv, {}}});
}

Surface with_mirror(const Surface& half) {
    Surface both = half;
    const Surface other = mirrored(half, half.name);
    const auto first = static_cast<std::uint32_t>(both.positions.size());
    both.positions.insert(both.positions.end(), other.positions.begin(), other.positions.end());
    for (SurfaceFace face : other.faces) {
        for (std::size_t k = 0; k < corner_count(face); ++k) face.corners[k] += first;
        both.faces.push_back(face);
    }
    return both;
}

// Hairs of a brow stand up at its inner end, lie along it at its outer end, and lean towards its middle line.
void add_brow_hair(Surface& brows, const BrowLook& look, const Shell& shell, const Character& character,
                   std::uint32_t i) {
    const double t = (i + scatter(i, 1)) / look.hairs;
    const double across = 2 * scatter(i, 3) - 1;
    const double taper = smooth_step(-.2, .12, t) * (1 - .75 * smooth_step(.45, 1.05, t));
    const Vec3 middle = on_curve(look.path, t), ahead = on_curve(look.path, t + .02);
    const Vec3 place = shaped(character, middle + Vec3{0, across * look.half_width * taper, 0});
    const Vec3 along = unit(shaped(character, ahead) - shaped(character, middle));
    const double upright = std::clamp(1.25 - 2.1 * t, 0.0, 1.0) - .55 * across * smooth_step(.1, .5, t);
    const Vec3 direction = unit(along + (upright + .25 * (scatter(i, 4) - .5)) * Vec3{0, 1, 0});
    const double long_as = look.length * (.75 + .4 * scatter(i, 5)) * (1 - .35 * t);
    constexpr double lifts[]{-.1, .55, .35};
    std::vector<Vec3> line;
    line.reserve(std::size(lifts));
    for (int k = 0; k < 3; ++k)
        line.push_back(raised_to(shell, place + (.5 * k * long_as) * direction, lifts[k] + .25 * scatter(i, 6)));
    const Vec3 normal = shell.normals[nearest(shell, place)];
    add_ribbon(brows, line, unit(cross(normal, direction)), look.thickness, {scatter(i, 7), .5});
}

struct LidRow {
    std::vector<Vec3> margin;  // from the inner corner outwards
    double from, to;           // stretch of it that carries lashes
    int count;
    double length, up, curl;
};

void add_lash_row(Surface& lashes, const LidRow& row, const EyePlace& eye, double thickness, std::uint32_t salt) {
    for (int i = 0; i < row.count; ++i) {
        const auto number = static_cast<std::uint32_t>(i);
        const double t = row.from + (row.to - row.from) * (i + .6 * (scatter(number, salt) - .5)) / (row.count - 1);
        const Vec3 root = on_curve(row.margin, t);
        const Vec3 out = unit(root - eye.centre);
        const double fan = (t - .42) * 1.3 + .16 * (scatter(number, salt + 1) - .5);
        const Vec3 forward = unit(out + Vec3{.55 * fan, .25 * row.up, .45});
        const Vec3 rise = unit(Vec3{fan, row.up, .25});
        const double full = row.length * (.62 + .5 * smooth_step(0, .75, t)) * (.85 + .3 * scatter(number, salt + 2)) *
                            (1 - .3 * smooth_step(.9, 1, t));
        std::vector<Vec3> line;
        for (int k = 0; k < 4; ++k) {
            const double s = k / 3.0;
            line.push_back(root + (full * s * (1 - .35 * row.curl * s)) * forward + (full * row.curl * s * s) * rise);
        }
        add_ribbon(lashes, line, unit(cross(forward, rise)), thickness, {scatter(number, salt + 3), .5});
    }
}

double channel(double srgb) {
    const double c = srgb / 255;
    return c <= .04045 ? c / 12.92 : std::pow((c + .055) / 1.055, 2.4);
}

Material hair_material(const char* name, const Tint& tint) {
    return {name, linear(tint), .85, {}, true};
}

// The lid's edge from the inner corner outwards; first over the top, then along the bottom.
std::vector<Vec3> lid_edge(const Skin& skin, bool upper) {
    const auto& ring = skin.cage.rings.at("eye.margin");
    const std::vector<std::uint32_t> stops = upper ? std::vector{ring[7], ring[0], ring[1], ring[2], ring[3]}
                                                   : std::vector{ring[7], ring[6], ring[5], ring[4], ring[3]};
    std::vector<Vec3> edge;
    for (const auto v : chain(skin.mesh, stops)) edge.push_back(skin.mesh.surface.positions[v]);
    return edge;
}

}  // namespace

Colour linear(const Tint& tint) {
    const auto rounded = [](double c) { return std::round(channel(c) * 10000) / 10000; };
    return {rounded(tint.x), rounded(tint.y), rounded(tint.z), 1};
}

Surface make_brows(const Character& character, const Skin& skin) {
    Surface half{"eyebrows", {}, {}, {hair_material("brow", character.brow.colour)}, {}};
    const Shell shell = shell_of(skin.mesh.surface, [&](std::uint32_t v) {
        const Vec3& p = skin.neutral[v];
        return p.x >= 0 && p.y > 14 && p.y < 60 && p.z > 30;
    });
    for (int i = 0; i < character.brow.hairs; ++i)
        add_brow_hair(half, character.brow, shell, character, static_cast<std::uint32_t>(i));
    return with_mirror(half);
}

Surface make_lashes(const Character& character, const Skin& skin) {
    Surface half{"eyelashes", {}, {}, {hair_material("lash", character.lash.colour)}, {}};
    const EyePlace eye = left_eye_place(character);
    const LashLook& look = character.lash;
    add_lash_row(half, {lid_edge(skin, true), .14, .98, 40, look.upper, 1, .75}, eye, look.thickness, 20);
    add_lash_row(half, {lid_edge(skin, false), .3, .96, 22, look.lower, -1, .35}, eye, .8 * look.thickness, 40);
    return with_mirror(half);
}

}  // namespace mien::samples
