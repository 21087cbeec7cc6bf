// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Skins of glTF 2.0 (specification, 3.7.3) in their rest pose: a vertex p lies at Σ w_j J_j B_j p, where J_j is the
// joint's world matrix and B_j its inverse bind matrix; the transform of the node with the skin has no say. Weights are
// divided by their sum, which quantised ones miss by a little.

#include "io/gltf_rest_pose.hpp"

#include <fmt/format.h>

#include "io/gltf_accessors.hpp"
#include "io/gltf_json.hpp"

namespace mien {

namespace {

using nlohmann::json;

std::vector<Affine> joint_maps(const GltfDocument& document, const SceneNodes& nodes, std::size_t skin) {
    const std::string pointer = fmt::format("/skins/{}", skin);
    const json& value = document.json["skins"][skin];
    const json& joints = array_member(value, "joints", pointer);
    std::vector<Affine> maps;
    for (const json& joint : joints) maps.push_back(nodes.worlds.at(whole_number(joint, pointer + "/joints")));
    const auto accessor = find_whole(value, "inverseBindMatrices", pointer);
    if (!accessor) return maps;
    const std::vector<float> numbers = read_floats(document, *accessor, 16, pointer + "/inverseBindMatrices");
    if (numbers.size() / 16 < maps.size())
        fail_at(pointer + "/inverseBindMatrices", fmt::format("{} matrices", maps.size()),
                std::to_string(numbers.size() / 16));
    for (std::size_t j = 0; j < maps.size(); ++j) {
        std::array<double, 16> matrix{};
        for (std::size_t i = 0; i < 16; ++i) matrix[i] = numbers[j * 16 + i];
        maps[j] = maps[j] * affine_from_columns(matrix);
    }
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

void add_set(Blend& blend, const GltfDocument& document, const Standing& standing, const json& attributes, unsigned set,
             const std::string& pointer) {
    const std::string joints_pointer = fmt::format("{}/JOINTS_{}", pointer, set);
    const std::string weights_pointer = fmt::format("{}/WEIGHTS_{}", pointer, set);
    const std::vector<std::uint32_t> joints =
        read_joints(document, whole_member(attributes, fmt::format("JOINTS_{}", set).c_str(), pointer), joints_pointer);
    const std::vector<float> weights = read_floats(
        document, whole_member(attributes, fmt::format("WEIGHTS_{}", set).c_str(), pointer), 4, weights_pointer);
    const std::size_t entries = blend.sums.size() * 4;
    if (joints.size() != entries || weights.size() != entries)
        fail_at(joints_pointer, fmt::format("joints and weights of {} vertices", blend.sums.size()),
                fmt::format("{} and {}", joints.size() / 4, weights.size() / 4));
    for (std::size_t e = 0; e < entries; ++e) {
        if (joints[e] >= standing.joints.size())
            fail_at(joints_pointer, fmt::format("one of the {} joints of the skin", standing.joints.size()),
                    fmt::format("{} at vertex {}", joints[e], e / 4));
        add(blend.sums[e / 4], scaled(standing.joints[joints[e]], weights[e]));
        blend.weights[e / 4] += weights[e];
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

std::vector<Affine> vertex_maps(const GltfDocument& document, const Standing& standing, const json& primitive,
                                std::size_t vertices, const std::string& pointer) {
    const json& attributes = object_member(primitive, "attributes", pointer);
    if (!standing.skinned || !attributes.contains("JOINTS_0")) return {standing.world};
    Blend blend{std::vector<Affine>(vertices, nothing), std::vector<double>(vertices)};
    for (unsigned set = 0; attributes.contains(fmt::format("JOINTS_{}", set)); ++set)
        add_set(blend, document, standing, attributes, set, pointer + "/attributes");
    for (std::size_t v = 0; v < vertices; ++v)
        blend.sums[v] = blend.weights[v] > 0 ? scaled(blend.sums[v], 1 / blend.weights[v]) : Affine{};
    return std::move(blend.sums);
}

}  // namespace mien
