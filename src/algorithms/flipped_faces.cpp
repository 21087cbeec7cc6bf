// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "algorithms/flipped_faces.hpp"

#include <algorithm>

#include "algorithms/area_vector.hpp"

namespace mien {

FlippedFaces flipped_faces(const Mesh& mesh, std::span<const Vec3f> wanted, std::span<const Vec3f> found,
                           double least) {
    const auto is_moved = [&](std::uint32_t v) {
        const Vec3 rest = to_double(mesh.positions[v]);
        const auto far = [&](const Vec3f& to) {
            const Vec3 d = to_double(to) - rest;
            return dot(d, d) > least * least;
        };
        return far(wanted[v]) || far(found[v]);
    };
    FlippedFaces faces;
    for (std::size_t f = 0; f < face_count(mesh); ++f) {
        const auto corners = face(mesh, f);
        if (std::none_of(corners.begin(), corners.end(), is_moved)) continue;
        ++faces.moving;
        if (dot(area_vector(wanted, corners), area_vector(found, corners)) < 0) ++faces.flipped;
    }
    return faces;
}

double share(const FlippedFaces& faces) {
    return faces.moving > 0 ? static_cast<double>(faces.flipped) / static_cast<double>(faces.moving) : 0;
}

FlippedFaces& operator+=(FlippedFaces& sum, const FlippedFaces& more) {
    sum.moving += more.moving;
    sum.flipped += more.flipped;
    return sum;
}

}  // namespace mien
