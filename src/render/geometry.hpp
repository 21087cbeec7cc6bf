// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mien/render/renderer.hpp"
#include "mien/scene.hpp"
#include "mien/vec.hpp"

namespace mien {

/// For every vertex a short row of what moves it: position += weight * amounts[index], axis by axis, where an amount is
/// the displacement of a feature point or the weight of a shape (three times the same; then `weight` is the shape's
/// delta). Rows of joints use the same list: there a weight is three times the same.
struct Rows {
    struct Entry {
        std::uint32_t index = 0;
        Vec3f weight;
        Vec3f along_t, along_b;  ///< how `weight` grows per unit of length along the vertex's two tangents
        friend bool operator==(const Entry&, const Entry&) = default;
    };
    std::vector<std::uint32_t> starts{0};  ///< vertices + 1 entries
    std::vector<Entry> entries;            ///< ascending index within a row
};

/// One surface in the flat lists of a Geometry.
struct Piece {
    std::uint32_t first_vertex = 0, vertex_count = 0;
    std::uint32_t first_index = 0, index_count = 0;
    std::uint32_t material = 0;
    bool wet = false;  ///< an eyeball: it shines under its tears
};

/// Everything of a model that goes to the device once.
struct Geometry {
    std::vector<Vec3f> positions, normals;  ///< normals of length 1
    std::vector<Vec3f> tangents;            ///< t: of length 1 and at right angles to the normal
    std::vector<float> hands;               ///< b = hand * cross(normal, t); -1 where the rest map mirrors
    std::vector<Vec2f> uvs;                 ///< zero where there are none
    std::vector<Vec3f> eyes;  ///< direction in the eyeball's own frame (z to the pupil), zero elsewhere; may be empty
    std::vector<std::uint32_t> triangles;
    std::vector<Piece> pieces;
    Rows moves, joints;
    std::size_t amount_count = 0, joint_count = 0;
    double millimetre = 0;  ///< in the model's unit; 0: not known
};

/// The number in the file's mesh of every vertex of the scene's surfaces, in order.
std::vector<std::uint32_t> mesh_vertices(const Scene& scene);

/// Where the tables of a scene without a Movement begin: joints are the nodes, then each skin's joints; amounts are
/// each node's morph targets.
struct SceneTables {
    std::vector<std::uint32_t> skin_joints;   ///< one per skin: its first joint
    std::vector<std::uint32_t> node_amounts;  ///< nodes + 1 entries
    std::uint32_t joints = 0;
};
SceneTables tables_of(const Scene& scene);

/// Flattens a scene that its own joints and morph targets move. Slopes and tangents are filled.
Geometry geometry_of(const Scene& scene);
/// Flattens a scene as it rests, moved by a rig and shapes: amounts are the rig's points, then the shapes; joint 0
/// stands still and each eyeball is a joint after it.
Geometry geometry_of(const Scene& scene, const Movement& movement);

}  // namespace mien
