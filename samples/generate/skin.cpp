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

// How far the eyeball reaches in the direction of a place, with clearance.
double seat_of(const EyePlace& eye, const Vec3& from_centre) {
    const double angle = std::acos(std::clamp(from_centre.z / length(from_centre), -1.0, 1.0));
    return eye.scale * eye_reach(angle) + lid_clearance;
}

// Nothing of the skin near the eye may come closer to its centre than the eyeball reaches.
void clear_eyeball(MirroredSurface& mesh, const EyePlace& eye) {
    for (std::uint32_t v = 0; v < mesh.surface.positions.size(); ++v) {
        const Vec3 d = mesh.surface.positions[v] - eye.centre;
        const double r = length(d), least = seat_of(eye, d);
        if (r < least) set_mirrored(mesh, v, eye.centre + (least / r) * d);
    }
}

// The back edge of the lids lies on the globe; towards the inner corner, where the globe is not, the lids leave it.
void seat_lids(Skin& skin, const char* ring, const EyePlace& eye) {
    auto loop = skin.cage.rings.at(ring);
    loop.push_back(loop.front());
    for (const auto v : chain(skin.mesh, loop)) {
        const Vec3 d = skin.mesh.surface.positions[v] - eye.centre;
        const double r = length(d), seat = seat_of(eye, d);
        const double share = std::clamp((r / eye.scale - 13.2) / 1.6, 0.0, 1.0);
        set_mirrored(skin.mesh, v, eye.centre + ((seat + share * (r - seat)) / r) * d);
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

}  // namespace

Skin make_skin(const Character& character) {
    Skin skin{head_cage(), {}, {}};
    skin.mesh = limit_surface(skin.cage);
    skin.mesh.surface.name = "head";
    settle_midline(skin.mesh);
    sculpt(skin.mesh, face_strokes());
    sculpt(skin.mesh, ear_strokes());
    skin.neutral = skin.mesh.surface.positions;
    for (std::uint32_t v = 0; v < skin.mesh.mirror.size(); ++v)
        if (skin.mesh.mirror[v] >= v) set_mirrored(skin.mesh, v, shaped(character, skin.neutral[v]));
    close_lips(skin, "mouth.contact");
    close_lips(skin, "mouth.behind");
    const EyePlace eye = left_eye_place(character);
    seat_lids(skin, "eye.margin_back", eye);
    clear_eyeball(skin.mesh, eye);
    skin.mesh.surface.materials = {{"skin", {1, 1, 1, 1}, 0.5, "skin"}};
    return skin;
}

}  // namespace mien::samples
