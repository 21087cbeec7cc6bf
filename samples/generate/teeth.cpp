// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Two horseshoes along half ellipses. Crown widths from the incisor to the second molar are the usual textbook means
// (Ash and Nelson, Wheeler's Dental Anatomy), scaled to fill the arch.

#include <cmath>
#include <numbers>
#include <numeric>

#include "mouth_parts.hpp"

namespace mien::samples {
namespace {

constexpr int teeth = 7, stations_per_tooth = 4;

struct Arch {
    const char* name;
    double half_width, depth, back;                      // the half ellipse of the crowns' outside
    double gum, gum_line, crown, front_edge, back_edge;  // heights
    std::array<double, teeth> widths;
};
constexpr Arch upper{"teeth_upper", 27, 40, 57, -53, -57.5, -62.4, -69.4, -67, {8.5, 6.5, 7.6, 7.1, 6.6, 10.4, 9.8}};
constexpr Arch lower{"teeth_lower", 25.5,  36,    57,    -80,
                     -75.5,         -71.5, -65.6, -66.0, {5.3, 5.7, 6.8, 7.0, 7.1, 11.4, 10.8}};

Vec3 on_arch(const Arch& arch, double angle) {
    return {arch.half_width * std::sin(angle), 0, arch.back + arch.depth * std::cos(angle)};
}

// Angles at equal parts of every tooth's share of the arch's length.
std::vector<double> station_angles(const Arch& arch) {
    constexpr int steps = 4000;
    constexpr double end = 86 * std::numbers::pi / 180;
    std::vector<double> run{0};
    for (int i = 1; i <= steps; ++i)
        run.push_back(run.back() + distance(on_arch(arch, end * i / steps), on_arch(arch, end * (i - 1) / steps)));
    const double all = std::accumulate(arch.widths.begin(), arch.widths.end(), 0.0);
    std::vector<double> angles{0};
    double done = 0;
    std::size_t i = 0;
    for (const double width : arch.widths)
        for (int s = 1; s <= stations_per_tooth; ++s) {
            const double place =
                (done + (s == stations_per_tooth ? 1.0 : 1.0 * s / stations_per_tooth) * width) / all * run.back();
            while (i + 1 < run.size() && run[i + 1] < place) ++i;
            angles.push_back(end * static_cast<double>(i) / steps);
            if (s == stations_per_tooth) done += width;
        }
    return angles;
}

void add_station(Surface& half, const Arch& arch, double angle, double along, bool gap) {
    const Vec3 place = on_arch(arch, angle);
    const double slope_x = arch.depth * std::sin(angle), slope_z = arch.half_width * std::cos(angle);
    const double norm = std::hypot(slope_x, slope_z);
    const Vec3 out{angle == 0 ? 0.0 : slope_x / norm, 0, slope_z / norm};
    const double dent = gap ? .75 : 0, thick = 2 + 5.5 * along, sign = arch.gum > arch.crown ? 1 : -1;
    const double edge = arch.front_edge + (arch.back_edge - arch.front_edge) * along + (gap ? sign * .7 : 0);
    const double section[teeth_section][2]{{-.8, arch.gum},
                                           {-.2 - dent * .5, arch.gum_line + (gap ? -sign * .8 : 0)},
                                           {.3 - dent, arch.crown},
                                           {-.4 - dent, edge},
                                           {-.4 - thick + dent, edge},
                                           {-4.5 - 3.5 * along + dent, arch.crown},
                                           {-6 - 3 * along + dent * .5, arch.gum_line},
                                           {-6 - 3 * along, arch.gum}};
    for (const auto& [d, y] : section) half.positions.push_back(place + d * out + Vec3{0, y, 0});
}

// Faces look out of the tube for the upper row; the section of the lower row runs the other way round.
void add_tube(Surface& half, std::uint32_t stations, bool up) {
    constexpr std::uint32_t n = teeth_section, gum = 0, tooth = 1;
    const auto add = [&](std::array<std::uint32_t, 4> c, std::array<Uv, 4> uv, std::uint32_t material) {
        half.faces.push_back(up ? SurfaceFace{c, uv, material}
                                : SurfaceFace{{c[3], c[2], c[1], c[0]}, {uv[3], uv[2], uv[1], uv[0]}, material});
    };
    const auto uv = [&](std::uint32_t s, std::uint32_t k) {
        return Uv{.5 + .49 * s / (stations - 1), .02 + .96 * k / n};
    };
    for (std::uint32_t s = 0; s + 1 < stations; ++s)
        for (std::uint32_t k = 0; k < n; ++k) {
            const std::uint32_t a = s * n + k, b = s * n + (k + 1) % n;
            add({a, b, b + n, a + n}, {uv(s, k), uv(s, k + 1), uv(s + 1, k + 1), uv(s + 1, k)},
                k >= 1 && k <= 5 ? tooth : gum);
        }
    const std::uint32_t e = (stations - 1) * n;
    for (std::uint32_t k = 0; k < 3; ++k)
        add({e + k, e + k + 1, e + 6 - k, e + 7 - k},
            {uv(stations - 1, k), uv(stations - 1, k + 1), uv(stations - 1, 6 - k), uv(stations - 1, 7 - k)},
            k == 0 ? gum : tooth);
}

Surface make_teeth(const Arch& arch) {
    Surface half{arch.name, {}, {}, {{"gums", {.45, .14, .14, 1}, .35}, {"teeth", {.80, .76, .66, 1}, .25}}, {}};
    const std::vector<double> angles = station_angles(arch);
    for (std::size_t s = 0; s < angles.size(); ++s)
        add_station(half, arch, angles[s], static_cast<double>(s) / static_cast<double>(angles.size() - 1),
                    s % stations_per_tooth == 0);
    add_tube(half, static_cast<std::uint32_t>(angles.size()), arch.gum > arch.crown);
    return joined_with_mirror(half);
}

}  // namespace

Surface make_upper_teeth() {
    return make_teeth(upper);
}

Surface make_lower_teeth() {
    return make_teeth(lower);
}

}  // namespace mien::samples
