// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// A face of feature points for the tests of parameters, in millimetres, pupils at the height of the origin.

#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <numbers>
#include <vector>

#include "mien/face.hpp"
#include "mien/fap.hpp"

namespace mien {

/// Every point that a parameter moves, and those that units are measured from.
inline std::vector<FeaturePoint> neutral_points() {
    const std::vector<std::pair<const char*, Vec3>> half = {
        {"2.1", {0, -120, -5}},   {"2.2", {0, -70, 8}},    {"2.3", {0, -70, 7}},    {"2.4", {23, -70, 0}},
        {"2.6", {12, -70, 5}},    {"2.8", {12, -70, 4}},   {"2.10", {0, -108, 4}},  {"3.1", {32, 6, 0}},
        {"3.3", {32, -6, 0}},     {"3.5", {32, 0, 0}},     {"3.7", {47, 0, -8}},    {"3.11", {17, 0, -2}},
        {"4.1", {12, 24, 6}},     {"4.3", {32, 30, 2}},    {"4.5", {52, 24, -12}},  {"5.1", {45, -70, -20}},
        {"5.3", {42, -30, -8}},   {"6.1", {0, -72, -8}},   {"6.2", {0, -70, -30}},  {"6.3", {14, -69, -30}},
        {"7.1", {0, -40, -90}},   {"8.1", {0, -63, 12}},   {"8.2", {0, -80, 10}},   {"8.3", {26, -70, -1}},
        {"8.5", {13, -64, 9}},    {"8.7", {13, -78, 7}},   {"9.1", {16, -42, 5}},   {"9.3", {0, -34, 25}},
        {"9.5", {10, -49, 10}},   {"9.15", {0, -50, 14}},  {"10.1", {72, 10, -80}}, {"10.3", {76, -15, -95}},
        {"10.5", {70, -45, -80}}, {"11.4", {0, 120, -70}},
    };
    std::vector<FeaturePoint> points;
    for (const auto& [id, place] : half) {
        points.push_back({id, static_cast<std::uint32_t>(points.size()), place, {}, 0});
        if (mirror_point(id) != id)
            points.push_back({std::string(mirror_point(id)),
                              static_cast<std::uint32_t>(points.size()),
                              {-place.x, place.y, place.z},
                              {},
                              0});
    }
    return points;
}

/// A stream of one frame that sends some values.
inline FapStream one_frame(std::initializer_list<std::pair<int, int>> values) {
    FapStream stream;
    FapFrame& frame = stream.frames.emplace_back();
    for (const auto& [fap, value] : values) {
        frame.mask.set(fap_index(fap));
        frame.value[fap_index(fap)] = value;
    }
    return stream;
}

/// A ball of triangles.
inline void add_ball(Mesh& mesh, const Vec3& centre, double radius) {
    constexpr std::uint32_t rings = 10, sides = 16;
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (std::uint32_t r = 0; r <= rings; ++r)
        for (std::uint32_t s = 0; s < sides; ++s) {
            const double polar = std::numbers::pi * (r + 0.01) / (rings + 0.02),
                         around = 2 * std::numbers::pi * s / sides;
            const Vec3 out{std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around), std::cos(polar)};
            mesh.positions.push_back(to_float(centre + radius * out));
        }
    for (std::uint32_t r = 0; r < rings; ++r)
        for (std::uint32_t s = 0; s < sides; ++s) {
            const std::uint32_t a = first + r * sides + s, b = first + r * sides + (s + 1) % sides;
            add_face(mesh, std::array<std::uint32_t, 4>{a, a + sides, b + sides, b});
        }
}

/// The points with two eyeballs of 11 mm behind the pupils, which are not on the mesh.
inline Face face_with_eyeballs() {
    Face face;
    for (const FeaturePoint& point : neutral_points()) face.mesh.positions.push_back(to_float(point.position));
    add_ball(face.mesh, {32, 0, -11}, 11);
    add_ball(face.mesh, {-32, 0, -11}, 11);
    face.points = neutral_points();
    return face;
}

}  // namespace mien
