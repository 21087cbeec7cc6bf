// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// What stays is what can be reached: accessors from primitives, skins, animations and instances, buffer views from
// whatever says "bufferView". Views keep their order, so equal documents stay equal.

#include "io/gltf_unused.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
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

// Some exporters write 3.0 where 3 is meant, and numbers that were set in memory may have a sign.
bool is_whole(const json& value) {
    if (value.is_number_unsigned()) return true;
    if (value.is_number_integer()) return value.get<std::int64_t>() >= 0;
    return value.is_number_float() && value.get<double>() >= 0 && value.get<double>() < 1e15 &&
           std::floor(value.get<double>()) == value.get<double>();
}

void add(References& references, json* reference) {
    if (reference && is_whole(*reference)) references.push_back(reference);
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

// Every member "bufferView" in a value, at any depth, outside of extras.
void add_views(References& references, json& root) {
    std::vector<json*> open{&root};
    while (!open.empty()) {
        json& value = *open.back();
        open.pop_back();
        if (value.is_object()) add(references, find(value, "bufferView"));
        for (auto child = value.begin(); child != value.end() && value.is_structured(); ++child)
            if (child->is_structured() && !(value.is_object() && child.key() == "extras")) open.push_back(&*child);
    }
}

References view_references(json& root) {
    References references;
    add_views(references, root);
    return references;
}

// Which of `size` elements are referred to.
std::vector<bool> marks(const References& references, std::size_t size, const char* name) {
    std::vector<bool> used(size, false);
    for (const json* reference : references) {
        const auto number = reference->get<std::size_t>();
        if (number >= size)
            throw Error(fmt::format("gltf: expected one of {} {}, found number {}", size, name, number));
        used[number] = true;
    }
    return used;
}

// Keeps the elements of a list that are referred to, and tells the references their new numbers.
void keep_used(json& root, const char* name, const References& references) {
    json* list = find(root, name);
    if (!list) return;
    const std::vector<bool> used = marks(references, list->size(), name);
    std::vector<std::size_t> number(used.size(), 0);
    json kept = json::array();
    for (std::size_t i = 0; i < number.size(); ++i) {
        if (!used[i]) continue;
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

// Whether all that may refer to a number is known here.
bool refers_in_known_ways(const json& root) {
    const json used = root.value("extensionsUsed", json::array());
    return std::all_of(used.begin(), used.end(),
                       [](const json& name) { return name.is_string() && is_known(name.get<std::string>()); });
}

std::size_t size_of(json& root, const char* name) {
    const json* list = find(root, name);
    return list ? list->size() : 0;
}

}  // namespace

std::vector<bool> used_views(json& root) {
    const std::size_t views = size_of(root, "bufferViews");
    if (!refers_in_known_ways(root)) return std::vector<bool>(views, true);
    const std::vector<bool> accessors = marks(accessor_references(root), size_of(root, "accessors"), "accessors");
    References references;
    for (auto& [name, member] : root.items())
        if (name != "accessors" && name != "extras") add_views(references, member);
    for (std::size_t a = 0; a < accessors.size(); ++a)
        if (accessors[a]) add_views(references, root["accessors"][a]);
    return marks(references, views, "bufferViews");
}

void drop_unused_numbers(json& root) {
    if (!refers_in_known_ways(root)) return;
    keep_used(root, "accessors", accessor_references(root));
    keep_used(root, "bufferViews", view_references(root));
}

void drop_unused_numbers(GltfDocument& document) {
    if (!refers_in_known_ways(document.json)) return;
    drop_unused_numbers(document.json);
    keep_viewed_bytes(document);
}

}  // namespace mien
