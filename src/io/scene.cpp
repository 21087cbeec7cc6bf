// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/io/scene.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "io/triangles.hpp"

#include "mien/error.hpp"

namespace mien {

namespace {

constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();

// Faces that one part holds, or that none does.
struct Run {
    const Part* part = nullptr;
    std::vector<std::uint32_t> corners;  // three per triangle
};

// A run per part, and one more for faces outside of all parts. A face in two parts belongs to the later one.
std::vector<Run> runs_of(const Mesh& mesh) {
    std::vector<std::size_t> owners(face_count(mesh), mesh.parts.size());
    std::vector<Run> runs;
    for (const Part& part : mesh.parts) {
        std::fill_n(owners.begin() + part.first_face, part.face_count, runs.size());
        runs.push_back({&part, {}});
    }
    runs.emplace_back();
    for (std::size_t f = 0; f < owners.size(); ++f) append_fan(mesh, f, runs[owners[f]].corners);
    return runs;
}

// A target on the vertices of a surface; `places`: for each vertex of the mesh its first one on the surface.
MorphTarget target_on(const Surface& surface, const MorphTarget& target, const std::vector<std::uint32_t>& places) {
    MorphTarget on{target.name, {}, {}};
    for (std::size_t i = 0; i < target.vertices.size(); ++i)
        for (std::size_t v = places[target.vertices[i]];
             v < surface.mesh_vertices.size() && surface.mesh_vertices[v] == target.vertices[i]; ++v) {
            on.vertices.push_back(static_cast<std::uint32_t>(v));
            on.deltas.push_back(target.deltas[i]);
        }
    return on;
}

std::vector<MorphTarget> targets_on(const Surface& surface, const Mesh& mesh) {
    std::vector<std::uint32_t> places(mesh.morph_targets.empty() ? 0 : vertex_count(mesh), nowhere);
    for (std::size_t v = 0; !places.empty() && v < surface.mesh_vertices.size(); ++v) {
        std::uint32_t& first = places[surface.mesh_vertices[v]];
        first = std::min(first, static_cast<std::uint32_t>(v));
    }
    std::vector<MorphTarget> targets;
    for (const MorphTarget& target : mesh.morph_targets) targets.push_back(target_on(surface, target, places));
    return targets;
}

Surface surface_of(const Mesh& mesh, const Run& run, const std::vector<Vec3f>& normals) {
    SplitVertices split = split_at_seams(mesh, run.corners);
    Surface surface;
    if (run.part != nullptr) {
        surface.name = run.part->name;
        surface.mesh = run.part->mesh;
        surface.primitive = run.part->primitive;
    }
    surface.positions = picked(mesh.positions, split.vertices);
    surface.normals = picked(normals, split.vertices);
    surface.uvs = std::move(split.uvs);
    surface.triangles = std::move(split.indices);
    surface.mesh_vertices = std::move(split.vertices);
    surface.morphs = targets_on(surface, mesh);
    return surface;
}

Material plain() {
    Material material;
    material.name = "plain";
    material.colour = {0.8F, 0.8F, 0.8F, 1};
    material.roughness = 0.7F;
    material.double_sided = true;
    return material;
}

}  // namespace

Scene scene_of(const Mesh& mesh) {
    if (!mesh.gltf.empty()) {
        const auto no_file = [](std::string_view) -> std::vector<std::byte> {
            throw Error("expected a document that holds everything, found one that names a file");
        };
        Scene scene = parse_scene(mesh.gltf, no_file);
        scene.left_out.insert(scene.left_out.begin(), mesh.left_out.begin(), mesh.left_out.end());
        return scene;
    }
    Scene scene;
    scene.left_out = mesh.left_out;
    scene.materials.push_back(plain());
    scene.nodes.resize(1);
    scene.nodes[0].name = "head";
    scene.nodes[0].morph_weights.resize(mesh.morph_targets.size());
    const std::vector<Vec3f> normals = vertex_normals(mesh);
    for (const Run& run : runs_of(mesh))
        if (!run.corners.empty()) scene.surfaces.push_back(surface_of(mesh, run, normals));
    return scene;
}

}  // namespace mien
