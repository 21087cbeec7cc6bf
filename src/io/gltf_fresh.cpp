// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// A glTF document for polygons. Vertex normals are those of Thuermer and Wuethrich, "Computing vertex normals from
// polygonal facets" (1998): normals of triangles summed by their angle at the vertex; vertices at one place share one,
// so seams of texture stay invisible.

#include "io/gltf_fresh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>

#include "io/gltf_builder.hpp"

#include "mien/error.hpp"

namespace mien {

namespace {

using nlohmann::json;
using Corners = std::vector<std::uint32_t>;  // indices into Mesh::face_vertices

// Corners of the triangles of face f: a fan from its first corner.
void append_fan(const Mesh& mesh, std::size_t f, Corners& corners) {
    const std::uint32_t first = mesh.face_starts[f], end = mesh.face_starts[f + 1];
    for (std::uint32_t c = first + 1; c + 1 < end; ++c) corners.insert(corners.end(), {first, c, c + 1});
}

struct Group {
    std::string name;
    Corners corners;  // three per triangle
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

// For each vertex the first vertex at its place.
std::vector<std::uint32_t> weld_places(std::span<const Vec3f> positions) {
    std::vector<std::uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto key = [&](std::uint32_t v) {
        return std::make_tuple(positions[v].x, positions[v].y, positions[v].z, v);
    };
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    std::vector<std::uint32_t> place(positions.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool same = i > 0 && positions[order[i]] == positions[order[i - 1]];
        place[order[i]] = same ? place[order[i - 1]] : order[i];
    }
    return place;
}

double angle_between(const Vec3& a, const Vec3& b) {
    return std::atan2(length(cross(a, b)), dot(a, b));
}

// One normal per vertex of the mesh; +z where there is no surface.
std::vector<Vec3f> vertex_normals(const Mesh& mesh, const std::map<std::uint32_t, Group>& groups) {
    const std::vector<std::uint32_t> place = weld_places(mesh.positions);
    std::vector<Vec3> sums(mesh.positions.size());
    for (const auto& [number, group] : groups)
        for (std::size_t t = 0; t < group.corners.size(); t += 3) {
            std::array<std::uint32_t, 3> v{};
            std::array<Vec3, 3> p;
            for (std::size_t k = 0; k < 3; ++k) {
                v[k] = mesh.face_vertices[group.corners[t + k]];
                p[k] = to_double(mesh.positions[v[k]]);
            }
            const Vec3 normal = cross(p[1] - p[0], p[2] - p[0]);
            const double size = length(normal);
            if (!(size > 0)) continue;
            for (std::size_t k = 0; k < 3; ++k) {
                const double angle = angle_between(p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]);
                sums[place[v[k]]] += (angle / size) * normal;
            }
        }
    std::vector<Vec3f> normals(mesh.positions.size(), Vec3f{0, 0, 1});
    for (std::size_t v = 0; v < normals.size(); ++v) {
        const double size = length(sums[place[v]]);
        if (size > 1e-9) normals[v] = to_float(sums[place[v]] / size);
    }
    return normals;
}

// The vertices of one primitive: one per pair of a mesh vertex and a texture coordinate, ascending by vertex.
struct SplitVertices {
    std::vector<std::uint32_t> vertices;  // mesh vertex behind each
    std::vector<Vec2f> uvs;               // empty, or one for each
    std::vector<std::uint32_t> indices;   // one per corner
};

SplitVertices split_at_seams(const Mesh& mesh, const Corners& corners) {
    const auto uv = [&](std::uint32_t corner) { return mesh.corner_uvs.empty() ? Vec2f{} : mesh.corner_uvs[corner]; };
    const auto key = [&](std::uint32_t corner) {
        const Vec2f at = uv(corner);
        return std::make_tuple(mesh.face_vertices[corner], at.x, at.y);
    };
    std::vector<std::uint32_t> order(corners.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return std::make_tuple(key(corners[a]), a) < std::make_tuple(key(corners[b]), b);
    });
    SplitVertices split;
    split.indices.resize(corners.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const std::uint32_t corner = corners[order[i]];
        if (i == 0 || key(corner) != key(corners[order[i - 1]])) {
            split.vertices.push_back(mesh.face_vertices[corner]);
            if (!mesh.corner_uvs.empty()) split.uvs.push_back(uv(corner));
        }
        split.indices[order[i]] = static_cast<std::uint32_t>(split.vertices.size() - 1);
    }
    return split;
}

std::vector<Vec3f> picked(std::span<const Vec3f> values, std::span<const std::uint32_t> vertices) {
    std::vector<Vec3f> result;
    result.reserve(vertices.size());
    for (const std::uint32_t v : vertices) result.push_back(values[v]);
    return result;
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
    const std::vector<Vec3f> normals = vertex_normals(mesh, groups);
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
