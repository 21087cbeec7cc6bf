// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Documents read as scenes, or the sentence that refuses them.

#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "io/gltf_text.hpp"
#include "io/hostile.hpp"

#include "mien/io/scene.hpp"

namespace mien::gltf_text {

inline Scene scene_in(std::span<const std::byte> bytes) {
    return parse_scene(bytes, no_file);
}
inline Scene scene_in(const GltfDocument& document) {
    return scene_in(format_glb(document));
}

inline std::string refusal(const GltfDocument& document) {
    return hostile::refusal([](std::span<const std::byte> bytes) { return scene_in(bytes); }, glb_text(document));
}

}  // namespace mien::gltf_text
