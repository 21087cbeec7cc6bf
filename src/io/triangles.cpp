// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Vertex normals are those of Thuermer and Wuethrich, "Computing vertex normals from polygonal facets" (1998): normals
// of triangles summed by their angle at the vertex; vertices at one place share one, so seams of texture stay
// invisible.

#include "io/triangles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>

namespace mien {

namespace {

// For each vertex the first vertex at its place.
std::vector<std::uint32_t> weld_places(std::span<const Vec3f> positions) {
    std::vector<std::uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto key = [&](std::uint32_t v) {
        return std::make_tuple(positions[v].x, positions[v].y, positions[v].z, v);
    };
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    std::vector<std::uint32_t> place(positions.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool same = i > 0 && positions[order[i]] == positions[order[i - 1]];
        place[order[i]] = same ? place[order[i - 1]] : order[i];
    }
    return place;
}

double angle_between(const Vec3& a, const Vec3& b) {
    return std::atan2(length(cross(a, b)), dot(a, b));
}

// The normal of one triangle, weighted by its angle at each of its corners.
void add_triangle(const Mesh& mesh, const std::vector<std::uint32_t>& place, const std::uint32_t* corners,
                  std::vector<Vec3>& sums) {
    std::array<std::uint32_t, 3> v{};
    std::array<Vec3, 3> p;
    for (std::size_t k = 0; k < 3; ++k) {
        v[k] = mesh.face_vertices[corners[k]];
        p[k] = to_double(mesh.positions[v[k]]);
    }
    const Vec3 normal = cross(p[1] - p[0], p[2] - p[0]);
    const double size = length(normal);
    if (!(size > 0)) return;
    for (std::size_t k = 0; k < 3; ++k) {
        const double angle = angle_between(p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]);
        sums[place[v[k]]] += (angle / size) * normal;
    }
}

}  // namespace

void append_fan(const Mesh& mesh, std::size_t f, std::vector<std::uint32_t>& corners) {
    const std::uint32_t first = mesh.face_starts[f], end = mesh.face_starts[f + 1];
    for (std::uint32_t c = first + 1; c + 1 < end; ++c) corners.insert(corners.end(), {first, c, c + 1});
}

std::vector<Vec3f> vertex_normals(const Mesh& mesh) {
    const std::vector<std::uint32_t> place = weld_places(mesh.positions);
    std::vector<Vec3> sums(mesh.positions.size());
    std::vector<std::uint32_t> corners;
    for (std::size_t f = 0; f < face_count(mesh); ++f) {
        corners.clear();
        append_fan(mesh, f, corners);
        for (std::size_t t = 0; t < corners.size(); t += 3) add_triangle(mesh, place, &corners[t], sums);
    }
    std::vector<Vec3f> normals(mesh.positions.size(), Vec3f{0, 0, 1});
    for (std::size_t v = 0; v < normals.size(); ++v) {
        const double size = length(sums[place[v]]);
        if (size > 1e-9) normals[v] = to_float(sums[place[v]] / size);
    }
    return normals;
}

SplitVertices split_at_seams(const Mesh& mesh, std::span<const std::uint32_t> corners) {
    const auto uv = [&](std::uint32_t corner) { return mesh.corner_uvs.empty() ? Vec2f{} : mesh.corner_uvs[corner]; };
    const auto key = [&](std::uint32_t corner) {
        const Vec2f at = uv(corner);
        return std::make_tuple(mesh.face_vertices[corner], at.x, at.y);
    };
    std::vector<std::uint32_t> order(corners.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return std::make_tuple(key(corners[a]), a) < std::make_tuple(key(corners[b]), b);
    });
    SplitVertices split;
    split.indices.resize(corners.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const std::uint32_t corner = corners[order[i]];
        if (i == 0 || key(corner) != key(corners[order[i - 1]])) {
            split.vertices.push_back(mesh.face_vertices[corner]);
            if (!mesh.corner_uvs.empty()) split.uvs.push_back(uv(corner));
        }
        split.indices[order[i]] = static_cast<std::uint32_t>(split.vertices.size() - 1);
    }
    return split;
}

std::vector<Vec3f> picked(std::span<const Vec3f> values, std::span<const std::uint32_t> vertices) {
    std::vector<Vec3f> result;
    result.reserve(vertices.size());
    for (const std::uint32_t v : vertices) result.push_back(values[v]);
    return result;
}

}  // namespace mien
