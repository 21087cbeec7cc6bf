// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "io/gltf_codecs.hpp"

#include <fmt/format.h>

#include "io/gltf_json.hpp"

namespace mien {

namespace {

using nlohmann::json;

void refuse(const json& owner, const char* extension, const std::string& pointer) {
    const json& extensions = object_member(owner, "extensions", pointer);
    if (extensions.contains(extension)) fail_at(pointer, "data that are not compressed", extension);
}

}  // namespace

void decompress(GltfDocument& document) {
    const json& views = array_member(document.json, "bufferViews", "");
    for (std::size_t i = 0; i < views.size(); ++i)
        refuse(views[i], "EXT_meshopt_compression", fmt::format("/bufferViews/{}", i));
    const json& meshes = array_member(document.json, "meshes", "");
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        const std::string pointer = fmt::format("/meshes/{}/primitives", m);
        for (const json& primitive : array_member(meshes[m], "primitives", pointer))
            refuse(primitive, "KHR_draco_mesh_compression", pointer);
    }
}

}  // namespace mien
