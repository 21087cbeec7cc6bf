// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/check_mesh.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "mien/algorithms/weld.hpp"

namespace mien {

namespace {

// An edge of a face between two places, lower place first; `forward` says that the face runs from low to high.
struct Edge {
    std::uint32_t low, high;
    bool forward;
};

// Twice the area of a polygon, from the fan of its first corner.
double doubled_area(const Mesh& mesh, std::span<const std::uint32_t> corners) {
    Vec3 sum;
    const Vec3 origin = to_double(mesh.positions[corners[0]]);
    for (std::size_t k = 1; k + 1 < corners.size(); ++k)
        sum +=
            cross(to_double(mesh.positions[corners[k]]) - origin, to_double(mesh.positions[corners[k + 1]]) - origin);
    return length(sum);
}

double longest_side_squared(const Mesh& mesh, std::span<const std::uint32_t> corners) {
    double longest = 0;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const Vec3 side =
            to_double(mesh.positions[corners[k]]) - to_double(mesh.positions[corners[(k + 1) % corners.size()]]);
        longest = std::max(longest, dot(side, side));
    }
    return longest;
}

void count_faces(const Mesh& mesh, MeshCheck& check) {
    constexpr double flat = 1e-9;  // area relative to the square of the longest side
    for (std::size_t f = 0; f < face_count(mesh); ++f) {
        const auto corners = face(mesh, f);
        (corners.size() == 3 ? check.triangles : corners.size() == 4 ? check.quads : check.larger_faces) += 1;
        if (doubled_area(mesh, corners) <= flat * longest_side_squared(mesh, corners)) ++check.flat_faces;
    }
}

void count_repeated_faces(const Mesh& mesh, const Weld& joined, MeshCheck& check) {
    std::vector<std::vector<std::uint32_t>> faces(face_count(mesh));
    for (std::size_t f = 0; f < faces.size(); ++f) {
        for (const std::uint32_t v : face(mesh, f)) faces[f].push_back(joined.place[v]);
        std::sort(faces[f].begin(), faces[f].end());
    }
    std::sort(faces.begin(), faces.end());
    for (std::size_t f = 1; f < faces.size(); ++f) check.repeated_faces += faces[f] == faces[f - 1] ? 1 : 0;
}

std::vector<Edge> sorted_edges(const Mesh& mesh, const Weld& joined) {
    std::vector<Edge> edges;
    edges.reserve(mesh.face_vertices.size());
    for (std::size_t f = 0; f < face_count(mesh); ++f) {
        const auto corners = face(mesh, f);
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const std::uint32_t a = joined.place[corners[k]];
            const std::uint32_t b = joined.place[corners[(k + 1) % corners.size()]];
            if (a != b) edges.push_back({std::min(a, b), std::max(a, b), a < b});
        }
    }
    std::stable_sort(edges.begin(), edges.end(),
                     [](const Edge& a, const Edge& b) { return a.low != b.low ? a.low < b.low : a.high < b.high; });
    return edges;
}

void count_edges(const std::vector<Edge>& edges, MeshCheck& check) {
    for (std::size_t first = 0; first < edges.size();) {
        std::size_t last = first;
        while (last < edges.size() && edges[last].low == edges[first].low && edges[last].high == edges[first].high)
            ++last;
        const std::size_t faces = last - first;
        if (faces == 1) ++check.border_edges;
        if (faces > 2) ++check.nonmanifold_edges;
        if (faces == 2 && edges[first].forward == edges[first + 1].forward) ++check.mixed_edges;
        first = last;
    }
}

void count_islands(const Mesh& mesh, const Weld& joined, MeshCheck& check) {
    std::vector<bool> used(vertex_count(mesh), false);
    for (const std::uint32_t v : mesh.face_vertices) used[v] = true;
    check.unused_vertices = static_cast<std::size_t>(std::count(used.begin(), used.end(), false));
    const std::vector<std::uint32_t> island = islands(mesh, joined);
    std::vector<std::uint32_t> with_faces;
    for (std::size_t v = 0; v < used.size(); ++v)
        if (used[v]) with_faces.push_back(island[joined.place[v]]);
    std::sort(with_faces.begin(), with_faces.end());
    check.islands = static_cast<std::size_t>(std::unique(with_faces.begin(), with_faces.end()) - with_faces.begin());
}

}  // namespace

MeshCheck check_mesh(const Mesh& mesh) {
    const Weld joined = weld(mesh, {0});
    MeshCheck check;
    check.places = joined.vertex.size();
    count_faces(mesh, check);
    count_repeated_faces(mesh, joined, check);
    count_edges(sorted_edges(mesh, joined), check);
    count_islands(mesh, joined, check);
    return check;
}

}  // namespace mien
