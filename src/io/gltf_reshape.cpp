// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "io/gltf_reshape.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "io/gltf_accessors.hpp"
#include "io/gltf_builder.hpp"

namespace mien {

namespace {

std::vector<Vec3> positions_of(const Mesh& mesh, const Part& part) {
    std::vector<Vec3> positions;
    for (std::uint32_t v = 0; v < part.vertex_count; ++v)
        positions.push_back(to_double(mesh.positions[part.first_vertex + v]));
    return positions;
}

// Sums of the areas round each vertex of a part, as vectors.
std::vector<Vec3> area_normals(const Mesh& mesh, const Part& part, std::span<const Vec3> positions) {
    std::vector<Vec3> normals(positions.size());
    for (std::uint32_t f = 0; f < part.face_count; ++f) {
        const std::span<const std::uint32_t> corners = face(mesh, part.first_face + f);
        if (std::any_of(corners.begin(), corners.end(),
                        [&](std::uint32_t c) { return c - part.first_vertex >= positions.size(); }))
            continue;
        const auto at = [&](std::size_t k) { return positions[corners[k] - part.first_vertex]; };
        Vec3 area;
        for (std::size_t k = 1; k + 1 < corners.size(); ++k) area += cross(at(k) - at(0), at(k + 1) - at(0));
        for (const std::uint32_t corner : corners) normals[corner - part.first_vertex] += area;
    }
    return normals;
}

// `v` by the shortest turn from one direction to another; as it is where they are opposite or none.
Vec3 turned_along(const Vec3& v, const Vec3& from, const Vec3& to) {
    const double sizes = length(from) * length(to);
    const double w = 1 + dot(from, to) / sizes;
    if (!(sizes > 0) || !(w > 1e-6)) return v;
    const Vec3 axis = cross(from, to) / sizes;
    const double norm = std::sqrt(dot(axis, axis) + w * w);
    return rotate({axis.x / norm, axis.y / norm, axis.z / norm, w / norm}, v);
}

}  // namespace

bool is_reshaped(const Mesh& mesh, const Part& part, std::span<const Vec3> placed) {
    constexpr double moved = 1e-4;  // of the part's size
    const std::vector<Vec3> now = positions_of(mesh, part);
    const double least = moved * diagonal(bounding_box(now));
    return !std::equal(now.begin(), now.end(), placed.begin(), placed.end(),
                       [&](const Vec3& a, const Vec3& b) { return distance(a, b) <= least; });
}

void turn_surface(GltfDocument& document, nlohmann::json& attributes, const Mesh& mesh, const Part& part,
                  std::span<const Vec3> placed, const std::string& pointer) {
    attributes.erase("TANGENT");
    if (!attributes.contains("NORMAL")) return;
    const std::vector<float> n =
        read_floats(document, attributes["NORMAL"].get<std::size_t>(), 3, pointer + "/attributes/NORMAL");
    const std::vector<Vec3> before = area_normals(mesh, part, placed);
    const std::vector<Vec3> now = area_normals(mesh, part, positions_of(mesh, part));
    std::vector<Vec3f> normals;
    for (std::size_t v = 0; v < std::min(n.size() / 3, now.size()); ++v) {
        const Vec3 turned = turned_along({n[3 * v], n[3 * v + 1], n[3 * v + 2]}, before[v], now[v]);
        const double size = length(turned);
        normals.push_back(size > 0 ? to_float(turned / size) : Vec3f{0, 0, 1});
    }
    attributes["NORMAL"] = append_vectors(document, normals, BufferTarget::vertices);
}

}  // namespace mien
