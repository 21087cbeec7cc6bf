// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Animations of glTF 2.0 (specification, 3.11) as rows of positions.

#include <algorithm>
#include <fmt/format.h>
#include <utility>

#include "io/gltf_channels.hpp"
#include "io/gltf_codecs.hpp"
#include "io/gltf_json.hpp"
#include "io/gltf_scene.hpp"
#include "io/scene_sequence.hpp"

#include "mien/io/sequence.hpp"

namespace mien {

namespace {

std::vector<std::string> animation_names(const GltfDocument& document) {
    std::vector<std::string> names;
    for (std::size_t a = 0; a < element_count(document.json, "animations"); ++a)
        names.push_back(text_member(document.json["animations"][a], "name", fmt::format("/animations/{}", a)));
    return names;
}

}  // namespace

MeshSequence parse_gltf_sequence(std::span<const std::byte> bytes, const Fetch& fetch, const SequenceOptions& options) {
    const GltfDocument document = load_plain_gltf(bytes, fetch);
    const std::size_t number = find_animation(animation_names(document), options.animation);
    DocumentScene read = read_document_scene(document, Looks::left_out);
    read.scene.channels = read_channels(document, number, read);
    return sequence_of(parse_gltf(bytes, fetch), std::move(read.scene), options.rate);
}

std::vector<Animation> parse_gltf_animations(std::span<const std::byte> bytes, const Fetch& fetch) {
    const GltfDocument document = load_plain_gltf(bytes, fetch);
    const std::vector<std::string> names = animation_names(document);
    std::vector<Animation> animations;
    if (names.empty()) return animations;
    DocumentScene read = read_document_scene(document, Looks::left_out);
    for (std::size_t a = 0; a < names.size(); ++a) {
        read.scene.channels = read_channels(document, a, read);
        animations.push_back(describe_animation(read.scene, names[a]));
    }
    return animations;
}

}  // namespace mien
