// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// A vertex of a head lies at one place, but glTF lets several nodes show one mesh (specification, 3.5.1): an eye that
// stands left and right. A few bytes of nodes could ask for copies of any size, so their JSON is counted.

#include "io/gltf_instances.hpp"

#include <fmt/format.h>
#include <string>
#include <vector>

#include "io/gltf_json.hpp"
#include "io/gltf_nodes.hpp"

namespace mien {

namespace {

using nlohmann::json;

// The mesh as its showing number `number` in the scene.
json copy_of(const json& mesh, std::size_t number, const std::string& pointer) {
    json copy = mesh;
    const std::string name = text_member(mesh, "name", pointer);
    if (!name.empty()) copy["name"] = fmt::format("{}_{}", name, number);
    return copy;
}

}  // namespace

void copy_instances(GltfDocument& document, std::uint64_t most_json) {
    json& root = document.json;
    std::vector<std::size_t> shown(element_count(root, "meshes"), 0);
    std::uint64_t left = most_json;
    for (const std::size_t n : scene_nodes(document).traversal) {
        const std::string at_node = fmt::format("/nodes/{}", n);
        const auto mesh = find_whole(root["nodes"][n], "mesh", at_node);
        if (!mesh || ++shown.at(*mesh) == 1) continue;
        const std::string at_mesh = fmt::format("/meshes/{}", *mesh);
        json copy = copy_of(root["meshes"][*mesh], shown[*mesh], at_mesh);
        const std::size_t size = copy.dump().size();
        if (size > left)
            fail_at(at_node + "/mesh", fmt::format("at most {} more bytes of JSON in meshes shown again", left),
                    fmt::format("{}", size));
        left -= size;
        root["nodes"][n]["mesh"] = root["meshes"].size();
        root["meshes"].push_back(std::move(copy));
    }
}

}  // namespace mien
