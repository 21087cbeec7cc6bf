// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/mesh.hpp"

#include <algorithm>

namespace mien {

void add_face(Mesh& mesh, std::span<const std::uint32_t> corners) {
    mesh.face_vertices.insert(mesh.face_vertices.end(), corners.begin(), corners.end());
    mesh.face_starts.push_back(static_cast<std::uint32_t>(mesh.face_vertices.size()));
}

Box bounding_box(const Mesh& mesh) {
    if (mesh.positions.empty()) return {};
    Box box{to_double(mesh.positions.front()), to_double(mesh.positions.front())};
    for (const Vec3f& p : mesh.positions) {
        const Vec3 q = to_double(p);
        box.low = {std::min(box.low.x, q.x), std::min(box.low.y, q.y), std::min(box.low.z, q.z)};
        box.high = {std::max(box.high.x, q.x), std::max(box.high.y, q.y), std::max(box.high.z, q.z)};
    }
    return box;
}

double diagonal(const Box& box) {
    return distance(box.low, box.high);
}

}  // namespace mien
