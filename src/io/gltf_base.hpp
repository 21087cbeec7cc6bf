// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "io/glb.hpp"

#include "mien/mesh.hpp"

namespace mien {

/// A primitive of a document and the vertex of the mesh behind each of its vertices, so that joints, weights and morph
/// targets can be written for it.
struct WrittenPrimitive {
    std::size_t mesh = 0;       ///< index into the document's meshes
    std::size_t primitive = 0;  ///< index into that mesh's primitives
    std::vector<std::uint32_t> vertices;
};

/// A document that shows a neutral head in scene space and does nothing yet.
struct BaseDocument {
    GltfDocument document;
    std::size_t scene = 0;                     ///< the scene that shows the head
    std::vector<std::size_t> mesh_nodes;       ///< roots of that scene without a transform, one per mesh of the head
    std::vector<WrittenPrimitive> primitives;  ///< ascending by mesh, then primitive
};

/// The document that a head is written into.
///
/// A head that came from glTF keeps its document: materials, textures, other attributes, cameras, lights, the tree of
/// nodes, extras. Its vertices move to scene space, so each of its meshes hangs on a new root node without a transform.
/// Gone are animations, skins, and the source's own morph targets with their weights and names: they would fight with
/// what is written; `Mesh::morph_targets` has the shapes. So are numbers that nothing refers to any more.
///
/// Any other head gets a fresh document: one plain material, polygons as fans of triangles, a vertex per texture
/// coordinate at seams, normals weighted by angle and smooth across vertices at one place.
BaseDocument base_document(const Mesh& mesh);

}  // namespace mien
