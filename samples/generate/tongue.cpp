// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Sections across the mouth from the tip to the root; the tip lies at the border of the upper and lower teeth.

#include <cmath>
#include <numbers>

#include "mouth_parts.hpp"

namespace mien::samples {
namespace {

struct Section {
    double z, half_width, top, bottom;
};
constexpr std::array<Section, 10> sections{{{88.2, 4.5, -64.7, -67.4},
                                            {86.5, 8, -63.8, -68.6},
                                            {83.5, 11, -63, -70.4},
                                            {79, 13, -62.2, -72.6},
                                            {74, 14.5, -61.4, -74.6},
                                            {69, 15.5, -60.8, -76.2},
                                            {64, 16, -60.6, -77.4},
                                            {59, 16, -61.2, -78},
                                            {54, 14, -63, -78},
                                            {50.5, 9, -66, -77}}};
constexpr std::uint32_t half_ring = 9;  // points from the midline above to the midline below

Vec3 on_section(const Section& s, std::uint32_t k) {
    const double t = std::numbers::pi * k / (half_ring - 1);
    const double side = std::pow(std::sin(t), .8), height = std::cos(t), middle = (s.top + s.bottom) / 2;
    const double groove = k == 0 ? .8 : 0;
    return {k == 0 || k == half_ring - 1 ? 0.0 : s.half_width * side, middle + (s.top - s.bottom) / 2 * height - groove,
            s.z};
}

}  // namespace

Tongue make_tongue() {
    Surface half{"tongue", {}, {}, {{"tongue", {.48, .16, .16, 1}, .4}}, {}};
    const auto count = static_cast<std::uint32_t>(sections.size());
    half.positions.push_back({0, -66, 89.2});
    for (const Section& s : sections)
        for (std::uint32_t k = 0; k < half_ring; ++k) half.positions.push_back(on_section(s, k));
    const auto root = static_cast<std::uint32_t>(half.positions.size());
    half.positions.push_back({0, -71.5, 49});
    const auto at = [&](std::uint32_t s, std::uint32_t k) { return 1 + s * half_ring + k; };
    const auto uv = [&](double s, double k) { return Uv{.5 + .48 * k / (half_ring - 1), .03 + .9 * s / count}; };
    for (std::uint32_t k = 0; k + 1 < half_ring; ++k) {
        half.faces.push_back(
            {{0, at(0, k + 1), at(0, k), no_vertex}, {uv(-.3, k + .5), uv(0, k + 1), uv(0, k), {}}, 0});
        for (std::uint32_t s = 0; s + 1 < count; ++s)
            half.faces.push_back({{at(s, k), at(s, k + 1), at(s + 1, k + 1), at(s + 1, k)},
                                  {uv(s, k), uv(s, k + 1), uv(s + 1, k + 1), uv(s + 1, k)},
                                  0});
        half.faces.push_back({{root, at(count - 1, k), at(count - 1, k + 1), no_vertex},
                              {uv(count, k + .5), uv(count - 1, k), uv(count - 1, k + 1), {}},
                              0});
    }
    Tongue tongue{joined_with_mirror(half), 0, at(5, 0), at(5, half_ring / 2), 0};
    const Vec3 border = tongue.surface.positions[tongue.left_border];
    for (std::uint32_t i = 0; i < tongue.surface.positions.size(); ++i)
        if (tongue.surface.positions[i] == Vec3{-border.x, border.y, border.z}) tongue.right_border = i;
    return tongue;
}

}  // namespace mien::samples
