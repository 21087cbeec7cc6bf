// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Morph targets of glTF 2.0 (specification, 3.7.2.2) with weights over time (3.11). A mesh gets the targets that move
// one of its vertices, or that name one with a delta of zero, in the order of the track, on every one of its
// primitives, as the specification wants; a mesh that nothing moves stays as it is. A target is a sparse accessor over
// zeros (3.6.2.3) where that takes fewer bytes.

#include "io/gltf_morphs.hpp"

#include <algorithm>
#include <cstdint>
#include <fmt/format.h>
#include <limits>
#include <string>
#include <utility>

#include "io/gltf_builder.hpp"

#include "mien/error.hpp"
#include "mien/io/gltf.hpp"

namespace mien {

namespace {

using nlohmann::json;

void check(std::span<const MorphTarget> targets, std::size_t vertices) {
    for (const MorphTarget& target : targets) {
        if (target.deltas.size() != target.vertices.size())
            throw Error(fmt::format("morph \"{}\": expected {} deltas, found {}", target.name, target.vertices.size(),
                                    target.deltas.size()));
        for (const std::uint32_t v : target.vertices)
            if (v >= vertices)
                throw Error(
                    fmt::format("morph \"{}\": expected vertices below {}, found {}", target.name, vertices, v));
    }
}

void check(const MorphTrack& track) {
    const std::size_t values = track.times.size() * track.targets.size();
    if (track.weights.size() != values)
        throw Error(fmt::format("morphs: expected {} weights of {} targets in {} rows, found {}", values,
                                track.targets.size(), track.times.size(), track.weights.size()));
    if (!track.head.empty() && track.head.size() != track.times.size())
        throw Error(fmt::format("morphs: expected a head pose for each of {} rows, found {}", track.times.size(),
                                track.head.size()));
}

// One target on one primitive: which of its vertices move, and how far.
struct Moved {
    std::vector<std::uint32_t> at;
    std::vector<Vec3f> deltas;
};

// `deltas`: how far the target moves each vertex of the head.
Moved moved_of(const std::vector<Vec3f>& deltas, const WrittenPrimitive& written) {
    Moved moved;
    for (std::size_t i = 0; i < written.vertices.size(); ++i) {
        const Vec3f& delta = deltas[written.vertices[i]];
        if (delta == Vec3f{}) continue;
        moved.at.push_back(static_cast<std::uint32_t>(i));
        moved.deltas.push_back(delta);
    }
    return moved;
}

// The least and greatest delta; vertices that keep still count as zeros.
void add_bounds(json& accessor, const Moved& moved, std::size_t vertices) {
    const bool all = moved.at.size() == vertices;
    Vec3f low = all ? moved.deltas.front() : Vec3f{}, high = low;
    for (const Vec3f& d : moved.deltas) {
        low = {std::min(low.x, d.x), std::min(low.y, d.y), std::min(low.z, d.z)};
        high = {std::max(high.x, d.x), std::max(high.y, d.y), std::max(high.z, d.z)};
    }
    accessor["min"] = {low.x, low.y, low.z};
    accessor["max"] = {high.x, high.y, high.z};
}

bool is_narrow(std::size_t vertices) {
    return vertices <= std::size_t{std::numeric_limits<std::uint16_t>::max()} + 1;
}

bool sparse_is_smaller(const Moved& moved, std::size_t vertices) {
    constexpr std::size_t json_of_sparse_part = 160;
    const std::size_t index_size = is_narrow(vertices) ? sizeof(std::uint16_t) : sizeof(std::uint32_t);
    return moved.at.size() * (sizeof(Vec3f) + index_size) + json_of_sparse_part < vertices * sizeof(Vec3f);
}

json sparse_part(GltfDocument& document, const Moved& moved, std::size_t vertices) {
    constexpr int uint16_component = 5123, uint32_component = 5125;
    const bool narrow = is_narrow(vertices);
    const std::vector<std::uint16_t> shorts(narrow ? moved.at.begin() : moved.at.end(), moved.at.end());
    const std::size_t indices = append_view(
        document, narrow ? std::as_bytes(std::span(shorts)) : std::as_bytes(std::span(moved.at)), BufferTarget::none);
    const std::size_t values = append_view(document, std::as_bytes(std::span(moved.deltas)), BufferTarget::none);
    const int component = narrow ? uint16_component : uint32_component;
    return {{"count", moved.at.size()},
            {"indices", {{"bufferView", indices}, {"componentType", component}}},
            {"values", {{"bufferView", values}}}};
}

// An accessor of `vertices` deltas. Without a view of its own it is all zeros but for its sparse part; one with neither
// would be right too, but programs stumble over it, so a vertex that moves by nothing is named.
std::size_t append_deltas(GltfDocument& document, const Moved& moved, std::size_t vertices) {
    if (moved.at.empty()) return append_deltas(document, {{0}, {Vec3f{}}}, vertices);
    if (!sparse_is_smaller(moved, vertices)) {
        std::vector<Vec3f> dense(vertices);
        for (std::size_t i = 0; i < moved.at.size(); ++i) dense[moved.at[i]] = moved.deltas[i];
        return append_vectors(document, dense, BufferTarget::vertices, Bounds::given);
    }
    constexpr int float_component = 5126;
    json accessor = {{"componentType", float_component}, {"count", vertices}, {"type", "VEC3"}};
    add_bounds(accessor, moved, vertices);
    accessor["sparse"] = sparse_part(document, moved, vertices);
    return append_object(document, "accessors", std::move(accessor));
}

// What a mesh's own targets are: numbers of the track's, ascending.
using Targets = std::vector<std::size_t>;
using Primitives = std::span<const WrittenPrimitive>;

void append_target(GltfDocument& document, Primitives primitives, const std::vector<Vec3f>& deltas) {
    for (const WrittenPrimitive& written : primitives) {
        const std::size_t accessor = append_deltas(document, moved_of(deltas, written), written.vertices.size());
        json& primitive = document.json["meshes"][written.mesh]["primitives"][written.primitive];
        primitive["targets"].push_back({{"POSITION", accessor}});
    }
}

bool names_one(const std::vector<bool>& named, const WrittenPrimitive& written) {
    return std::any_of(written.vertices.begin(), written.vertices.end(), [&](std::uint32_t v) { return named[v]; });
}

Targets append_targets(GltfDocument& document, Primitives primitives, std::size_t vertices,
                       std::span<const MorphTarget> all) {
    Targets targets;
    std::vector<Vec3f> deltas(vertices);
    std::vector<bool> named(vertices);
    for (std::size_t t = 0; t < all.size(); ++t) {
        const MorphTarget& target = all[t];
        for (std::size_t i = 0; i < target.vertices.size(); ++i) deltas[target.vertices[i]] = target.deltas[i];
        for (const std::uint32_t v : target.vertices) named[v] = true;
        if (std::any_of(primitives.begin(), primitives.end(),
                        [&](const WrittenPrimitive& written) { return names_one(named, written); })) {
            append_target(document, primitives, deltas);
            targets.push_back(t);
        }
        for (const std::uint32_t v : target.vertices) {
            deltas[v] = {};
            named[v] = false;
        }
    }
    return targets;
}

void name_targets(json& mesh, const Targets& targets, std::span<const MorphTarget> all) {
    json names = json::array();
    for (const std::size_t t : targets) names.push_back(all[t].name);
    if (!mesh.contains("extras") || !mesh["extras"].is_object()) mesh["extras"] = json::object();
    mesh["extras"]["targetNames"] = std::move(names);
    mesh["weights"] = std::vector<float>(targets.size());
}

// The primitives of the document's mesh that hangs on a node.
Primitives primitives_of(const BaseDocument& base, std::size_t node) {
    const auto mesh = base.document.json.at("nodes").at(node).at("mesh").get<std::size_t>();
    const auto is_before = [](const WrittenPrimitive& written, std::size_t number) { return written.mesh < number; };
    const auto is_after = [](std::size_t number, const WrittenPrimitive& written) { return number < written.mesh; };
    const auto first = std::lower_bound(base.primitives.begin(), base.primitives.end(), mesh, is_before);
    return {first, std::upper_bound(first, base.primitives.end(), mesh, is_after)};
}

// A sampler and a channel for each thing that moves.
struct Animation {
    std::size_t input;
    json samplers = json::array(), channels = json::array();
};

void append_channel(Animation& animation, std::size_t node, const char* path, std::size_t output) {
    animation.channels.push_back(
        {{"sampler", animation.samplers.size()}, {"target", {{"node", node}, {"path", path}}}});
    animation.samplers.push_back({{"input", animation.input}, {"output", output}, {"interpolation", "LINEAR"}});
}

// The head as a node above its meshes, which are roots of the scene until then.
std::size_t hang_on_head(BaseDocument& base) {
    json& root = base.document.json;
    const std::size_t head = append_object(base.document, "nodes", {{"name", "head"}, {"children", base.mesh_nodes}});
    json roots = json::array({head});
    for (const json& node : root["scenes"][base.scene]["nodes"])
        if (std::find(base.mesh_nodes.begin(), base.mesh_nodes.end(), node.get<std::size_t>()) == base.mesh_nodes.end())
            roots.push_back(node);
    root["scenes"][base.scene]["nodes"] = std::move(roots);
    return head;
}

void append_head(BaseDocument& base, Animation& animation, const MorphTrack& track, const Keys& keys) {
    std::vector<float> rotations, translations;
    for (const std::size_t r : keys.rows) {
        append_rotation(rotations, track.head[r].rotation);
        append_translation(translations, track.head[r].translation);
    }
    const std::size_t head = hang_on_head(base);
    append_channel(animation, head, "rotation",
                   append_floats(base.document, rotations, Elements::vec4, BufferTarget::none));
    append_channel(animation, head, "translation",
                   append_floats(base.document, translations, Elements::vec3, BufferTarget::none));
}

void append_animation(BaseDocument& base, const std::vector<MorphedMesh>& all, const MorphTrack& track) {
    const Keys keys = keys_of(track.times);
    if ((all.empty() && track.head.empty()) || keys.times.empty()) return;
    GltfDocument& document = base.document;
    Animation animation{append_floats(document, keys.times, Elements::scalar, BufferTarget::none, Bounds::given)};
    for (const MorphedMesh& moving : all) {
        const std::vector<float> weights = weights_at_keys(moving, track.weights, track.targets.size(), keys);
        append_channel(animation, moving.node, "weights",
                       append_floats(document, weights, Elements::scalar, BufferTarget::none));
    }
    if (!track.head.empty()) append_head(base, animation, track, keys);
    append_object(
        document, "animations",
        {{"name", "take"}, {"samplers", std::move(animation.samplers)}, {"channels", std::move(animation.channels)}});
}

}  // namespace

std::vector<MorphedMesh> append_morphs(BaseDocument& base, std::size_t vertices, std::span<const MorphTarget> targets) {
    check(targets, vertices);
    json& root = base.document.json;
    std::vector<MorphedMesh> all;
    for (const std::size_t node : base.mesh_nodes) {
        Targets own = append_targets(base.document, primitives_of(base, node), vertices, targets);
        if (own.empty()) continue;
        name_targets(root["meshes"][root["nodes"][node]["mesh"].get<std::size_t>()], own, targets);
        all.push_back({node, std::move(own)});
    }
    return all;
}

std::vector<float> weights_at_keys(const MorphedMesh& mesh, std::span<const float> weights, std::size_t count,
                                   const Keys& keys) {
    std::vector<float> values;
    for (const std::size_t r : keys.rows)
        for (const std::size_t t : mesh.targets) values.push_back(weights[r * count + t]);
    return values;
}

std::vector<std::byte> format_glb(const Mesh& mesh, const MorphTrack& track) {
    check(track);
    BaseDocument base = base_document(mesh);
    const std::vector<MorphedMesh> all = append_morphs(base, vertex_count(mesh), track.targets);
    append_animation(base, all, track);
    return format_glb(base.document);
}

}  // namespace mien
