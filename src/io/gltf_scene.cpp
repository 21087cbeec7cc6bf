// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// A glTF 2.0 document as a scene. Only what the scene that is opened first shows is read; of materials and pictures
// only what is used.

#include "io/gltf_scene.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "io/gltf_accessors.hpp"
#include "io/gltf_binding.hpp"
#include "io/gltf_channels.hpp"
#include "io/gltf_codecs.hpp"
#include "io/gltf_json.hpp"
#include "io/gltf_material.hpp"
#include "io/gltf_nodes.hpp"
#include "io/gltf_primitive.hpp"
#include "io/gltf_surface.hpp"
#include "io/text.hpp"

#include "mien/io/scene.hpp"

namespace mien {

namespace {

using nlohmann::json;

// The scene while it grows.
struct Growing {
    const GltfDocument& document;
    Looks looks;
    Scene scene;
    ReadBudget budget;
    Pictures pictures;
    std::vector<std::uint32_t> node_numbers;  // of each node of the document in scene.nodes
    std::map<std::optional<std::size_t>, std::uint32_t> material_numbers;
    std::vector<DocumentMaterial> materials;  // beside scene.materials
    std::uint64_t mesh_vertices = 0;          // that meshes may still have, shown or not, as read_mesh bounds them
    std::uint32_t first_vertex = 0;           // of the mesh that comes next, as read_mesh counts
};

// "mesh 2 'head'": what is number `number` of the array `list`.
std::string title(const GltfDocument& document, const char* what, const char* list, std::size_t number) {
    const std::string name = text_member(document.json[list][number], "name", fmt::format("/{}/{}", list, number));
    return name.empty() ? fmt::format("{} {}", what, number) : fmt::format("{} {} {}", what, number, shown(name));
}

// The weights of a mesh's targets at rest: those of the node, or of the mesh, or none.
std::vector<float> weights_at_rest(Growing& out, const json& node, std::size_t number, std::size_t mesh) {
    const std::string pointer = fmt::format("/nodes/{}", number), mesh_pointer = fmt::format("/meshes/{}", mesh);
    const std::size_t targets = target_count(out.document, mesh);
    spend(out.budget.targets, targets, "morph targets", pointer);
    std::vector<float> weights(targets);
    auto given = find_numbers(node, "weights", targets, pointer);
    if (!given) given = find_numbers(out.document.json["meshes"][mesh], "weights", targets, mesh_pointer);
    constexpr double most = std::numeric_limits<float>::max();
    for (std::size_t t = 0; given && t < targets; ++t)
        weights[t] = static_cast<float>(std::clamp((*given)[t], -most, most));
    return weights;
}

void add_nodes(Growing& out, const SceneNodes& tree) {
    const json& nodes = array_member(out.document.json, "nodes", "");
    out.node_numbers.resize(nodes.size());
    for (const std::size_t n : tree.order) {
        Node node = read_node(nodes[n], n);
        if (tree.parents[n] != no_parent) node.parent = out.node_numbers[tree.parents[n]];
        const auto mesh = find_whole(nodes[n], "mesh", fmt::format("/nodes/{}", n));
        if (mesh) node.morph_weights = weights_at_rest(out, nodes[n], n, *mesh);
        out.node_numbers[n] = static_cast<std::uint32_t>(out.scene.nodes.size());
        out.scene.nodes.push_back(std::move(node));
    }
}

void add_skins(Growing& out) {
    constexpr std::size_t most = std::size_t{1} << 16;
    for (std::size_t s = 0; s < element_count(out.document.json, "skins"); ++s) {
        const std::string pointer = fmt::format("/skins/{}", s);
        const auto binds = find_whole(out.document.json["skins"][s], "inverseBindMatrices", pointer);
        if (binds) spend(out.budget.influences, accessor_count(out.document, *binds) * 16, "numbers of skins", pointer);
        DocumentSkin skin = read_skin(out.document, s);
        if (skin.joints.size() > most)
            fail_at(pointer + "/joints", fmt::format("at most {}", most), std::to_string(skin.joints.size()));
        SceneSkin added{{}, std::move(skin.inverse_binds)};
        for (const std::size_t joint : skin.joints) added.joints.push_back(out.node_numbers[joint]);
        out.scene.skins.push_back(std::move(added));
    }
}

std::uint32_t material_of(Growing& out, const Primitive& primitive) {
    const auto number =
        out.looks == Looks::read ? find_accessor(*primitive.value, "material", primitive.pointer) : std::nullopt;
    const auto [known, is_new] = out.material_numbers.emplace(number, static_cast<std::uint32_t>(out.materials.size()));
    if (!is_new) return known->second;
    out.materials.push_back(number ? read_material(out.pictures, *number)
                                   : DocumentMaterial{material_of_none(), {}, true, "no material"});
    return known->second;
}

bool leaves_the_picture(const Surface& surface) {
    constexpr float least = -1e-4F, most = 1 + 1e-4F;
    return std::any_of(surface.uvs.begin(), surface.uvs.end(),
                       [](const Vec2f& uv) { return uv.x < least || uv.x > most || uv.y < least || uv.y > most; });
}

// What a primitive has and a surface has not.
void name_the_rest(Growing& out, const Primitive& primitive, const Surface& surface, const std::string& whose) {
    std::vector<std::string>& left_out = out.scene.left_out;
    if (attributes_of(primitive).contains("COLOR_0")) left_out.push_back(whose + ": colours of vertices");
    const json& targets = array_member(*primitive.value, "targets", primitive.pointer);
    const auto turns = [](const json& target) { return target.is_object() && target.contains("NORMAL"); };
    if (std::any_of(targets.begin(), targets.end(), turns)) left_out.push_back(whose + ": normals of morph targets");
    const DocumentMaterial& material = out.materials[surface.material];
    if (!material.repeats && leaves_the_picture(surface))
        left_out.push_back(fmt::format("{}: how {} goes on beyond the edge of its pictures", whose, material.title));
}

// Where a mesh is shown.
struct Place {
    std::uint32_t node = 0;
    std::optional<std::uint32_t> skin;
};

void add_surface(Growing& out, const Primitive& primitive, const Place& place, Surface surface,
                 const std::vector<std::string>& morphs) {
    Surface added = read_surface(primitive, out.materials[surface.material].mapping, morphs, out.budget);
    added.name = std::move(surface.name);
    added.mesh = surface.mesh;
    added.primitive = surface.primitive;
    added.material = surface.material;
    added.node = place.node;
    if (place.skin) bind_surface(added, primitive, *place.skin, out.scene.skins[*place.skin].joints.size(), out.budget);
    out.scene.surfaces.push_back(std::move(added));
}

bool is_drawn(const Primitive& primitive) {
    return whole_member(*primitive.value, "mode", primitive.pointer, 4) >= 4;
}

void add_primitive(Growing& out, const Primitive& primitive, const Surface& about, const std::vector<Place>& places,
                   const std::vector<std::string>& morphs) {
    const std::string whose =
        fmt::format("{}, primitive {}", title(out.document, "mesh", "meshes", about.mesh), about.primitive);
    if (!is_drawn(primitive)) {
        out.scene.left_out.push_back(whose + ": points and lines");
        return;
    }
    Surface surface = about;
    surface.material = material_of(out, primitive);
    for (const Place& place : places) add_surface(out, primitive, place, surface, morphs);
    name_the_rest(out, primitive, out.scene.surfaces.back(), whose);
}

void add_mesh(Growing& out, std::size_t m, const std::vector<Place>& places) {
    const json& value = out.document.json["meshes"][m];
    const std::vector<std::string> morphs = target_names(out.document, m);
    if (places.empty())
        out.scene.left_out.push_back(title(out.document, "mesh", "meshes", m) + ": the scene does not show it");
    Surface about;
    about.name = text_member(value, "name", fmt::format("/meshes/{}", m));
    about.mesh = static_cast<std::uint32_t>(m);
    for (Primitive& primitive : primitives_of(out.document, m)) {
        spend(out.mesh_vertices, primitive.vertices, "vertices", primitive.pointer);
        primitive.first_vertex = out.first_vertex;
        out.first_vertex += static_cast<std::uint32_t>(primitive.vertices);
        if (!places.empty()) add_primitive(out, primitive, about, places, morphs);
        ++about.primitive;
    }
}

std::vector<std::vector<Place>> places_of(const Growing& out, const SceneNodes& tree) {
    std::vector<std::vector<Place>> places(element_count(out.document.json, "meshes"));
    for (const std::size_t n : tree.traversal) {
        const std::string pointer = fmt::format("/nodes/{}", n);
        const json& node = out.document.json["nodes"][n];
        const auto mesh = find_whole(node, "mesh", pointer), skin = find_whole(node, "skin", pointer);
        if (!mesh) continue;
        Place place{out.node_numbers[n], std::nullopt};
        if (skin) place.skin = static_cast<std::uint32_t>(*skin);
        places[*mesh].push_back(place);
    }
    return places;
}

// Extensions that are read, or named where they are met.
bool is_known(const std::string& extension) {
    constexpr std::array known{std::string_view("KHR_mesh_quantization"), std::string_view("KHR_texture_transform"),
                               std::string_view("EXT_texture_webp"), std::string_view("KHR_texture_basisu"),
                               std::string_view("MIEN_rig")};
    return extension.rfind("KHR_materials_", 0) == 0 || std::find(known.begin(), known.end(), extension) != known.end();
}

void name_the_rest(const GltfDocument& document, std::vector<std::string>& left_out) {
    const json& root = document.json;
    for (std::size_t a = 1; a < element_count(root, "animations"); ++a)
        left_out.push_back(title(document, "animation", "animations", a) + ": the first is the one that plays");
    if (const std::size_t cameras = element_count(root, "cameras"); cameras > 0)
        left_out.push_back(fmt::format("cameras of the file: {}", cameras));
    for (const json& name : array_member(root, "extensionsUsed", ""))
        if (name.is_string() && !is_known(name.get<std::string>()))
            left_out.push_back(fmt::format("extension {}", shown(name.get<std::string>())));
}

}  // namespace

DocumentScene read_document_scene(const GltfDocument& document, Looks looks) {
    const ReadBudget budget = read_budget(document.binary.size());
    Growing out{document, looks, {}, budget, Pictures(document), {}, {}, {}, budget.vertices, 0};
    const SceneNodes tree = scene_nodes(document);
    out.scene.left_out = document.left_out;
    add_nodes(out, tree);
    add_skins(out);
    const std::vector<std::vector<Place>> places = places_of(out, tree);
    for (std::size_t m = 0; m < places.size(); ++m) add_mesh(out, m, places[m]);
    for (DocumentMaterial& material : out.materials) out.scene.materials.push_back(std::move(material.material));
    out.scene.pictures = std::move(out.pictures.read);
    out.scene.left_out.insert(out.scene.left_out.end(), out.pictures.left_out.begin(), out.pictures.left_out.end());
    return {std::move(out.scene), std::move(out.node_numbers), out.budget};
}

Scene parse_scene(std::span<const std::byte> bytes, const Fetch& fetch) {
    const GltfDocument document = load_plain_gltf(bytes, fetch);
    DocumentScene read = read_document_scene(document, Looks::read);
    if (element_count(document.json, "animations") > 0) read.scene.channels = read_channels(document, 0, read);
    name_the_rest(document, read.scene.left_out);
    return std::move(read.scene);
}

}  // namespace mien
