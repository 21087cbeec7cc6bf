// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/mesh.hpp"

#include <algorithm>

namespace mien {

void add_face(Mesh& mesh, std::span<const std::uint32_t> corners) {
    mesh.face_vertices.insert(mesh.face_vertices.end(), corners.begin(), corners.end());
    mesh.face_starts.push_back(static_cast<std::uint32_t>(mesh.face_vertices.size()));
}

namespace {

void extend(Box& box, const Vec3& p) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
}

}  // namespace

Box bounding_box(const Mesh& mesh) {
    if (mesh.positions.empty()) return {};
    Box box{to_double(mesh.positions.front()), to_double(mesh.positions.front())};
    for (const Vec3f& p : mesh.positions) extend(box, to_double(p));
    return box;
}

Box bounding_box(std::span<const Vec3> points) {
    if (points.empty()) return {};
    Box box{points.front(), points.front()};
    for (const Vec3& p : points) extend(box, p);
    return box;
}

double diagonal(const Box& box) {
    return distance(box.low, box.high);
}

}  // namespace mien
