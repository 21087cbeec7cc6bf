// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "surface.hpp"

#include <algorithm>
#include <cmath>

namespace mien::samples {
namespace {

SurfaceFace turned_over(SurfaceFace face) {
    const auto n = static_cast<std::ptrdiff_t>(corner_count(face));
    std::reverse(face.corners.begin(), face.corners.begin() + n);
    std::reverse(face.uvs.begin(), face.uvs.begin() + n);
    return face;
}

double rounded(double value) {
    return std::round(value * 1000) / 1000 + 0.0;
}

}  // namespace

Surface mirrored(const Surface& surface, const std::string& name) {
    Surface result = surface;
    result.name = name;
    for (Vec3& p : result.positions) p.x = -p.x;
    for (SurfaceFace& face : result.faces) face = turned_over(face);
    return result;
}

Surface joined_with_mirror(const Surface& half) {
    Surface result = half;
    std::vector<std::uint32_t> other;
    for (std::uint32_t i = 0; i < half.positions.size(); ++i) {
        const Vec3 p = half.positions[i];
        other.push_back(p.x == 0 ? i : static_cast<std::uint32_t>(result.positions.size()));
        if (p.x != 0) result.positions.push_back({-p.x, p.y, p.z});
    }
    for (SurfaceFace face : half.faces) {
        for (std::size_t k = 0; k < corner_count(face); ++k) face.corners[k] = other[face.corners[k]];
        for (Uv& uv : face.uvs) uv.u = 1 - uv.u;
        result.faces.push_back(turned_over(face));
    }
    return result;
}

std::vector<Vec3> vertex_normals(const Surface& surface) {
    std::vector<Vec3> normals(surface.positions.size());
    for (const SurfaceFace& face : surface.faces) {
        const std::size_t n = corner_count(face);
        const auto at = [&](std::size_t k) { return surface.positions[face.corners[k]]; };
        const Vec3 normal = n == 3 ? cross(at(1) - at(0), at(2) - at(0)) : cross(at(2) - at(0), at(3) - at(1));
        for (std::size_t k = 0; k < n; ++k) normals[face.corners[k]] += normal;
    }
    for (Vec3& n : normals) n = n / length(n);
    return normals;
}

void round_positions(Surface& surface) {
    for (Vec3& p : surface.positions) p = {rounded(p.x), rounded(p.y), rounded(p.z)};
}

}  // namespace mien::samples
