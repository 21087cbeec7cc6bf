// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The paper divides by the distance between feature points and by that to a vertex (Kshirsagar et al., eq. 2 and 5):
// two points on one place, or a head without extent, have no weights. Every rigger refuses them here, in one sentence.

#include "algorithms/face_check.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <set>
#include <string>

#include "mien/error.hpp"

namespace mien {

namespace {

Vec3 farthest_from(const Mesh& mesh, const Vec3& from) {
    Vec3 far = from;
    for (const Vec3f& p : mesh.positions)
        if (distance(to_double(p), from) > distance(far, from)) far = to_double(p);
    return far;
}

// Largest distance of a vertex from the line through the two vertices that lie (nearly) farthest apart, as a share of
// their distance.
double width_over_length(const Mesh& mesh) {
    const Vec3 a = farthest_from(mesh, to_double(mesh.positions.front()));
    const Vec3 b = farthest_from(mesh, a);
    const double ab = distance(a, b);
    double width = 0;
    for (const Vec3f& p : mesh.positions) width = std::max(width, length(cross((b - a) / ab, (to_double(p) - a) / ab)));
    return width;
}

void check_surface(const Mesh& mesh) {
    if (face_count(mesh) == 0)
        throw Error(fmt::format("head: expected a surface, found {} vertices and no face", vertex_count(mesh)));
    for (std::size_t v = 0; v < vertex_count(mesh); ++v)
        if (!is_finite(mesh.positions[v])) throw Error(fmt::format("head: vertex {} is not at a finite position", v));
    if (!(diagonal(bounding_box(mesh)) > 0)) throw Error("head: expected a surface, found all vertices at one point");
    if (!(width_over_length(mesh) > 1e-6)) throw Error("head: expected a surface, found all vertices on one line");
}

void check_points(const Face& face) {
    if (face.points.empty()) throw Error("feature points: expected at least one, found none");
    if (face.points.size() > 65535)
        throw Error(fmt::format("feature points: expected at most 65535, found {}", face.points.size()));
    for (const FeaturePoint& point : face.points)
        if (point.vertex >= vertex_count(face.mesh))
            throw Error(fmt::format("feature point {}: expected a vertex index below {}, found {}", point.id,
                                    vertex_count(face.mesh), point.vertex));
}

}  // namespace

void check_face(const Face& face, const Weld& weld) {
    check_surface(face.mesh);
    check_points(face);
    std::set<std::string> ids;
    std::map<std::uint32_t, std::string> id_at;
    for (const FeaturePoint& point : face.points) {
        if (!ids.insert(point.id).second)
            throw Error(fmt::format("feature point {}: expected each id once, found it twice", point.id));
        const auto [other, is_new] = id_at.emplace(weld.place[point.vertex], point.id);
        if (!is_new)
            throw Error(fmt::format("feature points {} and {}: expected two places, found both at vertex {}",
                                    other->second, point.id, point.vertex));
    }
}

}  // namespace mien
