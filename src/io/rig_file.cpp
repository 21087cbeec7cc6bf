// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// A rig file is the GLB of the skinned head, which any program shows, with the exact rig beside it in the extension
// MIEN_rig (docs/rig-file.md). The skin is written after everything that the head itself needs, and the extension says
// where the head ends: cut there, the document is the neutral head again, number for number.

#include <algorithm>
#include <fmt/format.h>
#include <string>
#include <utility>

#include "io/gltf_base.hpp"
#include "io/gltf_builder.hpp"
#include "io/gltf_json.hpp"
#include "io/gltf_morphs.hpp"
#include "io/gltf_skin.hpp"
#include "io/rig_extension.hpp"
#include "io/text.hpp"

#include "mien/error.hpp"
#include "mien/io/gltf.hpp"

namespace mien {

namespace {

using nlohmann::json;

constexpr const char* extension_name = "MIEN_rig";
constexpr const char* shortened_lists[]{"nodes", "accessors", "bufferViews"};
const std::string neutral_pointer = std::string(rig_pointer) + "/neutral";

void check_head(const Mesh& mesh, const Rig& rig) {
    if (mesh.positions.size() != rig.rest.size())
        throw Error(fmt::format("rig file: expected the head of the rig with {} vertices, found one with {}",
                                rig.rest.size(), mesh.positions.size()));
    if (mesh.positions != rig.rest)
        throw Error("rig file: expected the head that was rigged, found its vertices at other places");
}

// Where the neutral head ends in each list of the document.
json neutral_counts(const BaseDocument& base) {
    const json& root = base.document.json;
    json counts = {{"byteLength", base.document.binary.size()}};
    for (const char* list : shortened_lists) counts[list] = element_count(root, list);
    counts["sceneNodes"] = root.at("scenes").at(base.scene).at("nodes");
    return counts;
}

void add_extension(json& root, json extension) {
    root["extensions"][extension_name] = std::move(extension);
    json& used = root["extensionsUsed"];
    if (std::find(used.begin(), used.end(), extension_name) == used.end()) used.push_back(extension_name);
}

const json* find_extension(const json& root) {
    return find_member(object_member(root, "extensions", ""), extension_name, "/extensions");
}

void shorten(json& root, const char* list, const json& neutral) {
    const std::uint64_t count = whole_member(neutral, list, neutral_pointer);
    const std::size_t size = element_count(root, list);
    if (count > size) fail_at(neutral_pointer + '/' + list, fmt::format("at most {}", size), fmt::format("{}", count));
    if (count == 0) root.erase(list);
    if (count > 0) root[list].erase(root[list].begin() + static_cast<std::ptrdiff_t>(count), root[list].end());
}

void drop_targets(json& mesh) {
    mesh.erase("weights");
    if (!mesh.contains("extras") || !mesh["extras"].is_object()) return;
    mesh["extras"].erase("targetNames");
    if (mesh["extras"].empty()) mesh.erase("extras");
}

void drop_joints(json& primitive) {
    if (!primitive.is_object() || !primitive.contains("attributes") || !primitive["attributes"].is_object()) return;
    json kept = json::object();
    for (const auto& [name, accessor] : primitive["attributes"].items())
        if (!name.starts_with("JOINTS_") && !name.starts_with("WEIGHTS_")) kept[name] = accessor;
    primitive["attributes"] = std::move(kept);
    primitive.erase("targets");
}

void drop_skin(json& root) {
    root.erase("skins");
    root.erase("animations");
    for (std::size_t i = 0; i < element_count(root, "nodes"); ++i)
        if (root["nodes"][i].is_object()) root["nodes"][i].erase("skin");
    for (std::size_t i = 0; i < element_count(root, "meshes"); ++i)
        if (root["meshes"][i].is_object() && root["meshes"][i].contains("primitives")) {
            drop_targets(root["meshes"][i]);
            for (json& primitive : root["meshes"][i]["primitives"]) drop_joints(primitive);
        }
}

void restore_scene(json& root, const json& neutral) {
    const std::uint64_t scene = whole_member(root, "scene", "", 0);
    const std::size_t scenes = element_count(root, "scenes");
    if (scene >= scenes) fail_at("/scene", fmt::format("one of {} scenes", scenes), fmt::format("{}", scene));
    if (!root["scenes"][scene].is_object())
        fail_found(fmt::format("/scenes/{}", scene), "an object", root["scenes"][scene]);
    if (!neutral.contains("sceneNodes")) fail_at(neutral_pointer + "/sceneNodes", "an array", "none");
    root["scenes"][scene]["nodes"] = array_member(neutral, "sceneNodes", neutral_pointer);
}

// The document of the head before it was skinned. What it refers to is checked when it is read as a mesh.
GltfDocument neutral_document(GltfDocument document, const json& neutral) {
    json& root = document.json;
    drop_skin(root);
    for (const char* list : shortened_lists) shorten(root, list, neutral);
    restore_scene(root, neutral);
    const std::uint64_t length = whole_member(neutral, "byteLength", neutral_pointer);
    if (length > document.binary.size())
        fail_at(neutral_pointer + "/byteLength", fmt::format("at most {}", document.binary.size()),
                fmt::format("{}", length));
    document.binary.resize(length);
    drop_rig_extension(root);
    return document;
}

std::vector<std::byte> no_files(std::string_view uri) {
    throw Error(fmt::format("rig file: expected everything in one file, found uri {}", shown(uri)));
}

Mesh read_mesh(const GltfDocument& document, const json& extension, const Rig& rig) {
    if (const json* head = find_member(extension, "head", rig_pointer)) return read_head(document, *head, rig.rest);
    const json* neutral = find_member(extension, "neutral", rig_pointer);
    if (neutral == nullptr) fail_at(rig_pointer, "\"head\" or \"neutral\"", "neither");
    Mesh mesh = parse_gltf(format_glb(neutral_document(document, *neutral)), no_files);
    if (mesh.positions.size() != rig.rest.size())
        fail_at(std::string(rig_pointer) + "/rest/count",
                fmt::format("the {} vertices of the head", mesh.positions.size()), fmt::format("{}", rig.rest.size()));
    return mesh;
}

}  // namespace

void drop_rig_extension(json& root) {
    const auto drop_empty = [&](const char* name) {
        if (root.contains(name) && root[name].empty()) root.erase(name);
    };
    if (find_extension(root) == nullptr) return;
    root["extensions"].erase(extension_name);
    json kept = json::array();
    for (const json& name : array_member(root, "extensionsUsed", ""))
        if (name != extension_name) kept.push_back(name);
    root["extensionsUsed"] = std::move(kept);
    drop_empty("extensions");
    drop_empty("extensionsUsed");
}

std::vector<std::byte> format_rig(const Mesh& mesh, const Rig& rig, const Skin& skin) {
    check_head(mesh, rig);
    BaseDocument base = base_document(mesh);
    const json neutral = neutral_counts(base);
    append_skin(base, rig, skin);
    if (rig.prior) append_morphs(base, vertex_count(mesh), rig.prior->shapes);
    json extension = append_rig(base.document, rig);
    if (mesh.gltf.empty())
        extension["head"] = append_head(base.document, mesh);
    else
        extension["neutral"] = neutral;
    add_extension(base.document.json, std::move(extension));
    return format_glb(base.document);
}

bool is_rig(const Mesh& mesh) {
    return !mesh.gltf.empty() && find_extension(parse_glb(mesh.gltf).json) != nullptr;
}

RigFile parse_rig(std::span<const std::byte> bytes) {
    const GltfDocument document = parse_glb(bytes);
    const json* extension = find_extension(document.json);
    if (extension == nullptr) fail_at(rig_pointer, "the rig of a rig file", "none");
    RigFile file;
    file.rig = read_rig_extension(document, *extension);
    file.mesh = read_mesh(document, *extension, file.rig);
    return file;
}

}  // namespace mien
