// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "algorithms/tongue.hpp"

#include <algorithm>
#include <cctype>
#include <set>
#include <string>

#include "algorithms/island.hpp"

namespace mien {

namespace {

constexpr double beyond_lips = 0.42, down = 0.2;  // of the tip, in eye distances

std::string lower_case(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

bool is_tongue(const std::string& part) {
    const std::string name = lower_case(part);
    return name.find("tongue") != name.npos && name.find("teeth") == name.npos;
}

}  // namespace

std::vector<std::uint32_t> tongue_places(const Face& face, const Weld& weld) {
    std::set<std::uint32_t> places;
    for (const Part& part : face.mesh.parts) {
        if (!is_tongue(part.name)) continue;
        for (std::uint32_t f = part.first_face; f < part.first_face + part.face_count; ++f)
            for (const std::uint32_t v : mien::face(face.mesh, f)) places.insert(weld.place[v]);
    }
    const auto tip = find_point(face.points, "6.1");
    if (places.empty() && tip) {
        const std::vector<std::uint32_t> island = islands(face.mesh, weld);
        const auto size = static_cast<std::size_t>(
            std::count(island.begin(), island.end(), island[weld.place[face.points[*tip].vertex]]));
        for (std::uint32_t p = 0; p < island.size(); ++p)
            if (3 * size < island.size() && island[p] == island[weld.place[face.points[*tip].vertex]]) places.insert(p);
    }
    return {places.begin(), places.end()};
}

void put_out_tongue(const Face& face, const Weld& weld, const std::vector<std::uint32_t>& places,
                    const Quaternion& turn, const Vec3& lips, ShapeField& field) {
    if (places.empty()) return;
    const Vec3 forward = rotate(turn, {0, 0, 1}), up = rotate(turn, {0, 1, 0});
    const auto depth = [&](std::uint32_t p) { return dot(forward, position(face.mesh, weld, p)); };
    double root = depth(places.front()), tip = root;
    for (const std::uint32_t p : places) root = std::min(root, depth(p)), tip = std::max(tip, depth(p));
    if (!(tip > root)) return;
    const double eyes = eye_distance(face.points);
    const double out = std::max(0.2 * eyes, dot(forward, lips) + beyond_lips * eyes - tip);
    for (const std::uint32_t p : places) {
        const double t = (depth(p) - root) / (tip - root);
        field[p] += (t * t * out) * forward - (t * t * t * down * eyes) * up;
    }
}

}  // namespace mien
