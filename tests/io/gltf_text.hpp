// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// glTF documents that tests are built from: numbers go into one binary, accessors and views grow beside them.

#pragma once

#include <cstddef>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "io/glb.hpp"
#include "io/text.hpp"

#include "mien/error.hpp"
#include "mien/io/gltf.hpp"

namespace mien::gltf_text {

using nlohmann::json;

inline json empty_json() {
    return {{"asset", {{"version", "2.0"}}}};
}

/// A document without anything in it.
inline GltfDocument empty() {
    return {empty_json(), {}};
}

/// Adds the numbers as a buffer view; returns its number.
template <class T>
std::size_t add_view(GltfDocument& document, const std::vector<T>& numbers) {
    const std::size_t offset = (document.binary.size() + 3) / 4 * 4;
    document.binary.resize(offset + numbers.size() * sizeof(T));
    std::memcpy(document.binary.data() + offset, numbers.data(), numbers.size() * sizeof(T));
    document.json["buffers"] = json::array({{{"byteLength", document.binary.size()}}});
    document.json["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", numbers.size() * sizeof(T)}});
    return document.json["bufferViews"].size() - 1;
}

/// Adds an accessor over a view of its own; returns its number.
template <class T>
std::size_t add_accessor(GltfDocument& document, const std::vector<T>& numbers, const char* type, int component_type,
                         std::size_t components) {
    const std::size_t view = add_view(document, numbers);
    document.json["accessors"].push_back({{"bufferView", view},
                                          {"type", type},
                                          {"componentType", component_type},
                                          {"count", numbers.size() / components}});
    return document.json["accessors"].size() - 1;
}

inline std::size_t add_vec3(GltfDocument& document, const std::vector<float>& numbers) {
    return add_accessor(document, numbers, "VEC3", 5126, 3);
}

/// Adds a primitive with these positions to a mesh of its own, and returns the primitive.
inline json& add_mesh(GltfDocument& document, const std::vector<float>& positions) {
    const std::size_t accessor = add_vec3(document, positions);
    document.json["meshes"].push_back({{"primitives", json::array({{{"attributes", {{"POSITION", accessor}}}}})}});
    return document.json["meshes"].back()["primitives"][0];
}

/// One triangle in one mesh: accessor 0 are its positions.
inline GltfDocument triangle() {
    GltfDocument document = empty();
    add_mesh(document, {0, 0, 0, 1, 0, 0, 0, 1, 0});
    return document;
}

/// Four corners of a unit square; accessor 1 are the indices.
inline GltfDocument square(const std::vector<std::uint16_t>& indices, int mode = 4) {
    GltfDocument document = empty();
    add_mesh(document, {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
    const std::size_t accessor = add_accessor(document, indices, "SCALAR", 5123, 1);
    json& primitive = document.json["meshes"][0]["primitives"][0];
    primitive["indices"] = accessor;
    primitive["mode"] = mode;
    return document;
}

/// Shows mesh 0 through this node.
inline void add_node(GltfDocument& document, json node) {
    document.json["nodes"].push_back(std::move(node));
}

inline std::string glb_text(const GltfDocument& document) {
    return std::string(as_text(format_glb(document)));
}

/// Fetches nothing.
inline std::vector<std::byte> no_file(std::string_view uri) {
    throw Error("no file " + std::string(uri));
}

inline Mesh parse(std::span<const std::byte> bytes) {
    return parse_gltf(bytes, no_file);
}
inline Mesh read(const GltfDocument& document) {
    return parse(format_glb(document));
}

inline std::string base64(std::span<const std::byte> bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits = bits << 8 | (i + k < bytes.size() ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? digits[bits >> (18 - 6 * k) & 63U] : '=';
    }
    return text;
}

}  // namespace mien::gltf_text
