// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// What every reader promises of what it returns, in one place for the tests and the fuzz targets.

#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "mien/mesh.hpp"
#include "mien/picture.hpp"
#include "mien/take.hpp"

namespace mien::hostile {

/// Whether the promise of every reader holds for this mesh.
inline bool keeps_promise(const Mesh& mesh) {
    const auto in_range = [&](std::uint32_t v) { return v < mesh.positions.size(); };
    const auto uv_finite = [](const Vec2f& uv) { return std::isfinite(uv.x) && std::isfinite(uv.y); };
    bool good = mesh.face_starts.front() == 0 && mesh.face_starts.back() == mesh.face_vertices.size();
    for (std::size_t f = 0; f < face_count(mesh); ++f)
        good = good && mesh.face_starts[f] + 3 <= mesh.face_starts[f + 1];
    for (const Part& part : mesh.parts)
        good = good && std::uint64_t{part.first_vertex} + part.vertex_count <= mesh.positions.size() &&
               std::uint64_t{part.first_face} + part.face_count <= face_count(mesh);
    good = good && (mesh.corner_uvs.empty() || mesh.corner_uvs.size() == mesh.face_vertices.size());
    return good && std::all_of(mesh.face_vertices.begin(), mesh.face_vertices.end(), in_range) &&
           std::all_of(mesh.positions.begin(), mesh.positions.end(), is_finite<float>) &&
           std::all_of(mesh.corner_uvs.begin(), mesh.corner_uvs.end(), uv_finite);
}

/// Times rise; a sample is finite or lost as a whole.
inline bool keeps_promise(const Take& take) {
    const auto whole = [](const Vec3& p) {
        return is_finite(p) || (std::isnan(p.x) && std::isnan(p.y) && std::isnan(p.z));
    };
    bool good = take.samples.size() == take.times.size() * take.points.size() && !take.times.empty();
    for (std::size_t r = 0; r < take.times.size(); ++r)
        good = good && std::isfinite(take.times[r]) && (r == 0 || take.times[r - 1] < take.times[r]);
    return good && std::all_of(take.samples.begin(), take.samples.end(), whole);
}

/// As many numbers as the size says, and some.
inline bool keeps_promise(const Picture& picture) {
    return !picture.rgba.empty() && picture.rgba.size() == std::uint64_t{4} * picture.width * picture.height;
}

/// Whether two takes hold the same names, times and samples, lost ones too.
inline bool equal(const Take& a, const Take& b) {
    const auto same = [](const Vec3& p, const Vec3& q) { return p == q || (std::isnan(p.x) && std::isnan(q.x)); };
    return a.points == b.points && a.times == b.times && a.planar == b.planar &&
           std::equal(a.samples.begin(), a.samples.end(), b.samples.begin(), b.samples.end(), same);
}

}  // namespace mien::hostile
