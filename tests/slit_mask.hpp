// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// A face for tests of lids and lips: a dome with three slits, mirror symmetric about x = 0.

#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include "shapes.hpp"

namespace mien::shapes {

/// Splits the edges of row `row` between columns `first` and `last` of a grid of `columns` quads across: the faces
/// below get copies of the vertices between. Returns the first copy; they run in the order of the columns.
inline std::uint32_t cut(Mesh& mesh, std::uint32_t columns, std::uint32_t row, std::uint32_t first,
                         std::uint32_t last) {
    const auto copies = static_cast<std::uint32_t>(mesh.positions.size());
    const std::uint32_t start = row * (columns + 1);
    for (std::uint32_t i = first + 1; i < last; ++i) mesh.positions.push_back(mesh.positions[start + i]);
    for (std::size_t f = 0; f < face_count(mesh); ++f) {
        if (f / columns + 1 != row) continue;
        for (std::uint32_t c = mesh.face_starts[f]; c < mesh.face_starts[f + 1]; ++c) {
            std::uint32_t& v = mesh.face_vertices[c];
            if (v > start + first && v < start + last) v = copies + (v - start - first - 1);
        }
    }
    return copies;
}

/// A dome of 48 x 48 quads with eyes that stand open by 0.18 and a mouth whose lips are 0.01 apart, and 38 feature
/// points of lids, lips, brows, cheeks, nose and chin. Its eyes are 1.0 apart; +z is forward.
inline Face slit_mask() {
    constexpr std::uint32_t n = 48, eyes = 32, mouth = 15;
    Face face{grid(n, n, 0.0625F), {}};
    Mesh& mesh = face.mesh;
    const auto at = [](std::uint32_t i, std::uint32_t j) { return j * (n + 1) + i; };
    const std::uint32_t left = cut(mesh, n, eyes, 28, 36), right = cut(mesh, n, eyes, 12, 20),
                        lips = cut(mesh, n, mouth, 18, 30);
    const auto part = [&](std::uint32_t upper, std::uint32_t lower, std::uint32_t count, float gap) {
        for (std::uint32_t i = 0; i + 1 < count; ++i) {
            const float open = gap / 2 * std::sin(3.14159265F * static_cast<float>(i + 1) / static_cast<float>(count));
            mesh.positions[upper + i].y += open;
            mesh.positions[lower + i].y -= open;
        }
    };
    // Row `eyes` + 1 makes room for the opened slit.
    part(at(29, eyes), left, 8, 0.1F), part(at(13, eyes), right, 8, 0.1F), part(at(19, mouth), lips, 12, 0.01F);
    for (Vec3f& p : mesh.positions) {
        p -= {1.5F, 2.0F, 0};
        p.z = -0.3F * (p.x * p.x + 0.5F * p.y * p.y);
    }
    const auto add = [&](const char* id, std::uint32_t vertex) { face.points.push_back(point_at(mesh, id, vertex)); };
    const auto both = [&](const char* on_left, const char* on_right, std::uint32_t i, std::uint32_t j) {
        add(on_left, at(i, j)), add(on_right, at(n - i, j));
    };
    add("2.2", at(24, mouth)), add("2.3", lips + 5), add("2.10", at(24, 8)), add("2.1", at(24, 5));
    both("2.4", "2.5", 30, mouth), both("2.6", "2.7", 27, mouth), both("2.11", "2.12", 29, 7);
    add("2.8", lips + 8), add("2.9", lips + 2);
    both("3.7", "3.12", 36, eyes), both("3.11", "3.8", 28, eyes), both("3.1", "3.2", 32, eyes);
    add("3.3", left + 3), add("3.4", right + 3);
    both("3.13", "3.14", 32, 35), both("3.9", "3.10", 32, 29);
    both("4.1", "4.2", 28, 38), both("4.3", "4.4", 32, 39), both("4.5", "4.6", 37, 38);
    both("5.1", "5.2", 36, 17), both("5.3", "5.4", 36, 24);
    add("8.1", at(24, 17)), add("8.2", at(24, 12)), both("8.3", "8.4", 31, mouth);
    both("8.5", "8.6", 27, 17), both("8.7", "8.8", 27, 12);
    add("9.3", at(24, 24)), both("9.1", "9.2", 27, 23), add("9.15", at(24, 20)), add("9.12", at(24, 28));
    add("11.1", at(24, 46));
    return face;
}

}  // namespace mien::shapes
