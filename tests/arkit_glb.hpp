// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The animated head of tests/arkit_head.hpp as a file: a track of weights, and a node above the head that nods, turns
// and tilts.

#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "arkit_head.hpp"
#include "io/glb.hpp"
#include "io/gltf_builder.hpp"

#include "mien/io/gltf.hpp"

namespace mien::arkit {

/// A GLB that shows `head.moving`, one key a row.
inline std::vector<std::byte> glb_of(const AnimatedHead& head) {
    using nlohmann::json;
    GltfDocument document = parse_glb(format_glb(head.moving.mesh, head.track));
    std::vector<float> times, turns, places;
    for (std::size_t row = 0; row < head.poses.size(); ++row) {
        const Pose& pose = head.poses[row];
        times.push_back(static_cast<float>(head.track.times[row]));
        for (const double x : {pose.rotation.x, pose.rotation.y, pose.rotation.z, pose.rotation.w})
            turns.push_back(static_cast<float>(x));
        for (const double x : {pose.translation.x, pose.translation.y, pose.translation.z})
            places.push_back(static_cast<float>(x));
    }
    const std::size_t input = append_floats(document, times, Elements::scalar, BufferTarget::none, Bounds::given);
    const std::size_t turned = append_floats(document, turns, Elements::vec4, BufferTarget::none);
    const std::size_t placed = append_floats(document, places, Elements::vec3, BufferTarget::none);
    json& scene = document.json["scenes"][document.json.value("scene", std::size_t{0})];
    const std::size_t node = append_object(document, "nodes", {{"name", "head motion"}, {"children", scene["nodes"]}});
    scene["nodes"] = json::array();
    scene["nodes"].push_back(node);
    json& animation = document.json["animations"][0];
    for (const auto& [path, output] : {std::pair{"rotation", turned}, std::pair{"translation", placed}}) {
        animation["channels"].push_back(
            {{"sampler", animation["samplers"].size()}, {"target", {{"node", node}, {"path", path}}}});
        animation["samplers"].push_back({{"input", input}, {"output", output}, {"interpolation", "LINEAR"}});
    }
    return format_glb(document);
}

}  // namespace mien::arkit
