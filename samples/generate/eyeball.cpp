// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Globe and cornea are two spheres that meet at the limbus; sizes after the schematic eye (globe 24 mm long, corneal
// radius 7.8 mm, limbus 11.7 mm, pupil 4 mm wide).

#include "eyeball.hpp"

#include <cmath>
#include <numbers>

#include "paint.hpp"

namespace mien::samples {
namespace {

constexpr double limbus_radius = 5.85, pupil_radius = 2.0, cornea_radius = 7.8;
// The cornea's refraction lifts the iris; a flat one would look sunken, so it is a low cone.
constexpr double iris_rise = 0.7;
constexpr std::uint32_t segments = 32;
enum Part : std::uint32_t { globe, cornea };

double limbus_height() {
    return std::sqrt(eyeball_radius * eyeball_radius - limbus_radius * limbus_radius);
}
double cornea_centre() {
    return limbus_height() - std::sqrt(cornea_radius * cornea_radius - limbus_radius * limbus_radius);
}

struct Profile {
    double radius = 0, z = 0;
};

// Rings of `segments` vertices joined by quads; a profile of radius 0 is a single vertex joined by triangles.
struct Turner {
    Surface& eye;
    std::vector<std::uint32_t> ring;
    double last_radius = 0;

    std::vector<std::uint32_t> add_ring(const Profile& p) const {
        std::vector<std::uint32_t> ids;
        for (std::uint32_t s = 0; s < (p.radius == 0 ? 1U : segments); ++s) {
            const double t = 2 * std::numbers::pi * s / segments;
            ids.push_back(static_cast<std::uint32_t>(eye.positions.size()));
            eye.positions.push_back(Vec3{p.radius * std::cos(t), p.radius * std::sin(t), p.z});
        }
        return ids;
    }

    static Uv disc(double radius, std::uint32_t s, const Uv& centre) {
        const double t = 2 * std::numbers::pi * s / segments;
        return {centre.u + radius * std::cos(t), centre.v - radius * std::sin(t)};
    }

    // Joins the last ring to a new one further out or further back.
    void to(const Profile& p, Part part, double uv_radius, const Uv& centre) {
        const auto next = add_ring(p);
        for (std::uint32_t s = 0; s < segments; ++s) {
            const std::uint32_t n = (s + 1) % segments;
            const auto in = [&](std::uint32_t i) { return disc(last_radius, i, centre); };
            const auto out = [&](std::uint32_t i) { return disc(uv_radius, i, centre); };
            if (ring.size() == 1)
                eye.faces.push_back({{ring[0], next[s], next[n], no_vertex}, {in(s), out(s), out(s + 1), {}}, part});
            else if (next.size() == 1)
                eye.faces.push_back({{ring[s], next[0], ring[n], no_vertex}, {in(s), out(s), in(s + 1), {}}, part});
            else
                eye.faces.push_back(
                    {{ring[s], next[s], next[n], ring[n]}, {in(s), out(s), out(s + 1), in(s + 1)}, part});
        }
        ring = next;
        last_radius = uv_radius;
    }
};

}  // namespace

double eye_reach(double angle) {
    const double limbus_angle = std::atan2(limbus_radius, limbus_height());
    if (angle > limbus_angle) return eyeball_radius;
    const double c = cornea_centre(), s = std::sin(angle);
    return c * std::cos(angle) + std::sqrt(cornea_radius * cornea_radius - c * c * s * s);
}

Surface make_left_eye(const EyePlace& place) {
    Surface eye{"eye_left", {}, {}, {}, {}};
    eye.materials = {{"eye", {1, 1, 1, 1}, .18, "eye"}, {"cornea", {0, 0, 0, .16}, .03}};
    const double depth = limbus_height();
    Turner turner{eye, {}, 0};
    turner.ring = turner.add_ring({0, depth + iris_rise});
    constexpr Uv front{.5, .5};
    constexpr double pupil_in_picture = iris_in_picture * pupil_radius / limbus_radius;
    turner.to({pupil_radius, depth + iris_rise}, globe, pupil_in_picture, front);
    for (int i = 1; i <= 3; ++i)
        turner.to({pupil_radius + (limbus_radius - pupil_radius) * i / 3, depth + iris_rise * (3 - i) / 3}, globe,
                  pupil_in_picture + (iris_in_picture - pupil_in_picture) * i / 3, front);
    constexpr int globe_rings = 9;
    const double limbus_angle = std::atan2(limbus_radius, depth);
    for (int i = 1; i <= globe_rings; ++i) {
        const double t =
            i == globe_rings ? std::numbers::pi : limbus_angle + (std::numbers::pi - limbus_angle) * i / globe_rings;
        const double radius = i == globe_rings ? 0 : eyeball_radius * std::sin(t);
        turner.to({radius, eyeball_radius * std::cos(t)}, globe, iris_in_picture + .026 * i, front);
    }
    turner.ring = turner.add_ring({0, cornea_centre() + cornea_radius});
    turner.last_radius = 0;
    const double opening = std::asin(limbus_radius / cornea_radius);
    for (int i = 1; i <= 4; ++i) {
        const double t = opening * i / 4;
        turner.to({cornea_radius * std::sin(t), cornea_centre() + cornea_radius * std::cos(t)}, cornea, .06 * i, front);
    }
    for (Vec3& p : eye.positions) p = place.centre + place.scale * p;
    return eye;
}

}  // namespace mien::samples
