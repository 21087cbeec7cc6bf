// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Pieces of a head with what decides how they move: their part's name, their place and the feature points on them.

#include "algorithms/island.hpp"

#include <algorithm>

namespace mien {

namespace {

void widen(Box& box, const Vec3& p, bool is_first) {
    if (is_first) box = {p, p};
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
}

void name_by_parts(std::vector<Island>& list, const Mesh& mesh, const Weld& weld,
                   std::span<const std::uint32_t> island) {
    for (const Part& part : mesh.parts)
        for (std::uint32_t f = part.first_face; f < part.first_face + part.face_count; ++f) {
            std::string& name = list[island[weld.place[face(mesh, f).front()]]].part;
            if (name.empty()) name = part.name;
        }
}

}  // namespace

std::vector<Island> list_islands(const Face& face, const Weld& weld) {
    const std::vector<std::uint32_t> island = islands(face.mesh, weld);
    std::vector<Island> list(island.empty() ? 0 : *std::max_element(island.begin(), island.end()) + 1);
    for (std::uint32_t p = 0; p < island.size(); ++p) {
        Island& own = list[island[p]];
        widen(own.box, position(face.mesh, weld, p), own.places.empty());
        own.places.push_back(p);
    }
    for (const std::uint32_t v : face.mesh.face_vertices) list[island[weld.place[v]]].has_faces = true;
    for (std::uint32_t i = 0; i < face.points.size(); ++i)
        list[island[weld.place[face.points[i].vertex]]].points.push_back(i);
    name_by_parts(list, face.mesh, weld, island);
    return list;
}

double face_scale(const Face& face) {
    const double eyes = eye_distance(face.points);
    return eyes > 0 ? eyes : 0.25 * diagonal(bounding_box(face.mesh));
}

}  // namespace mien
