// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "io/gltf_binding.hpp"

#include <array>
#include <fmt/format.h>

#include "io/gltf_accessors.hpp"
#include "io/gltf_json.hpp"
#include "io/gltf_nodes.hpp"

namespace mien {

using nlohmann::json;

DocumentSkin read_skin(const GltfDocument& document, std::size_t number) {
    const std::string pointer = fmt::format("/skins/{}", number);
    const json& value = document.json["skins"][number];
    DocumentSkin skin;
    for (const json& joint : array_member(value, "joints", pointer))
        skin.joints.push_back(whole_number(joint, pointer + "/joints"));
    skin.inverse_binds.resize(skin.joints.size());
    const auto accessor = find_whole(value, "inverseBindMatrices", pointer);
    if (!accessor) return skin;
    const std::vector<float> numbers = read_floats(document, *accessor, 16, pointer + "/inverseBindMatrices");
    if (numbers.size() / 16 < skin.joints.size())
        fail_at(pointer + "/inverseBindMatrices", fmt::format("{} matrices", skin.joints.size()),
                std::to_string(numbers.size() / 16));
    for (std::size_t j = 0; j < skin.joints.size(); ++j) {
        std::array<double, 16> matrix{};
        for (std::size_t i = 0; i < 16; ++i) matrix[i] = numbers[j * 16 + i];
        skin.inverse_binds[j] = affine_from_columns(matrix);
    }
    return skin;
}

unsigned joint_set_count(const Primitive& primitive) {
    const json& attributes = attributes_of(primitive);
    unsigned sets = 0;
    while (attributes.contains(fmt::format("JOINTS_{}", sets))) ++sets;
    return sets;
}

JointSet read_joint_set(const Primitive& primitive, unsigned set, std::size_t joints) {
    const json& attributes = attributes_of(primitive);
    const std::string pointer = attributes_pointer(primitive);
    const std::string joints_name = fmt::format("JOINTS_{}", set), weights_name = fmt::format("WEIGHTS_{}", set);
    const std::string joints_pointer = pointer + '/' + joints_name;
    JointSet read{
        read_joints(*primitive.document, whole_member(attributes, joints_name.c_str(), pointer), joints_pointer),
        read_floats(*primitive.document, whole_member(attributes, weights_name.c_str(), pointer), 4,
                    pointer + '/' + weights_name)};
    const std::size_t entries = primitive.vertices * 4;
    if (read.joints.size() != entries || read.weights.size() != entries)
        fail_at(joints_pointer, fmt::format("joints and weights of {} vertices", primitive.vertices),
                fmt::format("{} and {}", read.joints.size() / 4, read.weights.size() / 4));
    for (std::size_t e = 0; e < entries; ++e)
        if (read.joints[e] >= joints)
            fail_at(joints_pointer, fmt::format("one of the {} joints of the skin", joints),
                    fmt::format("{} at vertex {}", read.joints[e], e / 4));
    return read;
}

}  // namespace mien
