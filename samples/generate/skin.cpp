// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "skin.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "eyeball.hpp"
#include "head_cage.hpp"
#include "sculpt.hpp"

namespace mien::samples {
namespace {

// Lips touch but must not coincide: readers join vertices at the same place. A fifth of a millimetre is seven times the
// largest joining distance of mien and cannot be seen.
constexpr double lip_gap = 0.2;
constexpr double lid_clearance = 0.35;

void set_mirrored(MirroredSurface& mesh, std::uint32_t v, const Vec3& p) {
    const bool midline = mesh.mirror[v] == v;
    mesh.surface.positions[v] = {midline ? 0.0 : p.x, p.y, p.z};
    if (!midline) mesh.surface.positions[mesh.mirror[v]] = {-p.x, p.y, p.z};
}

// The upper and the lower half of a lip loop meet: same place but for the gap.
void close_lips(Skin& skin, const char* ring) {
    const auto& points = skin.cage.rings.at(ring);
    const std::vector<std::uint32_t> loop = chain(skin.mesh, points);
    for (std::size_t i = 0; i < loop.size() / 2; ++i) {
        const Vec3 a = skin.mesh.surface.positions[loop[i]], b = skin.mesh.surface.positions[loop[loop.size() - 1 - i]];
        const Vec3 middle = 0.5 * (a + b), half_gap{0, lip_gap / 2, 0};
        set_mirrored(skin.mesh, loop[i], middle + half_gap);
        set_mirrored(skin.mesh, loop[loop.size() - 1 - i], middle - half_gap);
    }
}

// Nothing of the skin near the eye may come closer to its centre than the eyeball reaches.
void clear_eyeball(MirroredSurface& mesh) {
    for (std::uint32_t v = 0; v < mesh.surface.positions.size(); ++v) {
        const Vec3 d = mesh.surface.positions[v] - left_eye_centre;
        const double r = length(d);
        const double least = eye_reach(std::acos(std::clamp(d.z / r, -1.0, 1.0))) + lid_clearance;
        if (r < least) set_mirrored(mesh, v, left_eye_centre + (least / r) * d);
    }
}

// The back edge of the lids lies on the globe; towards the inner corner, where the globe is not, the lids leave it.
void seat_lids(Skin& skin, const char* ring) {
    auto loop = skin.cage.rings.at(ring);
    loop.push_back(loop.front());
    for (const auto v : chain(skin.mesh, loop)) {
        const Vec3 d = skin.mesh.surface.positions[v] - left_eye_centre;
        const double r = length(d), seat = eye_reach(std::acos(std::clamp(d.z / r, -1.0, 1.0))) + lid_clearance;
        const double share = std::clamp((r - 13.2) / 1.6, 0.0, 1.0);
        set_mirrored(skin.mesh, v, left_eye_centre + ((seat + share * (r - seat)) / r) * d);
    }
}

void settle_midline(MirroredSurface& mesh) {
    for (std::uint32_t v = 0; v < mesh.mirror.size(); ++v)
        if (mesh.mirror[v] >= v) set_mirrored(mesh, v, mesh.surface.positions[v]);
}

void sculpt(MirroredSurface& mesh, std::span<const Stroke> strokes) {
    for (std::uint32_t v = 0; v < mesh.mirror.size(); ++v) {
        const Vec3 p = mesh.surface.positions[v];
        if (mesh.mirror[v] >= v) set_mirrored(mesh, v, p + stroke_sum(strokes, p));
    }
}

Colour mix(const Colour& a, const Colour& b, double t) {
    return {a.r + t * (b.r - a.r), a.g + t * (b.g - a.g), a.b + t * (b.b - a.b), 1};
}

// By region: skin, lid margin, lip, inner mouth.
constexpr std::array<Colour, 4> region_colours{{{.62, .37, .27}, {.55, .27, .22}, {.47, .18, .16}, {.28, .07, .07}}};
constexpr Colour brow_colour{.13, .08, .05};

// 1 in the middle of the left eyebrow, 0 off it: a band along an arch that tapers outwards.
double brow_share(const Vec3& p) {
    const double x = std::abs(p.x), t = (x - 11) / 40;
    if (t < 0 || t > 1 || p.z < 40) return 0;
    const double middle = 22.5 + 6.5 * std::sin(std::numbers::pi * std::pow(t, 1.15) * .8);
    const double half_width = 3.8 - 2.2 * t;
    const double ends = std::clamp(12 * t, 0.0, 1.0) * std::clamp(6 * (1 - t), 0.0, 1.0);
    return .8 * ends * std::clamp(1.4 - std::abs(p.y - middle) / half_width, 0.0, 1.0);
}

// A vertex shows the mean of the regions round it, so that borders are soft.
std::vector<Colour> colours_of(const Surface& skin) {
    std::vector<Colour> sums(skin.positions.size(), Colour{0, 0, 0, 0});
    for (const SurfaceFace& face : skin.faces)
        for (const auto c : face.corners) {
            const Colour& region = region_colours[static_cast<std::size_t>(face.region)];
            sums[c] = {sums[c].r + region.r, sums[c].g + region.g, sums[c].b + region.b, sums[c].a + 1};
        }
    for (std::size_t v = 0; v < sums.size(); ++v) {
        const double n = sums[v].a;
        sums[v] = mix({sums[v].r / n, sums[v].g / n, sums[v].b / n, 1}, brow_colour, brow_share(skin.positions[v]));
    }
    return sums;
}

}  // namespace

Skin make_skin() {
    Skin skin{head_cage(), {}};
    skin.mesh = limit_surface(skin.cage);
    skin.mesh.surface.name = "head";
    settle_midline(skin.mesh);
    sculpt(skin.mesh, face_strokes());
    sculpt(skin.mesh, ear_strokes());
    close_lips(skin, "mouth.contact");
    close_lips(skin, "mouth.behind");
    seat_lids(skin, "eye.margin_back");
    clear_eyeball(skin.mesh);
    skin.mesh.surface.materials = {{"skin", {1, 1, 1, 1}, 0.55}};
    skin.mesh.surface.colours = colours_of(skin.mesh.surface);
    return skin;
}

}  // namespace mien::samples
