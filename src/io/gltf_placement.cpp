// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "io/gltf_placement.hpp"

#include <cstdint>
#include <utility>

#include "io/gltf_builder.hpp"
#include "io/gltf_numbers.hpp"

namespace mien {

namespace {

using nlohmann::json;

Linear product(const Linear& a, const Linear& b) {
    return {{a * b.columns[0], a * b.columns[1], a * b.columns[2]}};
}

Vec3 vec3_at(const json& numbers, std::size_t first) {
    return {numbers.at(first).get<double>(), numbers.at(first + 1).get<double>(), numbers.at(first + 2).get<double>()};
}

// The linear part of a node's own transform.
Linear local_part(const json& node) {
    if (node.contains("matrix")) {
        const json& m = node["matrix"];
        return {{vec3_at(m, 0), vec3_at(m, 4), vec3_at(m, 8)}};
    }
    Linear local;
    if (node.contains("scale")) {
        const Vec3 s = vec3_at(node["scale"], 0);
        local.columns = {Vec3{s.x, 0, 0}, Vec3{0, s.y, 0}, Vec3{0, 0, s.z}};
    }
    if (node.contains("rotation")) {
        const Vec3 axis = vec3_at(node["rotation"], 0);
        const Quaternion q{axis.x, axis.y, axis.z, node["rotation"].at(3).get<double>()};
        for (Vec3& column : local.columns) column = rotate(q, column);
    }
    return local;
}

std::vector<std::uint32_t> drawn_vertices(const GltfDocument& document, const json& primitive, std::size_t vertices) {
    std::vector<std::uint32_t> drawn;
    if (primitive.contains("indices")) {
        for (const double index : accessor_numbers(document, primitive["indices"].get<std::size_t>()))
            drawn.push_back(static_cast<std::uint32_t>(index));
    } else {
        for (std::size_t v = 0; v < vertices; ++v) drawn.push_back(static_cast<std::uint32_t>(v));
    }
    return drawn;
}

}  // namespace

double determinant(const Linear& m) {
    return dot(m.columns[0], cross(m.columns[1], m.columns[2]));
}

Linear normal_map(const Linear& m) {
    const double sign = determinant(m) < 0 ? -1 : 1;
    const auto& c = m.columns;
    return {{sign * cross(c[1], c[2]), sign * cross(c[2], c[0]), sign * cross(c[0], c[1])}};
}

std::vector<Placement> mesh_placements(const GltfDocument& document, std::size_t scene) {
    const json nodes = document.json.value("nodes", json::array());
    const std::size_t meshes = document.json.value("meshes", json::array()).size();
    std::vector<Placement> placements(meshes);
    std::vector<bool> placed(meshes, false), seen(nodes.size(), false);
    std::vector<std::pair<std::size_t, Linear>> open;
    const auto push = [&](const json& children, const Linear& world) {
        for (auto child = children.rbegin(); child != children.rend(); ++child)
            open.emplace_back(child->get<std::size_t>(), world);
    };
    push(document.json.at("scenes").at(scene).at("nodes"), Linear{});
    while (!open.empty()) {
        const auto [index, parent] = open.back();
        open.pop_back();
        const json& node = nodes.at(index);
        if (seen.at(index)) continue;
        seen[index] = true;
        const Linear world = product(parent, local_part(node));
        if (node.contains("mesh") && !placed.at(node["mesh"].get<std::size_t>())) {
            placed[node["mesh"].get<std::size_t>()] = true;
            placements[node["mesh"].get<std::size_t>()] = Placement(world);
        }
        push(node.value("children", json::array()), world);
    }
    return placements;
}

void turn_triangles(GltfDocument& document, json& primitive, std::size_t vertices) {
    const int mode = primitive.value("mode", 4);
    if (mode < 4) return;
    const std::vector<std::uint32_t> drawn = drawn_vertices(document, primitive, vertices);
    std::vector<std::uint32_t> turned;
    for (std::size_t i = 0; i + 2 < drawn.size(); i += mode == 4 ? 3 : 1) {
        const std::uint32_t a = drawn[mode == 6 ? 0 : i], b = drawn[i + 1], c = drawn[i + 2];
        // Every second triangle of a strip runs the other way round.
        const bool odd = mode == 5 && i % 2 == 1;
        turned.insert(turned.end(), {a, odd ? b : c, odd ? c : b});
    }
    if (turned.empty()) return;
    primitive["indices"] = append_indices(document, turned);
    primitive["mode"] = 4;
}

}  // namespace mien
