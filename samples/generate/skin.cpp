// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "skin.hpp"

#include <algorithm>
#include <cmath>

#include "eyeball.hpp"
#include "head_cage.hpp"

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

void settle_midline(MirroredSurface& mesh) {
    for (std::uint32_t v = 0; v < mesh.mirror.size(); ++v)
        if (mesh.mirror[v] >= v) set_mirrored(mesh, v, mesh.surface.positions[v]);
}

constexpr Colour skin_colour{.60, .36, .26}, lip_colour{.42, .15, .13}, mouth_colour{.30, .07, .07},
    brow_colour{.10, .06, .04};

Colour mix(const Colour& a, const Colour& b, double t) {
    return {a.r + t * (b.r - a.r), a.g + t * (b.g - a.g), a.b + t * (b.b - a.b), 1};
}

}  // namespace

Skin make_skin() {
    Skin skin{head_cage(), {}};
    skin.mesh = limit_surface(skin.cage);
    skin.mesh.surface.name = "head";
    settle_midline(skin.mesh);
    close_lips(skin, "mouth.contact");
    close_lips(skin, "mouth.behind");
    clear_eyeball(skin.mesh);
    skin.mesh.surface.materials = {{"skin", {1, 1, 1, 1}, 0.55}};
    skin.mesh.surface.colours.assign(skin.mesh.surface.positions.size(), mix(skin_colour, lip_colour, 0));
    return skin;
}

}  // namespace mien::samples
