// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Skins of glTF 2.0 (specification, 3.7.3) in their rest pose: a vertex p lies at Σ w_j J_j B_j p, where J_j is the
// joint's world matrix and B_j its inverse bind matrix; the transform of the node with the skin has no say. Weights are
// divided by their sum, which quantised ones miss by a little.

#include "io/gltf_rest_pose.hpp"

#include <fmt/format.h>

#include "io/gltf_binding.hpp"
#include "io/gltf_json.hpp"

namespace mien {

namespace {

using nlohmann::json;

std::vector<Affine> joint_maps(const GltfDocument& document, const SceneNodes& nodes, std::size_t number) {
    const DocumentSkin skin = read_skin(document, number);
    std::vector<Affine> maps;
    for (std::size_t j = 0; j < skin.joints.size(); ++j)
        maps.push_back(nodes.worlds.at(skin.joints[j]) * skin.inverse_binds[j]);
    return maps;
}

Affine scaled(const Affine& map, double s) {
    return {{s * map.columns[0], s * map.columns[1], s * map.columns[2]}, s * map.offset};
}

void add(Affine& sum, const Affine& map) {
    for (std::size_t c = 0; c < 3; ++c) sum.columns[c] += map.columns[c];
    sum.offset += map.offset;
}

constexpr Affine nothing{{Vec3{}, Vec3{}, Vec3{}}, Vec3{}};

// What the sets JOINTS_0 and WEIGHTS_0, JOINTS_1 and WEIGHTS_1, ... add up to at each vertex.
struct Blend {
    std::vector<Affine> sums;
    std::vector<double> weights;
};

void add_set(Blend& blend, const Standing& standing, const Primitive& primitive, unsigned number) {
    const JointSet set = read_joint_set(primitive, number, standing.joints.size());
    for (std::size_t e = 0; e < set.joints.size(); ++e) {
        add(blend.sums[e / 4], scaled(standing.joints[set.joints[e]], set.weights[e]));
        blend.weights[e / 4] += set.weights[e];
    }
}

}  // namespace

std::vector<Standing> standings(const GltfDocument& document) {
    const SceneNodes nodes = scene_nodes(document);
    std::vector<Standing> result(element_count(document.json, "meshes"));
    for (const std::size_t n : nodes.traversal) {
        const std::string pointer = fmt::format("/nodes/{}", n);
        const json& node = document.json["nodes"][n];
        const auto mesh = find_whole(node, "mesh", pointer);
        if (!mesh || result.at(*mesh).node) continue;
        result[*mesh] = {n, nodes.worlds[n], false, {}};
        const auto skin = find_whole(node, "skin", pointer);
        if (!skin) continue;
        result[*mesh].skinned = true;
        result[*mesh].joints = joint_maps(document, nodes, *skin);
    }
    return result;
}

std::vector<Affine> vertex_maps(const Standing& standing, const Primitive& primitive) {
    const unsigned sets = standing.skinned ? joint_set_count(primitive) : 0;
    if (sets == 0) return {standing.world};
    Blend blend{std::vector<Affine>(primitive.vertices, nothing), std::vector<double>(primitive.vertices)};
    for (unsigned set = 0; set < sets; ++set) add_set(blend, standing, primitive, set);
    for (std::size_t v = 0; v < primitive.vertices; ++v)
        blend.sums[v] = blend.weights[v] > 0 ? scaled(blend.sums[v], 1 / blend.weights[v]) : Affine{};
    return std::move(blend.sums);
}

}  // namespace mien
