// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Skins of glTF 2.0 (specification, 3.7.3). Joints only translate to their rest, so an inverse bind matrix is minus
// that translation. The sum of a vertex's weights is brought to 1 again where rounding moved it: readers reject more
// than a few millionths.

#include "io/gltf_skin.hpp"

#include <algorithm>
#include <cstdint>
#include <fmt/format.h>
#include <string>
#include <utility>

#include "io/gltf_builder.hpp"

#include "mien/error.hpp"

namespace mien {

namespace {

using nlohmann::json;

void check(const BaseDocument& base, const Rig& rig, const Skin& skin) {
    const std::size_t vertices = vertex_count(rig), slots = vertices * skin.influences;
    if (skin.influences == 0 || skin.influences % 4 != 0)
        throw Error(fmt::format("skin: expected a multiple of 4 influences, found {}", skin.influences));
    if (skin.joints.size() != slots || skin.weights.size() != slots)
        throw Error(fmt::format("skin: expected {} joints and weights for {} vertices, found {} and {}", slots,
                                vertices, skin.joints.size(), skin.weights.size()));
    for (const std::uint16_t joint : skin.joints)
        if (joint >= joint_count(rig))
            throw Error(fmt::format("skin: expected joints below {}, found {}", joint_count(rig), joint));
    for (const WrittenPrimitive& written : base.primitives)
        for (const std::uint32_t v : written.vertices)
            if (v >= vertices)
                throw Error(fmt::format("rig: expected a rig of this head, found one of only {} vertices", vertices));
}

std::string joint_name(const Rig& rig, std::size_t joint) {
    if (joint < rig.points.size()) return rig.points[joint].id;
    if (joint == rig.points.size()) return "still";
    return rig.eyeballs[joint - rig.points.size() - 1].name;
}

JointNodes append_joint_nodes(BaseDocument& base, const Rig& rig) {
    JointNodes nodes;
    for (std::size_t j = 0; j < joint_count(rig); ++j) {
        const Vec3f at = written_origin(rig, j);
        json node = {{"name", joint_name(rig, j)}};
        if (at != Vec3f{}) node["translation"] = {at.x, at.y, at.z};
        nodes.joints.push_back(append_object(base.document, "nodes", std::move(node)));
    }
    nodes.root = append_object(base.document, "nodes", {{"name", "mien"}, {"children", nodes.joints}});
    base.document.json["scenes"][base.scene]["nodes"].push_back(nodes.root);
    return nodes;
}

std::size_t append_inverse_bind_matrices(GltfDocument& document, const Rig& rig) {
    std::vector<float> columns;
    for (std::size_t j = 0; j < joint_count(rig); ++j) {
        const Vec3f back = Vec3f{} - written_origin(rig, j);
        columns.insert(columns.end(), {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, back.x, back.y, back.z, 1});
    }
    return append_floats(document, columns, Elements::mat4, BufferTarget::none);
}

// The row of one vertex in the skin, for a file: without weight no joint, together 1.
struct Slots {
    std::vector<std::uint16_t> joints;
    std::vector<float> weights;
};

Slots slots_of(const Rig& rig, const Skin& skin, std::uint32_t vertex) {
    const std::size_t first = std::size_t{vertex} * skin.influences;
    Slots slots{std::vector<std::uint16_t>(skin.influences), std::vector<float>(skin.influences)};
    double sum = 0;
    for (std::size_t k = 0; k < skin.influences; ++k) sum += skin.weights[first + k];
    if (!(sum > 0)) {
        slots.joints[0] = static_cast<std::uint16_t>(rig.points.size());
        slots.weights[0] = 1;
        return slots;
    }
    for (std::size_t k = 0; k < skin.influences; ++k) {
        slots.weights[k] = static_cast<float>(skin.weights[first + k] / sum);
        if (slots.weights[k] > 0) slots.joints[k] = skin.joints[first + k];
    }
    return slots;
}

// JOINTS_set and WEIGHTS_set: four slots of every vertex.
void append_set(GltfDocument& document, json& attributes, const std::vector<Slots>& slots, std::size_t set,
                bool narrow) {
    std::vector<std::uint16_t> joints;
    std::vector<float> weights;
    for (const Slots& vertex : slots)
        for (std::size_t k = 4 * set; k < 4 * set + 4; ++k) {
            joints.push_back(vertex.joints[k]);
            weights.push_back(vertex.weights[k]);
        }
    std::vector<std::uint8_t> bytes;
    if (narrow)
        std::transform(joints.begin(), joints.end(), std::back_inserter(bytes),
                       [](std::uint16_t joint) { return static_cast<std::uint8_t>(joint); });
    attributes[fmt::format("JOINTS_{}", set)] =
        narrow ? append_bytes(document, bytes, Elements::vec4, BufferTarget::vertices)
               : append_shorts(document, joints, Elements::vec4, BufferTarget::vertices);
    attributes[fmt::format("WEIGHTS_{}", set)] =
        append_floats(document, weights, Elements::vec4, BufferTarget::vertices);
}

void append_slots(GltfDocument& document, const WrittenPrimitive& written, const Rig& rig, const Skin& skin) {
    std::vector<Slots> slots;
    for (const std::uint32_t v : written.vertices) slots.push_back(slots_of(rig, skin, v));
    json attributes = document.json["meshes"][written.mesh]["primitives"][written.primitive]["attributes"];
    for (std::size_t set = 0; set < skin.influences / 4; ++set)
        append_set(document, attributes, slots, set, joint_count(rig) <= 256);
    document.json["meshes"][written.mesh]["primitives"][written.primitive]["attributes"] = std::move(attributes);
}

}  // namespace

Vec3f written_origin(const Rig& rig, std::size_t joint) {
    return to_float(joint_origin(rig, joint));
}

JointNodes append_skin(BaseDocument& base, const Rig& rig, const Skin& skin) {
    check(base, rig, skin);
    JointNodes nodes = append_joint_nodes(base, rig);
    const std::size_t matrices = append_inverse_bind_matrices(base.document, rig);
    const std::size_t index = append_object(
        base.document, "skins",
        {{"name", "mien"}, {"skeleton", nodes.root}, {"inverseBindMatrices", matrices}, {"joints", nodes.joints}});
    for (const WrittenPrimitive& written : base.primitives) append_slots(base.document, written, rig, skin);
    for (const std::size_t node : base.mesh_nodes) base.document.json["nodes"][node]["skin"] = index;
    return nodes;
}

}  // namespace mien
