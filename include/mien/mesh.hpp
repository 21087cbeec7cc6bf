// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mien/vec.hpp"

namespace mien {

/// A run of vertices and faces that the file kept together: one primitive of a glTF mesh, one group of an OBJ.
/// Groups of an OBJ share one vertex list, so their vertex runs may overlap; glTF primitives never do.
struct Part {
    std::string name;                ///< the mesh's or group's name; may be empty
    std::uint32_t mesh = 0;          ///< number of the mesh in the file
    std::uint32_t primitive = 0;     ///< number of the primitive in that mesh
    std::uint32_t first_vertex = 0;  ///< the vertices first_vertex .. first_vertex + vertex_count - 1
    std::uint32_t vertex_count = 0;
    std::uint32_t first_face = 0;  ///< the faces first_face .. first_face + face_count - 1
    std::uint32_t face_count = 0;
};

/// A named shape of a mesh: what is added to the neutral positions at weight 1. Sparse: only vertices that move.
struct MorphTarget {
    std::string name;
    std::vector<std::uint32_t> vertices;  ///< ascending, each in range of the mesh's positions
    std::vector<Vec3f> deltas;            ///< one per entry of `vertices`, in the mesh's unit and space
};

/// The neutral head as it was read: every vertex of every mesh in the file, in file order (meshes, then primitives,
/// then vertices; not welded), in the space of the scene (node transforms applied), with polygon faces kept as
/// polygons.
///
/// After a reader returned it, every index is in range, every number is finite and every face has three corners or
/// more.
struct Mesh {
    std::vector<Vec3f> positions;               ///< in `unit`
    std::vector<std::uint32_t> face_starts{0};  ///< faces + 1 entries; face f has corners face_starts[f] .. [f+1]-1
    std::vector<std::uint32_t> face_vertices;   ///< one vertex index per corner
    std::vector<Vec2f> corner_uvs;              ///< empty, or one texture coordinate per corner
    std::vector<Part> parts;                    ///< in file order; empty for formats without parts
    std::vector<MorphTarget> morph_targets;     ///< the file's own shapes, by name
    std::string unit;                           ///< the unit the file states ("m" for glTF); empty when it states none
    /// The glTF document the mesh came from, as one self-contained, uncompressed GLB, so that materials, textures,
    /// attributes and other nodes survive on the way out. Empty for every other format.
    std::vector<std::byte> gltf;
};

inline std::size_t vertex_count(const Mesh& mesh) {
    return mesh.positions.size();
}
inline std::size_t face_count(const Mesh& mesh) {
    return mesh.face_starts.size() - 1;
}

/// The corners of face `f`: vertex indices in winding order.
inline std::span<const std::uint32_t> face(const Mesh& mesh, std::size_t f) {
    return std::span(mesh.face_vertices).subspan(mesh.face_starts[f], mesh.face_starts[f + 1] - mesh.face_starts[f]);
}

/// Adds a face with these corners. The caller keeps `corner_uvs` and `parts` in step.
void add_face(Mesh& mesh, std::span<const std::uint32_t> corners);

/// The box round all positions. Both corners are zero where there are none.
struct Box {
    Vec3 low, high;
};
Box bounding_box(const Mesh& mesh);
Box bounding_box(std::span<const Vec3> points);
double diagonal(const Box& box);

}  // namespace mien
