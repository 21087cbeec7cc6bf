// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// A source document is rewritten in place: what a head does not touch is never looked at, so it cannot be lost.
// Vectors follow the linear part M of a node's world matrix as the specification asks (3.7.2.1, 3.7.4): normals by the
// inverse transpose of M, tangents by M; where M mirrors, triangles turn round and the tangents' handedness flips.

#include "io/gltf_base.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include "io/gltf_builder.hpp"
#include "io/gltf_fresh.hpp"
#include "io/gltf_numbers.hpp"
#include "io/gltf_placement.hpp"

#include "mien/error.hpp"

namespace mien {

namespace {

using nlohmann::json;

bool begins_with(const std::string& text, std::string_view start) {
    return std::string_view(text).substr(0, start.size()) == start;
}

json& list_of(json& object, const char* name) {
    json& list = object[name];
    if (!list.is_array()) list = json::array();
    return list;
}

void drop_skinning(json& primitive) {
    json& attributes = primitive.at("attributes");
    std::vector<std::string> gone;
    for (const auto& [name, accessor] : attributes.items())
        if (begins_with(name, "JOINTS_") || begins_with(name, "WEIGHTS_")) gone.push_back(name);
    for (const std::string& name : gone) attributes.erase(name);
}

void drop_morph_targets(json& mesh) {
    mesh.erase("weights");
    if (!mesh.contains("extras") || !mesh["extras"].is_object()) return;
    mesh["extras"].erase("targetNames");
    if (mesh["extras"].empty()) mesh.erase("extras");
}

// What the source does by itself: animations, skins, morph targets.
void drop_motion(json& root) {
    root.erase("animations");
    root.erase("skins");
    for (json& node : list_of(root, "nodes")) {
        node.erase("skin");
        node.erase("weights");
    }
    for (json& mesh : list_of(root, "meshes")) {
        drop_morph_targets(mesh);
        for (json& primitive : mesh.at("primitives")) {
            drop_skinning(primitive);
            primitive.erase("targets");
        }
    }
}

std::vector<Vec3> vectors_of(const GltfDocument& document, std::size_t accessor, std::vector<double>* fourth) {
    const std::size_t width = element_width(document.json.at("accessors").at(accessor));
    const std::vector<double> numbers = accessor_numbers(document, accessor);
    if (width < 3)
        throw Error(fmt::format("gltf /accessors/{}: expected vectors, found {} numbers each", accessor, width));
    std::vector<Vec3> vectors;
    for (std::size_t i = 0; i < numbers.size(); i += width) {
        vectors.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
        if (fourth && width > 3) fourth->push_back(numbers[i + 3]);
    }
    return vectors;
}

Vec3f unit(const Vec3& v, const Vec3& otherwise) {
    const double size = length(v);
    return to_float(size > 0 && is_finite(v) ? v / size : otherwise);
}

void place_normals(GltfDocument& document, json& attributes, const Placement& placement) {
    const std::vector<Vec3> source = vectors_of(document, attributes["NORMAL"].get<std::size_t>(), nullptr);
    std::vector<Vec3f> placed;
    for (std::size_t v = 0; v < source.size(); ++v)
        placed.push_back(unit(normal_map(placement.linear(v)) * source[v], {0, 0, 1}));
    attributes["NORMAL"] = append_vectors(document, placed, BufferTarget::vertices);
}

void place_tangents(GltfDocument& document, json& attributes, const Placement& placement) {
    std::vector<double> hands;
    const std::vector<Vec3> source = vectors_of(document, attributes["TANGENT"].get<std::size_t>(), &hands);
    std::vector<float> placed;
    for (std::size_t v = 0; v < source.size(); ++v) {
        const Vec3f tangent = unit(placement.linear(v) * source[v], {1, 0, 0});
        const double hand = hands.empty() ? 1 : hands[v];
        const double turned = placement.mirrors() ? -hand : hand;
        placed.insert(placed.end(), {tangent.x, tangent.y, tangent.z, static_cast<float>(turned)});
    }
    attributes["TANGENT"] = append_floats(document, placed, Elements::vec4, BufferTarget::vertices);
}

std::vector<std::uint32_t> vertices_of(const Mesh& mesh, const Part& part, std::size_t expected) {
    if (part.vertex_count != expected || part.first_vertex + std::size_t{part.vertex_count} > mesh.positions.size())
        throw Error(fmt::format("gltf /meshes/{}/primitives/{}: expected {} vertices in the head, found {}", part.mesh,
                                part.primitive, expected, part.vertex_count));
    std::vector<std::uint32_t> vertices(part.vertex_count);
    for (std::uint32_t v = 0; v < part.vertex_count; ++v) vertices[v] = part.first_vertex + v;
    return vertices;
}

WrittenPrimitive place_part(GltfDocument& document, const Mesh& mesh, const Part& part, const Placement& placement) {
    // A copy, since what is appended may move the tree's arrays.
    json primitive = document.json.at("meshes").at(part.mesh).at("primitives").at(part.primitive);
    json& attributes = primitive.at("attributes");
    const auto source = attributes.at("POSITION").get<std::size_t>();
    const auto count = document.json.at("accessors").at(source).at("count").get<std::size_t>();
    WrittenPrimitive written{part.mesh, part.primitive, vertices_of(mesh, part, count)};
    const auto positions = std::span(mesh.positions).subspan(part.first_vertex, part.vertex_count);
    attributes["POSITION"] = append_vectors(document, positions, BufferTarget::vertices, Bounds::given);
    if (attributes.contains("NORMAL")) place_normals(document, attributes, placement);
    if (attributes.contains("TANGENT")) place_tangents(document, attributes, placement);
    if (placement.mirrors()) turn_triangles(document, primitive, count);
    document.json["meshes"][part.mesh]["primitives"][part.primitive] = std::move(primitive);
    return written;
}

std::size_t default_scene(json& root) {
    json& scenes = list_of(root, "scenes");
    if (scenes.empty()) scenes.push_back(json::object());
    const auto scene = root.value("scene", std::size_t{0});
    root["scene"] = scene;
    list_of(scenes.at(scene), "nodes");
    return scene;
}

// The mesh leaves its nodes, which keep children, cameras and lights, for a root of the scene.
std::size_t hang_on_root(GltfDocument& document, std::size_t mesh, std::size_t scene) {
    std::string name = document.json["meshes"][mesh].value("name", "");
    for (json& node : document.json["nodes"]) {
        if (node.value("mesh", std::size_t{0}) != mesh || !node.contains("mesh")) continue;
        if (name.empty()) name = node.value("name", "");
        node.erase("mesh");
    }
    json root = {{"mesh", mesh}};
    if (!name.empty()) root["name"] = name;
    const std::size_t index = append_object(document, "nodes", std::move(root));
    document.json["scenes"][scene]["nodes"].push_back(index);
    return index;
}

BaseDocument source_document(const Mesh& mesh) {
    BaseDocument base;
    GltfDocument& document = base.document;
    document = parse_glb(mesh.gltf);
    std::map<std::uint32_t, std::vector<const Part*>> meshes;
    for (const Part& part : mesh.parts) meshes[part.mesh].push_back(&part);
    base.scene = default_scene(document.json);
    const std::vector<Placement> placements = mesh_placements(document, base.scene);
    drop_motion(document.json);
    for (const auto& [number, parts] : meshes) {
        for (const Part* part : parts)
            base.primitives.push_back(place_part(document, mesh, *part, placements.at(number)));
        base.mesh_nodes.push_back(hang_on_root(document, number, base.scene));
    }
    drop_unused_numbers(document);
    return base;
}

[[noreturn]] void fail_on(const char* found) {
    throw Error(fmt::format("gltf: expected the document of the head as a reader leaves it, found {}", found));
}

}  // namespace

BaseDocument base_document(const Mesh& mesh) {
    try {
        BaseDocument base = mesh.gltf.empty() ? fresh_document(mesh) : source_document(mesh);
        base.document.json["asset"]["generator"] = "mien";
        return base;
    } catch (const json::exception& wrong) {
        fail_on(wrong.what());
    } catch (const std::out_of_range& wrong) {
        fail_on(wrong.what());
    }
}

}  // namespace mien
