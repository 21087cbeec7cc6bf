// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// A source document is rewritten in place: what a head does not touch is never looked at, so it cannot be lost.
// Vectors follow the linear part M of a node's world matrix as the specification asks (3.7.2.1, 3.7.4): normals by the
// inverse transpose of M, tangents by M; where M mirrors, triangles turn round and the tangents' handedness flips.

#include "io/gltf_base.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "io/gltf_accessors.hpp"
#include "io/gltf_builder.hpp"
#include "io/gltf_fresh.hpp"
#include "io/gltf_primitive.hpp"
#include "io/gltf_reshape.hpp"
#include "io/gltf_rest_pose.hpp"
#include "io/gltf_unused.hpp"
#include "io/rig_extension.hpp"

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

void drop_target_names(json& owner) {
    if (!owner.contains("extras") || !owner["extras"].is_object()) return;
    owner["extras"].erase("targetNames");
    if (owner["extras"].empty()) owner.erase("extras");
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
        mesh.erase("weights");
        drop_target_names(mesh);
        for (json& primitive : mesh.at("primitives")) {
            drop_skinning(primitive);
            drop_target_names(primitive);
            primitive.erase("targets");
        }
    }
}

// How the vertices of one primitive come into the scene.
struct Placement {
    std::vector<Affine> maps;  // one for all vertices, or one for each

    [[nodiscard]] const Affine& map(std::size_t vertex) const { return maps.size() == 1 ? maps[0] : maps[vertex]; }
    [[nodiscard]] bool keeps() const { return maps.size() == 1 && maps[0].columns == Affine{}.columns; }
    [[nodiscard]] bool mirrors() const { return maps.size() == 1 && determinant(maps[0]) < 0; }
};

// The inverse transpose times |det|, which needs no division, applied to a normal.
Vec3 turned_normal(const Affine& map, const Vec3& normal) {
    const auto& c = map.columns;
    const double sign = determinant(map) < 0 ? -1 : 1;
    return sign * (normal.x * cross(c[1], c[2]) + normal.y * cross(c[2], c[0]) + normal.z * cross(c[0], c[1]));
}

Vec3f unit(const Vec3& v, const Vec3& otherwise) {
    const double size = length(v);
    return to_float(size > 0 && std::isfinite(size) ? v / size : otherwise);
}

void place_normals(GltfDocument& document, json& attributes, const Placement& placement, const std::string& pointer) {
    const std::vector<float> n =
        read_floats(document, attributes["NORMAL"].get<std::size_t>(), 3, pointer + "/attributes/NORMAL");
    std::vector<Vec3f> placed;
    for (std::size_t v = 0; v < n.size() / 3; ++v) {
        const Vec3 normal{n[3 * v], n[3 * v + 1], n[3 * v + 2]};
        placed.push_back(unit(turned_normal(placement.map(v), normal), {0, 0, 1}));
    }
    attributes["NORMAL"] = append_vectors(document, placed, BufferTarget::vertices);
}

void place_tangents(GltfDocument& document, json& attributes, const Placement& placement, const std::string& pointer) {
    const std::vector<float> t =
        read_floats(document, attributes["TANGENT"].get<std::size_t>(), 4, pointer + "/attributes/TANGENT");
    std::vector<float> placed;
    for (std::size_t v = 0; v < t.size() / 4; ++v) {
        const Vec3f tangent = unit(turned(placement.map(v), {t[4 * v], t[4 * v + 1], t[4 * v + 2]}), {1, 0, 0});
        const float hand = t[4 * v + 3];
        placed.insert(placed.end(), {tangent.x, tangent.y, tangent.z, placement.mirrors() ? -hand : hand});
    }
    attributes["TANGENT"] = append_floats(document, placed, Elements::vec4, BufferTarget::vertices);
}

// Turns the triangles of a primitive round: strips and fans become lists. Points and lines stay.
void turn_triangles(GltfDocument& document, json& primitive, const Placement& placement, std::size_t vertices,
                    const std::string& pointer) {
    ReadBudget budget = read_budget(document.binary.size());
    const std::vector<std::uint32_t> round =
        triangles_of({&document, &primitive, pointer, vertices, 0, placement.maps}, budget);
    if (round.empty()) return;
    primitive["indices"] = append_indices(document, round);
    primitive["mode"] = 4;
}

std::vector<std::uint32_t> vertices_of(const Mesh& mesh, const Part& part, std::size_t expected) {
    if (part.vertex_count != expected || part.first_vertex + std::size_t{part.vertex_count} > mesh.positions.size())
        throw Error(fmt::format("gltf /meshes/{}/primitives/{}: expected {} vertices in the head, found {}", part.mesh,
                                part.primitive, expected, part.vertex_count));
    std::vector<std::uint32_t> vertices(part.vertex_count);
    for (std::uint32_t v = 0; v < part.vertex_count; ++v) vertices[v] = part.first_vertex + v;
    return vertices;
}

// Whether an accessor holds these very positions, as plain floats: then it stays.
bool is_in_place(const GltfDocument& document, std::size_t accessor, std::span<const Vec3f> positions,
                 const std::string& pointer) {
    constexpr int float_component = 5126;
    const json& source = document.json["accessors"][accessor];
    if (source.at("componentType") != float_component || !source.contains("min")) return false;
    const std::vector<float> p = read_floats(document, accessor, 3, pointer + "/attributes/POSITION");
    bool same = p.size() == 3 * positions.size();
    for (std::size_t v = 0; same && v < positions.size(); ++v)
        same = positions[v] == Vec3f{p[3 * v], p[3 * v + 1], p[3 * v + 2]};
    return same;
}

std::vector<Vec3> placed_vertices(const GltfDocument& document, const json& attributes, const Placement& placement,
                                  const std::string& pointer) {
    const std::vector<float> p =
        read_floats(document, attributes.at("POSITION").get<std::size_t>(), 3, pointer + "/attributes/POSITION");
    std::vector<Vec3> placed;
    for (std::size_t v = 0; v < p.size() / 3; ++v)
        placed.push_back(moved(placement.map(v), {p[3 * v], p[3 * v + 1], p[3 * v + 2]}));
    return placed;
}

WrittenPrimitive place_part(GltfDocument& document, const Mesh& mesh, const Part& part, const Standing& standing) {
    const std::string pointer = fmt::format("/meshes/{}/primitives/{}", part.mesh, part.primitive);
    // A copy, since what is appended may move the tree's arrays.
    json primitive = document.json["meshes"][part.mesh].at("primitives").at(part.primitive);
    json& attributes = primitive.at("attributes");
    const std::size_t count = accessor_count(document, attributes.at("POSITION").get<std::size_t>());
    WrittenPrimitive written{part.mesh, part.primitive, vertices_of(mesh, part, count)};
    const Placement placement{vertex_maps(standing, {&document, &primitive, pointer, count})};
    const auto positions = std::span(mesh.positions).subspan(part.first_vertex, part.vertex_count);
    const bool in_place = is_in_place(document, attributes["POSITION"].get<std::size_t>(), positions, pointer);
    const std::vector<Vec3> placed =
        in_place ? std::vector<Vec3>() : placed_vertices(document, attributes, placement, pointer);
    if (!in_place) attributes["POSITION"] = append_vectors(document, positions, BufferTarget::vertices, Bounds::given);
    const bool turns = !placement.keeps();
    if (turns && attributes.contains("NORMAL")) place_normals(document, attributes, placement, pointer);
    if (turns && attributes.contains("TANGENT")) place_tangents(document, attributes, placement, pointer);
    if (!in_place && is_reshaped(mesh, part, placed)) turn_surface(document, attributes, mesh, part, placed, pointer);
    if (placement.mirrors()) turn_triangles(document, primitive, placement, count, pointer);
    document.json["meshes"][part.mesh]["primitives"][part.primitive] = std::move(primitive);
    return written;
}

// Every node that is no child: what is shown where there is no scene.
json root_nodes(const json& root) {
    const json nodes = root.value("nodes", json::array());
    std::vector<bool> child(nodes.size(), false);
    for (const json& node : nodes)
        for (const json& below : node.value("children", json::array())) child.at(below.get<std::size_t>()) = true;
    json roots = json::array();
    for (std::size_t n = 0; n < child.size(); ++n)
        if (!child[n]) roots.push_back(n);
    return roots;
}

std::size_t default_scene(json& root) {
    json& scenes = list_of(root, "scenes");
    if (scenes.empty()) {
        scenes.push_back(json::object());
        scenes[0]["nodes"] = root_nodes(root);
    }
    const auto scene = root.value("scene", std::size_t{0});
    root["scene"] = scene;
    list_of(scenes.at(scene), "nodes");
    return scene;
}

// Whether a node is a root of the scene that does nothing but show its mesh.
bool shows_only(const json& node, std::size_t index, const json& roots) {
    bool plain = std::find(roots.begin(), roots.end(), index) != roots.end();
    for (const auto& member : node.items())
        plain = plain && (member.key() == "mesh" || member.key() == "name" || member.key() == "extras");
    return plain;
}

// The node that shows a mesh already as it should be shown, if no other shows it too.
std::optional<std::size_t> plain_root(const json& root, std::size_t mesh, std::size_t scene) {
    const json& nodes = root.at("nodes");
    std::optional<std::size_t> found;
    for (std::size_t n = 0; n < nodes.size(); ++n) {
        if (!nodes[n].contains("mesh") || nodes[n]["mesh"].get<std::size_t>() != mesh) continue;
        if (found || !shows_only(nodes[n], n, root.at("scenes").at(scene).at("nodes"))) return std::nullopt;
        found = n;
    }
    return found;
}

// The mesh leaves its nodes, which keep children, cameras and lights, for a root of the scene.
std::size_t hang_on_root(GltfDocument& document, std::size_t mesh, std::size_t scene) {
    if (const auto node = plain_root(document.json, mesh, scene)) return *node;
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

// Meshes that the scene does not show stay where they are, and so do primitives without vertices of their own.
BaseDocument source_document(const Mesh& mesh) {
    BaseDocument base;
    GltfDocument& document = base.document;
    document = parse_glb(mesh.gltf);
    drop_rig_extension(document.json);
    check_accessors(document);
    const std::vector<Standing> stands = standings(document);
    std::map<std::uint32_t, std::vector<const Part*>> meshes;
    for (const Part& part : mesh.parts) meshes[part.mesh].push_back(&part);
    base.scene = default_scene(document.json);
    for (const auto& [number, parts] : meshes) {
        if (!stands.at(number).node) continue;
        for (const Part* part : parts)
            if (part->vertex_count > 0) base.primitives.push_back(place_part(document, mesh, *part, stands[number]));
        base.mesh_nodes.push_back(hang_on_root(document, number, base.scene));
    }
    drop_motion(document.json);
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
