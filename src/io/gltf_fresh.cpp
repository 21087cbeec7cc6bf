// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// A glTF document for polygons.

#include "io/gltf_fresh.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "io/gltf_builder.hpp"
#include "io/triangles.hpp"

#include "mien/error.hpp"

namespace mien {

namespace {

using nlohmann::json;

struct Group {
    std::string name;
    std::vector<std::uint32_t> corners;  // three per triangle
};

// Triangles by the mesh they belong to. Faces that no part names belong to mesh 0.
std::map<std::uint32_t, Group> group_triangles(const Mesh& mesh) {
    std::vector<const Part*> owners(face_count(mesh), nullptr);
    for (const Part& part : mesh.parts) std::fill_n(owners.begin() + part.first_face, part.face_count, &part);
    std::map<std::uint32_t, Group> groups;
    for (std::size_t f = 0; f < owners.size(); ++f) {
        Group& group = groups[owners[f] ? owners[f]->mesh : 0];
        if (owners[f] && group.name.empty()) group.name = owners[f]->name;
        append_fan(mesh, f, group.corners);
    }
    return groups;
}

json written_primitive(GltfDocument& document, const Mesh& mesh, const SplitVertices& split,
                       std::span<const Vec3f> normals) {
    json attributes;
    attributes["POSITION"] =
        append_vectors(document, picked(mesh.positions, split.vertices), BufferTarget::vertices, Bounds::given);
    attributes["NORMAL"] = append_vectors(document, picked(normals, split.vertices), BufferTarget::vertices);
    if (!split.uvs.empty()) {
        std::vector<float> numbers;
        for (const Vec2f& uv : split.uvs) numbers.insert(numbers.end(), {uv.x, uv.y});
        attributes["TEXCOORD_0"] = append_floats(document, numbers, Elements::vec2, BufferTarget::vertices);
    }
    const std::size_t indices = append_indices(document, split.indices);
    return {{"attributes", std::move(attributes)}, {"indices", indices}, {"material", 0}, {"mode", 4}};
}

// Lists of one element are pushed: braces round one value are an array to one compiler and a copy to another.
json plain_document() {
    const json surface = {{"baseColorFactor", {0.8, 0.8, 0.8, 1.0}}, {"metallicFactor", 0.0}, {"roughnessFactor", 0.7}};
    json document;
    document["asset"]["version"] = "2.0";
    document["scene"] = 0;
    document["scenes"].push_back({{"nodes", json::array()}});
    document["materials"].push_back({{"name", "plain"}, {"doubleSided", true}, {"pbrMetallicRoughness", surface}});
    return document;
}

}  // namespace

BaseDocument fresh_document(const Mesh& mesh) {
    if (face_count(mesh) == 0) throw Error("glb: expected a mesh with faces, found one without");
    BaseDocument base;
    base.document.json = plain_document();
    const std::map<std::uint32_t, Group> groups = group_triangles(mesh);
    const std::vector<Vec3f> normals = vertex_normals(mesh);
    for (const auto& [number, group] : groups) {
        SplitVertices split = split_at_seams(mesh, group.corners);
        json primitive = written_primitive(base.document, mesh, split, normals);
        const std::string name = group.name.empty() ? "head" : group.name;
        json shape;
        shape["name"] = name;
        shape["primitives"].push_back(std::move(primitive));
        const std::size_t written = append_object(base.document, "meshes", std::move(shape));
        base.mesh_nodes.push_back(append_object(base.document, "nodes", {{"name", name}, {"mesh", written}}));
        base.document.json["scenes"][0]["nodes"].push_back(base.mesh_nodes.back());
        base.primitives.push_back({written, 0, std::move(split.vertices)});
    }
    return base;
}

}  // namespace mien
