// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The cap is a polar grid: columns start at the hair line and run over the skull to a pole. Each of its vertices stands
// at a height over the skin that rises from below it (so that no gap shows) to that of the cap; noise that is drawn out
// along the columns makes the strands.

#include "hair.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "noise.hpp"
#include "shell.hpp"

namespace mien::samples {
namespace {

constexpr std::uint32_t columns = 96, cap_rows = 16;
constexpr double sunk = -1.2;
constexpr Vec3 skull_middle{0, 25, 0};

Vec3 unit(const Vec3& v) {
    return v / length(v);
}

// On the great circle from a to b.
Vec3 between(const Vec3& a, const Vec3& b, double t) {
    const double angle = std::acos(std::clamp(dot(a, b), -1.0, 1.0));
    return (std::sin((1 - t) * angle) * a + std::sin(t * angle) * b) / std::sin(angle);
}

// The skull without ears, eyes and mouth.
Shell scalp_of(const Skin& skin) {
    return shell_of(skin.mesh.surface, [&](std::uint32_t v) {
        const Vec3& p = skin.neutral[v];
        const bool is_ear = std::abs(p.x) > 68 && p.y < 18 && p.y > -50 && p.z < 13 && p.z > -36 &&
                            std::abs(p.x) > 73.5 - .05 * std::abs(p.z);
        const bool is_face = p.z > 60 && p.y < 40;
        return p.y > -100 && !is_ear && !is_face;
    });
}

// s from 0 to 1 goes round from the forehead over the left side to the nape and back over the right one.
Vec3 on_hair_line(const HairLook& look, double s) {
    const double t = s <= .5 ? 2 * s : 2 - 2 * s;
    Vec3 p = on_curve(look.line, t);
    if (s > .5) p.x = -p.x;
    return p;
}

double rise_at(const HairLook& look, const Vec3& place) {
    double height = look.height;
    for (const HairRise& r : look.rises) height += r.rise * share(r.from, r.to, r.radius, place);
    return height;
}

// Strands: noise round the cap, drawn out along it; a strand drifts sideways by the twist.
double ripple(const HairLook& look, double s, double t) {
    const double angle = 2 * std::numbers::pi * (s + look.twist * t);
    const double radius = look.ripples / (2 * std::numbers::pi);
    const Vec3 ring{radius * std::cos(angle), radius * std::sin(angle), 1.3 * t};
    return noise(ring) + .5 * noise(2.3 * ring + Vec3{7, 3, 9});
}

Vec3 cap_vertex(const Character& character, const Shell& scalp, double s, double t) {
    const HairLook& look = character.hair;
    const Vec3 line = on_hair_line(look, s);
    const Vec3 from = line - skull_middle, to = look.pole - skull_middle;
    const Vec3 direction = between(unit(from), unit(to), t);
    const Vec3 place = skull_middle + ((1 - t) * length(from) + t * length(to)) * direction;
    const double run = t * std::acos(std::clamp(dot(unit(from), unit(to)), -1.0, 1.0)) * 88;
    const double grown = smooth_step(-.25 * look.edge, look.edge * (1 + .35 * ripple(look, s, 0)), run);
    const double height = grown * (rise_at(look, place) + look.ripple_depth * ripple(look, s, t));
    return raised_to(scalp, shaped(character, place), t == 0 ? sunk : std::max(height, sunk));
}

void add_cap(Surface& hair, const Character& character, const Shell& scalp) {
    const auto uv = [&](std::uint32_t c, std::uint32_t r) {
        return Uv{.02 + .96 * c / columns, .02 + .6 * r / cap_rows};
    };
    for (std::uint32_t r = 0; r < cap_rows; ++r)
        for (std::uint32_t c = 0; c < columns; ++c) {
            const double t = std::pow(static_cast<double>(r) / cap_rows, 1.35);
            hair.positions.push_back(cap_vertex(character, scalp, static_cast<double>(c) / columns, t));
        }
    const auto pole = static_cast<std::uint32_t>(hair.positions.size());
    hair.positions.push_back(
        raised_to(scalp, shaped(character, character.hair.pole), rise_at(character.hair, character.hair.pole)));
    for (std::uint32_t c = 0; c < columns; ++c) {
        const std::uint32_t n = (c + 1) % columns;
        for (std::uint32_t r = 0; r + 1 < cap_rows; ++r)
            hair.faces.push_back({{r * columns + c, r * columns + n, (r + 1) * columns + n, (r + 1) * columns + c},
                                  {uv(c, r), uv(c + 1, r), uv(c + 1, r + 1), uv(c, r + 1)}});
        const std::uint32_t last = (cap_rows - 1) * columns;
        hair.faces.push_back({{last + c, last + n, pole, no_vertex},
                              {uv(c, cap_rows - 1), uv(c + 1, cap_rows - 1), uv(c, cap_rows), {}}});
    }
}

// Faces over the rings of `round` vertices from `first` on, `steps` - 1 of them, and over the two poles that follow
// them. `uv`: the texture coordinates of vertex k of ring i, the poles being rings 0 and `steps`.
template <class UvOf>
void close_rings(Surface& hair, std::uint32_t first, std::uint32_t round, std::uint32_t steps, const UvOf& uv) {
    const std::uint32_t last = first + (steps - 2) * round, pole = last + round;
    for (std::uint32_t k = 0; k < round; ++k) {
        const std::uint32_t n = (k + 1) % round;
        hair.faces.push_back({{pole, first + n, first + k, no_vertex}, {uv(k, 0), uv(k + 1, 1), uv(k, 1), {}}});
        for (std::uint32_t i = 0; i + 2 < steps; ++i) {
            const std::uint32_t a = first + i * round;
            hair.faces.push_back({{a + k, a + n, a + round + n, a + round + k},
                                  {uv(k, i + 1), uv(k + 1, i + 1), uv(k + 1, i + 2), uv(k, i + 2)}});
        }
        hair.faces.push_back(
            {{last + k, last + n, pole + 1, no_vertex}, {uv(k, steps - 1), uv(k + 1, steps - 1), uv(k, steps), {}}});
    }
}

// A closed tube round a curve: flat, widest a third of the way along, pointed at its end, round at its start.
void add_lock(Surface& hair, const Character& character, const Shell& scalp, const Lock& lock, double side) {
    constexpr std::uint32_t round = 8, steps = 16;
    const auto first = static_cast<std::uint32_t>(hair.positions.size());
    const auto at = [&](double t) {
        const Vec3 place = on_curve(lock.path, t);
        const Vec3 off =
            kept_off(scalp, shaped(character, place), rise_at(character.hair, place) + .3 * lock.thickness);
        return Vec3{side * off.x, off.y, off.z};
    };
    const double u0 = .1 + .7 * scatter(first);
    for (std::uint32_t i = 1; i < steps; ++i) {
        const double t = static_cast<double>(i) / steps;
        const Vec3 p = at(t), along = unit(at(t + .04) - at(t - .04));
        const Vec3 out = unit(p - shaped(character, skull_middle));
        const Vec3 across = unit(cross(out, along)), up = cross(along, across);
        const double wide = std::pow(std::sin(std::numbers::pi * std::pow(t, .75)), .7);
        for (std::uint32_t k = 0; k < round; ++k) {
            const double a = 2 * std::numbers::pi * k / round;
            hair.positions.push_back(p + (lock.half_width * wide * std::cos(a)) * across +
                                     (lock.thickness * wide * std::sin(a)) * up);
        }
    }
    hair.positions.push_back(at(0));
    hair.positions.push_back(at(1));
    close_rings(hair, first, round, steps, [&](std::uint32_t k, std::uint32_t i) {
        return Uv{u0 + .1 * k / round, .05 + .9 * i / steps};
    });
}

// A ball flattened towards the head, its strands wound round it.
void add_bun(Surface& hair, const Character& character) {
    constexpr std::uint32_t round = 40, rings = 11;
    const HairLook& look = character.hair;
    const auto first = static_cast<std::uint32_t>(hair.positions.size());
    const Vec3 middle = shaped(character, look.bun);
    const auto vertex = [&](double a, double b) {
        const double wound = std::cos(7 * a + 5 * b) + .4 * std::cos(15 * a + 11 * b);
        const double r = look.bun_radius * (1 + .045 * wound * std::sin(b));
        return middle + Vec3{r * std::sin(b) * std::cos(a), r * std::sin(b) * std::sin(a), -.78 * r * std::cos(b)};
    };
    for (std::uint32_t i = 1; i < rings; ++i)
        for (std::uint32_t k = 0; k < round; ++k)
            hair.positions.push_back(
                vertex(2 * std::numbers::pi * k / round, std::numbers::pi * i / static_cast<double>(rings)));
    const auto pole = static_cast<std::uint32_t>(hair.positions.size());
    hair.positions.push_back(vertex(0, 0));
    hair.positions.push_back(vertex(0, std::numbers::pi));
    const auto uv = [&](std::uint32_t k, std::uint32_t i) {
        return Uv{.05 + .4 * k / round + .03 * i, .05 + .5 * i / rings};
    };
    for (std::uint32_t k = 0; k < round; ++k) {
        const std::uint32_t n = (k + 1) % round, last = first + (rings - 2) * round;
        hair.faces.push_back({{pole, first + n, first + k, no_vertex}, {uv(k, 0), uv(k + 1, 1), uv(k, 1), {}}});
        for (std::uint32_t i = 0; i + 2 < rings; ++i) {
            const std::uint32_t a = first + i * round;
            hair.faces.push_back({{a + k, a + n, a + round + n, a + round + k},
                                  {uv(k, i + 1), uv(k + 1, i + 1), uv(k + 1, i + 2), uv(k, i + 2)}});
        }
        hair.faces.push_back(
            {{last + k, last + n, pole + 1, no_vertex}, {uv(k, rings - 1), uv(k + 1, rings - 1), uv(k, rings), {}}});
    }
}

}  // namespace

Surface make_hair(const Character& character, const Skin& skin) {
    Surface hair{"hair", {}, {}, {{"hair", {1, 1, 1, 1}, .5, "hair"}}, {}};
    const Shell scalp = scalp_of(skin);
    add_cap(hair, character, scalp);
    for (const Lock& lock : character.hair.locks) {
        add_lock(hair, character, scalp, lock, 1);
        if (lock.both_sides) add_lock(hair, character, scalp, lock, -1);
    }
    if (character.hair.bun_radius > 0) add_bun(hair, character);
    return hair;
}

std::vector<double> hair_cover(const Character& character, const Skin& skin, const Surface& hair) {
    std::vector<double> cover(skin.mesh.surface.positions.size(), 0);
    Shell cap;  // from the third row on
    const auto row = [&](int i) { return hair.positions.begin() + std::ptrdiff_t{i} * columns; };
    cap.places.assign(row(2), row(cap_rows));
    for (std::size_t v = 0; v < cover.size(); ++v) {
        const Vec3 p = skin.mesh.surface.positions[v];
        if (skin.neutral[v].y < -75 || (skin.neutral[v].z > 60 && skin.neutral[v].y < 40)) continue;
        const double reach = distance(p, cap.places[nearest(cap, p)]) - rise_at(character.hair, skin.neutral[v]);
        cover[v] = 1 - smooth_step(1, 8, reach);
    }
    return cover;
}

}  // namespace mien::samples
