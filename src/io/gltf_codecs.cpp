// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Meshopt comes first: it works on buffer views, and Draco's bytes lie in one.

#include "io/gltf_codecs.hpp"

#include <algorithm>

#include "io/gltf_decompress.hpp"
#include "io/gltf_unused.hpp"

namespace mien {

namespace {

void forget_extension(nlohmann::json& root, const char* name) {
    for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
        if (!root.contains(list)) continue;
        nlohmann::json& names = root[list];
        names.erase(std::remove(names.begin(), names.end(), name), names.end());
        if (names.empty()) root.erase(list);
    }
}

}  // namespace

std::size_t append_bytes(GltfDocument& document, std::span<const std::byte> bytes) {
    document.binary.resize((document.binary.size() + 3) / 4 * 4);
    const std::size_t offset = document.binary.size();
    document.binary.insert(document.binary.end(), bytes.begin(), bytes.end());
    return offset;
}

void remove_extension(nlohmann::json& object, const char* name) {
    object["extensions"].erase(name);
    if (object["extensions"].empty()) object.erase("extensions");
}

void decompress(GltfDocument& document) {
    const bool meshopt = decompress_meshopt(document);
    const bool draco = decompress_draco(document);
    forget_extension(document.json, "EXT_meshopt_compression");
    forget_extension(document.json, "KHR_draco_mesh_compression");
    if (meshopt || draco) drop_unused_numbers(document);
}

}  // namespace mien
