// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The meshes of a glTF 2.0 document (specification, 3.7) as one mesh in the space of the scene. Primitives may share
// accessors, so a short file can ask for many vertices; what it may ask for in all is bounded.

#include <array>
#include <fmt/format.h>
#include <map>
#include <string>

#include "io/gltf_codecs.hpp"
#include "io/gltf_document.hpp"
#include "io/gltf_json.hpp"
#include "io/gltf_primitive.hpp"
#include "io/gltf_rest_pose.hpp"

#include "mien/io/gltf.hpp"

namespace mien {

namespace {

using nlohmann::json;

// The mesh while it grows.
struct Growing {
    const GltfDocument& document;
    Mesh mesh;
    ReadBudget budget;
    bool any_uvs = false;
    std::map<std::string, std::size_t> morph_numbers;  // of a name in mesh.morph_targets
};

void add_positions(Growing& out, const Primitive& primitive) {
    const std::vector<Vec3f> positions = positions_of(primitive);
    out.mesh.positions.insert(out.mesh.positions.end(), positions.begin(), positions.end());
}

void add_faces(Growing& out, const Primitive& primitive) {
    const std::vector<std::uint32_t> corners = triangles_of(primitive, out.budget);
    if (corners.empty()) return;
    const std::vector<Vec2f> uvs = uvs_of(primitive, 0);
    out.any_uvs = out.any_uvs || !uvs.empty();
    for (std::size_t c = 0; c < corners.size(); c += 3) {
        std::array<std::uint32_t, 3> in_mesh{};
        for (std::size_t k = 0; k < 3; ++k) {
            in_mesh[k] = primitive.first_vertex + corners[c + k];
            out.mesh.corner_uvs.push_back(uvs.empty() ? Vec2f{} : uvs[corners[c + k]]);
        }
        add_face(out.mesh, in_mesh);
    }
}

MorphTarget& target_of(Growing& out, const std::string& name) {
    const auto [at, added] = out.morph_numbers.emplace(name, out.mesh.morph_targets.size());
    if (added) out.mesh.morph_targets.push_back({name, {}, {}});
    return out.mesh.morph_targets[at->second];
}

std::string part_name(const Growing& out, std::size_t mesh, const Standing& standing) {
    std::string own = text_member(out.document.json["meshes"][mesh], "name", fmt::format("/meshes/{}", mesh));
    if (!own.empty() || !standing.node) return own;
    return text_member(out.document.json["nodes"][*standing.node], "name", fmt::format("/nodes/{}", *standing.node));
}

void add_primitive(Growing& out, const Primitive& primitive, Part part, const std::vector<std::string>& names) {
    part.first_vertex = primitive.first_vertex;
    part.vertex_count = static_cast<std::uint32_t>(primitive.vertices);
    part.first_face = static_cast<std::uint32_t>(face_count(out.mesh));
    add_positions(out, primitive);
    add_faces(out, primitive);
    for (std::size_t t = 0; t < names.size(); ++t)
        add_morph(primitive, t, primitive.first_vertex, out.budget, target_of(out, names[t]));
    part.face_count = static_cast<std::uint32_t>(face_count(out.mesh)) - part.first_face;
    out.mesh.parts.push_back(std::move(part));
}

void add_mesh(Growing& out, std::size_t m, const Standing& standing) {
    const std::vector<std::string> names = target_names(out.document, m);
    std::uint32_t number = 0;
    for (Primitive& primitive : primitives_of(out.document, m)) {
        primitive.first_vertex = static_cast<std::uint32_t>(vertex_count(out.mesh));
        primitive.maps = vertex_maps(standing, primitive);
        add_primitive(out, primitive, {part_name(out, m, standing), static_cast<std::uint32_t>(m), number++}, names);
    }
}

// Before anything is read, so that what is too much is refused at once.
void spend_vertices(Growing& out) {
    std::size_t vertices = 0;
    for (std::size_t m = 0; m < element_count(out.document.json, "meshes"); ++m)
        for (const Primitive& primitive : primitives_of(out.document, m)) {
            spend(out.budget.vertices, primitive.vertices, "vertices", primitive.pointer);
            vertices += primitive.vertices;
        }
    out.mesh.positions.reserve(vertices);
}

}  // namespace

Mesh parse_gltf(std::span<const std::byte> bytes, const Fetch& fetch) {
    const GltfDocument document = load_plain_gltf(bytes, fetch);
    Growing out{document, {}, read_budget(document.binary.size()), false, {}};
    spend_vertices(out);
    const std::vector<Standing> stands = standings(document);
    for (std::size_t m = 0; m < stands.size(); ++m) add_mesh(out, m, stands[m]);
    if (!out.any_uvs) out.mesh.corner_uvs.clear();
    out.mesh.unit.assign(1, 'm');
    out.mesh.gltf = format_glb(document);
    out.mesh.left_out = document.left_out;
    return std::move(out.mesh);
}

}  // namespace mien
