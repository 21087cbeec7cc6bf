// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// A small player of glTF documents, written from the specification (3.7.3, 3.11) and from nothing of what is tested.

#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/glb.hpp"

#include "mien/vec.hpp"

namespace mien::gltf_scene {

using nlohmann::json;

/// The numbers of a tightly packed accessor of bytes, shorts, ints or floats.
inline std::vector<double> numbers(const GltfDocument& document, const json& index) {
    const json& accessor = document.json.at("accessors").at(index.get<std::size_t>());
    const json& view = document.json.at("bufferViews").at(accessor.at("bufferView").get<std::size_t>());
    const std::map<std::string, std::size_t> widths{{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
    const std::size_t count = accessor.at("count").get<std::size_t>() * widths.at(accessor.at("type"));
    const std::size_t offset = view.value("byteOffset", std::size_t{0}) + accessor.value("byteOffset", std::size_t{0});
    std::vector<double> result;
    for (std::size_t i = 0; i < count; ++i) {
        const auto read = [&](auto value) {
            std::memcpy(&value, &document.binary.at(offset + (i + 1) * sizeof value - 1) + 1 - sizeof value,
                        sizeof value);
            result.push_back(static_cast<double>(value));
        };
        switch (accessor.at("componentType").get<int>()) {
            case 5121:
                read(std::uint8_t{});
                break;
            case 5123:
                read(std::uint16_t{});
                break;
            case 5125:
                read(std::uint32_t{});
                break;
            default:
                read(0.0F);
                break;
        }
    }
    return result;
}

inline std::vector<Vec3> vectors(const GltfDocument& document, const json& index) {
    const std::vector<double> flat = numbers(document, index);
    std::vector<Vec3> result;
    for (std::size_t i = 0; i < flat.size(); i += 3) result.push_back({flat[i], flat[i + 1], flat[i + 2]});
    return result;
}

/// The pose of every node relative to its parent at key `key` of the first animation.
inline std::vector<Pose> local_poses(const GltfDocument& document, std::size_t key) {
    std::vector<Pose> poses;
    for (const json& node : document.json.at("nodes")) {
        const auto t = node.value("translation", std::vector<double>{0, 0, 0});
        const auto q = node.value("rotation", std::vector<double>{0, 0, 0, 1});
        poses.push_back({{q[0], q[1], q[2], q[3]}, {t[0], t[1], t[2]}});
    }
    if (!document.json.contains("animations")) return poses;
    const json& animation = document.json["animations"][0];
    for (const json& channel : animation.at("channels")) {
        const json& sampler = animation.at("samplers").at(channel.at("sampler").get<std::size_t>());
        const std::vector<double> values = numbers(document, sampler.at("output"));
        Pose& pose = poses.at(channel.at("target").at("node").get<std::size_t>());
        if (channel["target"].at("path") == "translation")
            pose.translation = {values.at(3 * key), values.at(3 * key + 1), values.at(3 * key + 2)};
        else
            pose.rotation = {values.at(4 * key), values.at(4 * key + 1), values.at(4 * key + 2),
                             values.at(4 * key + 3)};
    }
    return poses;
}

/// Where the vertices of a skinned primitive are at key `key`: joint world * inverse bind matrix, weighted.
inline std::vector<Vec3> skinned(const GltfDocument& document, std::size_t mesh, std::size_t key) {
    const std::vector<Pose> local = local_poses(document, key);
    std::vector<int> parent(local.size(), -1);
    for (std::size_t n = 0; n < local.size(); ++n)
        for (const json& child : document.json["nodes"][n].value("children", json::array()))
            parent[child.get<std::size_t>()] = static_cast<int>(n);
    const json& skin = document.json.at("skins").at(0);
    const std::vector<double> binds = numbers(document, skin.at("inverseBindMatrices"));
    const json& attributes = document.json.at("meshes").at(mesh).at("primitives").at(0).at("attributes");
    const std::vector<Vec3> rest = vectors(document, attributes.at("POSITION"));
    std::vector<Vec3> result(rest.size());
    for (int set = 0; attributes.contains("JOINTS_" + std::to_string(set)); ++set) {
        const std::vector<double> joints = numbers(document, attributes["JOINTS_" + std::to_string(set)]);
        const std::vector<double> weights = numbers(document, attributes["WEIGHTS_" + std::to_string(set)]);
        for (std::size_t slot = 0; slot < joints.size(); ++slot) {
            const auto joint = static_cast<std::size_t>(joints[slot]);
            const double* m = &binds[16 * joint];
            const Vec3 p = rest[slot / 4];
            Vec3 q = p.x * Vec3{m[0], m[1], m[2]} + p.y * Vec3{m[4], m[5], m[6]} + p.z * Vec3{m[8], m[9], m[10]} +
                     Vec3{m[12], m[13], m[14]};
            for (int node = skin.at("joints").at(joint).get<int>(); node >= 0; node = parent[node])
                q = apply(local[static_cast<std::size_t>(node)], q);
            result[slot / 4] += weights[slot] * q;
        }
    }
    return result;
}

}  // namespace mien::gltf_scene
