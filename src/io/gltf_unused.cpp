// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// What stays is what can be reached: accessors from primitives, skins, animations and instances, buffer views from
// whatever says "bufferView". Views keep their order, so equal documents stay equal.

#include "io/gltf_unused.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <string>
#include <string_view>
#include <vector>

#include "mien/error.hpp"

namespace mien {

namespace {

using nlohmann::json;
using References = std::vector<json*>;

// Extensions outside these families may number accessors in ways of their own.
bool is_known(std::string_view extension) {
    constexpr std::array families{
        "KHR_", "EXT_texture_", "EXT_lights_", "EXT_mesh_gpu_instancing", "EXT_meshopt_compression", "VRM", "MIEN_"};
    return std::any_of(families.begin(), families.end(),
                       [&](std::string_view family) { return extension.substr(0, family.size()) == family; });
}

json* find(json& object, const char* name) {
    const auto found = object.is_object() ? object.find(name) : object.end();
    return object.is_object() && found != object.end() ? &*found : nullptr;
}

void add(References& references, json* reference) {
    if (reference && reference->is_number_unsigned()) references.push_back(reference);
}

void add_values(References& references, json* object) {
    if (object)
        for (json& value : *object) add(references, &value);
}

void add_primitive(References& references, json& primitive) {
    add_values(references, find(primitive, "attributes"));
    add(references, find(primitive, "indices"));
    if (json* targets = find(primitive, "targets"))
        for (json& target : *targets) add_values(references, &target);
}

References accessor_references(json& root) {
    References references;
    const auto each = [&](json* list, const auto& visit) {
        if (list)
            for (json& item : *list) visit(item);
    };
    each(find(root, "meshes"), [&](json& mesh) {
        each(find(mesh, "primitives"), [&](json& primitive) { add_primitive(references, primitive); });
    });
    each(find(root, "skins"), [&](json& skin) { add(references, find(skin, "inverseBindMatrices")); });
    each(find(root, "animations"), [&](json& animation) {
        each(find(animation, "samplers"), [&](json& sampler) {
            add(references, find(sampler, "input"));
            add(references, find(sampler, "output"));
        });
    });
    each(find(root, "nodes"), [&](json& node) {
        json* extensions = find(node, "extensions");
        json* instances = extensions ? find(*extensions, "EXT_mesh_gpu_instancing") : nullptr;
        if (instances) add_values(references, find(*instances, "attributes"));
    });
    return references;
}

// Every member "bufferView" outside of extras, at any depth.
References view_references(json& root) {
    References references;
    std::vector<json*> open{&root};
    while (!open.empty()) {
        json& value = *open.back();
        open.pop_back();
        if (value.is_object()) add(references, find(value, "bufferView"));
        for (auto child = value.begin(); child != value.end() && value.is_structured(); ++child)
            if (child->is_structured() && !(value.is_object() && child.key() == "extras")) open.push_back(&*child);
    }
    return references;
}

// Keeps the elements of a list that are referred to, and tells the references their new numbers.
void keep_used(json& root, const char* name, const References& references) {
    json* list = find(root, name);
    if (!list) return;
    std::vector<std::size_t> number(list->size(), 0);
    for (const json* reference : references) number.at(reference->get<std::size_t>()) = 1;
    json kept = json::array();
    for (std::size_t i = 0; i < number.size(); ++i) {
        if (number[i] == 0) continue;
        number[i] = kept.size();
        kept.push_back(std::move((*list)[i]));
    }
    for (json* reference : references) *reference = number[reference->get<std::size_t>()];
    *list = std::move(kept);
    if (list->empty()) root.erase(name);
}

// Puts the bytes of the views side by side. Views that share bytes could only grow the buffer; then it stays.
void keep_viewed_bytes(GltfDocument& document) {
    std::vector<std::byte> kept;
    std::vector<std::size_t> offsets;
    const std::vector<std::byte>& all = document.binary;
    json views = document.json.value("bufferViews", json::array());
    for (const json& view : views) {
        const auto offset = view.value("byteOffset", std::size_t{0}), length = view.at("byteLength").get<std::size_t>();
        if (offset > all.size() || length > all.size() - offset)
            throw Error(fmt::format("gltf: expected a bufferView within {} bytes, found one beyond", all.size()));
        kept.resize((kept.size() + 3) / 4 * 4);
        if (kept.size() + length > all.size()) return;
        offsets.push_back(kept.size());
        const auto first = all.begin() + static_cast<std::ptrdiff_t>(offset);
        kept.insert(kept.end(), first, first + static_cast<std::ptrdiff_t>(length));
    }
    for (std::size_t i = 0; i < offsets.size(); ++i) document.json["bufferViews"][i]["byteOffset"] = offsets[i];
    document.binary = std::move(kept);
}

}  // namespace

void drop_unused_numbers(GltfDocument& document) {
    const json used = document.json.value("extensionsUsed", json::array());
    const bool all_known = std::all_of(used.begin(), used.end(), [](const json& name) {
        return name.is_string() && is_known(name.get<std::string>());
    });
    if (!all_known) return;
    keep_used(document.json, "accessors", accessor_references(document.json));
    keep_used(document.json, "bufferViews", view_references(document.json));
    keep_viewed_bytes(document);
}

}  // namespace mien
