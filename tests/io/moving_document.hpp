// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// A glTF document in which everything moves: nodes in a tree, morph targets, a skin, by every kind of interpolation.

#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fmt/format.h>
#include <vector>

#include "io/gltf_text.hpp"

namespace mien::gltf_text {

/// Numbers that look like none, so that a mixed-up index cannot go unseen.
inline std::vector<float> pattern(std::size_t size, double seed) {
    std::vector<float> numbers;
    for (std::size_t i = 0; i < size; ++i)
        numbers.push_back(static_cast<float>(std::sin(seed + 1.7 * static_cast<double>(i * i + 1))));
    return numbers;
}

inline std::size_t scalars(GltfDocument& document, const std::vector<float>& numbers) {
    return add_accessor(document, numbers, "SCALAR", 5126, 1);
}

inline void add_channel(GltfDocument& document, std::size_t node, const char* path, const char* between,
                        std::size_t input, std::size_t output) {
    json& animation = document.json["animations"][0];
    animation["channels"].push_back(
        {{"sampler", animation["samplers"].size()}, {"target", {{"node", node}, {"path", path}}}});
    animation["samplers"].push_back({{"input", input}, {"output", output}, {"interpolation", between}});
}

/// Two primitives of five and four vertices with two targets, one of them sparse.
inline void add_morphing_mesh(GltfDocument& document) {
    json& first = add_mesh(document, pattern(15, 1));
    first["targets"] = json::array({{{"POSITION", add_vec3(document, pattern(15, 2))}}, json::object()});
    json second = {{"attributes", {{"POSITION", add_vec3(document, pattern(12, 3))}}}};
    second["targets"].push_back({{"POSITION", add_vec3(document, pattern(12, 4))}});
    const std::size_t indices = add_view(document, std::vector<std::uint8_t>{1, 3});
    const std::size_t values = add_view(document, pattern(6, 5));
    document.json["accessors"].push_back({{"type", "VEC3"},
                                          {"componentType", 5126},
                                          {"count", 4},
                                          {"sparse",
                                           {{"count", 2},
                                            {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                                            {"values", {{"bufferView", values}}}}}});
    second["targets"].push_back({{"POSITION", document.json["accessors"].size() - 1}});
    json& mesh = document.json["meshes"].back();
    mesh["primitives"].push_back(second);
    mesh["weights"] = {0.5, -0.25};
    mesh["name"] = "face";
    mesh["extras"]["targetNames"] = {"smile", "frown"};
}

/// Eight vertices on three joints by two sets of slots, weights as bytes that sum to 255.
inline void add_skinned_mesh(GltfDocument& document) {
    const std::size_t positions = add_vec3(document, pattern(24, 6));
    json attributes = {{"POSITION", positions}};
    for (std::size_t set = 0; set < 2; ++set) {
        std::vector<std::uint8_t> joints, weights;
        for (std::size_t v = 0; v < 8; ++v)
            for (std::size_t k = 0; k < 4; ++k) {
                joints.push_back(static_cast<std::uint8_t>((v + k + set) % 3));
                weights.push_back(static_cast<std::uint8_t>(10 * k + v + (set == 0 && k == 0 ? 135 - 8 * v : 0)));
            }
        attributes[fmt::format("JOINTS_{}", set)] = add_accessor(document, joints, "VEC4", 5121, 4);
        attributes[fmt::format("WEIGHTS_{}", set)] = add_accessor(document, weights, "VEC4", 5121, 4);
        document.json["accessors"].back()["normalized"] = true;
    }
    document.json["meshes"].push_back({{"primitives", json::array({{{"attributes", attributes}}})}});
    std::vector<float> binds = pattern(48, 7);
    for (std::size_t j = 0; j < 3; ++j)
        for (std::size_t r = 0; r < 4; ++r) binds[16 * j + 4 * r + 3] = r == 3 ? 1 : 0;
    const std::size_t matrices = add_accessor(document, binds, "MAT4", 5126, 16);
    document.json["skins"].push_back({{"joints", {6, 2, 5}}, {"inverseBindMatrices", matrices}});
}

/// Children come before their parents in the file; node 7 shows the first mesh once more and has weights of its own.
inline void add_tree(GltfDocument& document) {
    json& nodes = document.json["nodes"];
    nodes = json::array();
    nodes.push_back(
        {{"mesh", 0}, {"translation", {1, 2, 3}}, {"rotation", {0.1, 0.7, -0.1, 0.7}}, {"scale", {2, 1, -1}}});
    nodes.push_back({{"children", {0, 7}}, {"rotation", {0.5, 0.5, -0.5, 0.5}}, {"translation", {0, -1, 0}}});
    nodes.push_back({{"children", {6}}, {"scale", {1, 1.5, 1}}});
    nodes.push_back({{"children", {1, 2, 4}}, {"name", "root"}});
    nodes.push_back({{"mesh", 1}, {"skin", 0}, {"translation", {100, 0, 0}}});
    nodes.push_back({{"translation", {0, 0.5, 0}}});
    nodes.push_back({{"children", {5}}, {"rotation", {0, 0.6, 0, 0.8}}});
    nodes.push_back({{"mesh", 0}, {"weights", {0, 1}}, {"matrix", {1, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 4, 5, 6, 1}}});
    document.json["scenes"].push_back({{"nodes", {3}}});
}

inline void add_animation(GltfDocument& document) {
    const std::size_t three = scalars(document, {0.25F, 1, 1.5F}), two = scalars(document, {0, 2});
    add_channel(document, 0, "translation", "LINEAR", three, add_vec3(document, pattern(9, 8)));
    add_channel(document, 1, "scale", "STEP", three, add_vec3(document, pattern(9, 9)));
    add_channel(document, 3, "translation", "CUBICSPLINE", three, add_vec3(document, pattern(27, 10)));
    add_channel(document, 2, "rotation", "LINEAR", three, add_accessor(document, pattern(12, 11), "VEC4", 5126, 4));
    add_channel(document, 5, "rotation", "CUBICSPLINE", two, add_accessor(document, pattern(24, 12), "VEC4", 5126, 4));
    add_channel(document, 6, "rotation", "STEP", two,
                add_accessor(document, std::vector<std::int16_t>{0, 0, 0, 32767, -32768, 0, 0, 9}, "VEC4", 5122, 4));
    document.json["accessors"].back()["normalized"] = true;
    add_channel(document, 0, "weights", "LINEAR", two, scalars(document, pattern(4, 13)));
    add_channel(document, 7, "weights", "CUBICSPLINE", two, scalars(document, pattern(12, 14)));
}

inline GltfDocument everything() {
    GltfDocument document = empty();
    add_morphing_mesh(document);
    add_skinned_mesh(document);
    add_tree(document);
    add_animation(document);
    // Keys of turns have length 1, as files must hold them.
    for (const std::size_t c : {3U}) {
        const json& accessor =
            document.json["accessors"][document.json["animations"][0]["samplers"][c]["output"].get<std::size_t>()];
        const std::size_t at = document.json["bufferViews"][accessor["bufferView"].get<std::size_t>()]["byteOffset"];
        for (std::size_t q = 0; q < 3; ++q) {
            std::array<float, 4> turn{};
            std::memcpy(turn.data(), &document.binary[at + 16 * q], 16);
            const float size = std::hypot(std::hypot(turn[0], turn[1]), std::hypot(turn[2], turn[3]));
            for (float& x : turn) x /= size;
            std::memcpy(&document.binary[at + 16 * q], turn.data(), 16);
        }
    }
    return document;
}

}  // namespace mien::gltf_text
