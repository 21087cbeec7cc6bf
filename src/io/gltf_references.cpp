// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// glTF refers by number: what may stand where is one table of patterns, a star for every element of an array or
// object.

#include "io/gltf_references.hpp"

#include <array>
#include <fmt/format.h>
#include <string>
#include <string_view>

#include "io/gltf_json.hpp"
#include "io/json_text.hpp"

namespace mien {

namespace {

using nlohmann::json;

struct Reference {
    std::string_view from;  // pattern of the member that holds the number
    const char* to;         // array of the document that it counts in
};

constexpr std::array references{
    Reference{"accessors/*/bufferView", "bufferViews"},
    Reference{"accessors/*/sparse/indices/bufferView", "bufferViews"},
    Reference{"accessors/*/sparse/values/bufferView", "bufferViews"},
    Reference{"animations/*/channels/*/target/node", "nodes"},
    Reference{"animations/*/samplers/*/input", "accessors"},
    Reference{"animations/*/samplers/*/output", "accessors"},
    Reference{"bufferViews/*/buffer", "buffers"},
    Reference{"bufferViews/*/extensions/EXT_meshopt_compression/buffer", "buffers"},
    Reference{"images/*/bufferView", "bufferViews"},
    Reference{"materials/*/emissiveTexture/index", "textures"},
    Reference{"materials/*/normalTexture/index", "textures"},
    Reference{"materials/*/occlusionTexture/index", "textures"},
    Reference{"materials/*/pbrMetallicRoughness/baseColorTexture/index", "textures"},
    Reference{"materials/*/pbrMetallicRoughness/metallicRoughnessTexture/index", "textures"},
    Reference{"meshes/*/primitives/*/attributes/*", "accessors"},
    Reference{"meshes/*/primitives/*/extensions/KHR_draco_mesh_compression/bufferView", "bufferViews"},
    Reference{"meshes/*/primitives/*/indices", "accessors"},
    Reference{"meshes/*/primitives/*/material", "materials"},
    Reference{"meshes/*/primitives/*/targets/*/*", "accessors"},
    Reference{"nodes/*/camera", "cameras"},
    Reference{"nodes/*/children/*", "nodes"},
    Reference{"nodes/*/mesh", "meshes"},
    Reference{"nodes/*/skin", "skins"},
    Reference{"scene", "scenes"},
    Reference{"scenes/*/nodes/*", "nodes"},
    Reference{"skins/*/inverseBindMatrices", "accessors"},
    Reference{"skins/*/joints/*", "nodes"},
    Reference{"skins/*/skeleton", "nodes"},
    Reference{"textures/*/extensions/EXT_texture_webp/source", "images"},
    Reference{"textures/*/extensions/KHR_texture_basisu/source", "images"},
    Reference{"textures/*/sampler", "samplers"},
    Reference{"textures/*/source", "images"},
};

void check_number(const json& value, std::size_t size, const char* to, const std::string& pointer) {
    if (whole_number(value, pointer) >= size)
        fail_found(pointer, fmt::format("one of the {} elements of {}", size, to), value);
}

// Goes down the pattern, at most as deep as it is long.
void check(const json& value, std::string_view pattern, std::size_t size, const char* to, const std::string& pointer) {
    if (pattern.empty()) return check_number(value, size, to, pointer);
    const std::string step(pattern.substr(0, pattern.find('/')));
    const std::string_view rest = pattern.substr(std::min(pattern.size(), step.size() + 1));
    if (step != "*") {
        const json* member = find_member(value, step.c_str(), pointer);
        if (member != nullptr) check(*member, rest, size, to, pointer + '/' + step);
    } else if (value.is_array()) {
        for (std::size_t i = 0; i < value.size(); ++i)
            check(value[i], rest, size, to, fmt::format("{}/{}", pointer, i));
    } else if (value.is_object()) {
        for (const auto& [name, member] : value.items()) check(member, rest, size, to, pointer + json_pointer({name}));
    } else {
        fail_found(pointer, "an array or an object", value);
    }
}

// The samplers of an animation are counted in the animation and not in the document.
void check_channels(const json& root) {
    const json& animations = array_member(root, "animations", "");
    for (std::size_t a = 0; a < animations.size(); ++a) {
        const std::string pointer = fmt::format("/animations/{}", a);
        const std::size_t samplers = array_member(animations[a], "samplers", pointer).size();
        check(animations[a], "channels/*/sampler", samplers, "samplers", pointer);
    }
}

}  // namespace

void check_references(const json& root) {
    for (const Reference& reference : references)
        check(root, reference.from, element_count(root, reference.to), reference.to, "");
    check_channels(root);
}

}  // namespace mien
