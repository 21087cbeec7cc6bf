// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Meshopt comes first: it works on buffer views, and Draco's bytes lie in one.

#include "io/gltf_codecs.hpp"

#include <algorithm>
#include <fmt/format.h>

#include "io/gltf_accessors.hpp"
#include "io/gltf_decompress.hpp"
#include "io/gltf_document.hpp"
#include "io/gltf_json.hpp"
#include "io/gltf_unused.hpp"

namespace mien {

namespace {

constexpr std::uint64_t largest_growth = 128;

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

void spend(DecodeBudget& budget, std::uint64_t bytes, const std::string& pointer) {
    if (bytes > budget.bytes)
        fail_at(pointer, "compressed data that make a file of this size at most 128 times as large",
                fmt::format("{} bytes more than that", bytes - budget.bytes));
    budget.bytes -= bytes;
}

void decompress(GltfDocument& document) {
    DecodeBudget budget{largest_growth * document.binary.size()};
    const bool meshopt = decompress_meshopt(document, budget);
    const bool draco = decompress_draco(document, budget);
    forget_extension(document.json, "EXT_meshopt_compression");
    forget_extension(document.json, "KHR_draco_mesh_compression");
    if (meshopt || draco) drop_unused_numbers(document);
}

GltfDocument load_plain_gltf(std::span<const std::byte> bytes, const Fetch& fetch) {
    GltfDocument document = load_gltf(bytes, fetch);
    decompress(document);
    check_accessors(document);
    return document;
}

}  // namespace mien
