// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mien/affine.hpp"
#include "mien/mesh.hpp"
#include "mien/picture.hpp"
#include "mien/vec.hpp"

namespace mien {

/// What a surface is made of: the metallic-roughness material of glTF 2.0, and how far light travels under it.
struct Material {
    enum class Alpha { opaque, mask, blend };

    std::string name;
    std::array<float, 4> colour{1, 1, 1, 1};  ///< linear red, green, blue and coverage, 0 to 1; times `colour_picture`
    float metallic = 0;                       ///< 0 to 1; times the blue channel of `roughness_picture`
    float roughness = 1;                      ///< 0 to 1; times the green channel of `roughness_picture`
    std::array<float, 3> emission{};          ///< linear, from 0; times `emission_picture`
    std::array<float, 3> scatter{};  ///< share of the diffuse light that travels under the surface, per channel, 0 to 1
    Alpha alpha = Alpha::opaque;
    float alpha_cutoff = 0.5F;  ///< for Alpha::mask: what covers less is not there
    bool double_sided = false;
    bool unlit = false;  ///< the colour is shown as it is (KHR_materials_unlit)
    /// Indices into Scene::pictures.
    std::optional<std::uint32_t> colour_picture, roughness_picture, normal_picture, emission_picture;
    float normal_scale = 1;
};

/// One primitive: triangles of one material, hung on a node.
///
/// Where a vertex is: its position, plus the morph targets times their weights, through the node's world map; or, with
/// a skin, through the weighted joints instead (glTF 2.0, 3.7.3.3).
struct Surface {
    std::string name;                      ///< of the mesh; may be empty
    std::uint32_t mesh = 0;                ///< number of the mesh in the file
    std::uint32_t primitive = 0;           ///< number of the primitive in that mesh
    std::uint32_t node = 0;                ///< index into Scene::nodes
    std::vector<Vec3f> positions;          ///< at rest, in the node's space; file order
    std::vector<Vec3f> normals;            ///< one per vertex, of length 1; empty: the file has none
    std::vector<Vec2f> uvs;                ///< one per vertex or empty
    std::vector<std::uint32_t> triangles;  ///< three vertices each, counter-clockwise seen from outside in the
                                           ///< node's space; a world map that mirrors turns them round
    std::uint32_t material = 0;            ///< index into Scene::materials
    std::vector<MorphTarget> morphs;       ///< deltas in the node's space
    std::uint32_t influences = 0;          ///< joints per vertex; 0: no skin
    std::vector<std::uint16_t> joints;     ///< vertices x influences: indices into the skin's joints
    std::vector<float> weights;            ///< vertices x influences: not negative, a vertex's add up to 1
    std::optional<std::uint32_t> skin;     ///< index into Scene::skins; set when `influences` is not 0
    /// One per vertex: its number among the vertices of the Mesh that is read from the same file, which the rows of a
    /// Rig count by.
    std::vector<std::uint32_t> mesh_vertices;
};

/// A place in the tree of the scene. Parents come before their children.
struct Node {
    std::string name;
    std::optional<std::uint32_t> parent;
    Vec3 translation;  ///< the local map is translation * rotation * scale, or `matrix` where the file gives one
    Quaternion rotation;
    Vec3 scale{1, 1, 1};
    std::optional<Affine> matrix;
    std::vector<float> morph_weights;  ///< at rest, one per morph target of the node's surfaces
};

struct SceneSkin {
    std::vector<std::uint32_t> joints;  ///< nodes
    std::vector<Affine> inverse_binds;  ///< one per joint: from the mesh's space at rest to the joint's
};

/// How one property of a node changes over time.
struct Channel {
    enum class Property { translation, rotation, scale, morph_weights };
    enum class Between { step, linear, cubic };

    std::uint32_t node = 0;
    Property property = Property::translation;
    Between between = Between::linear;
    std::vector<float> times;  ///< seconds, ascending
    /// One value per time (three per time for `cubic`: tangent in, value, tangent out); a value has 3 numbers, 4 for a
    /// rotation (x, y, z, w), one per morph target for weights.
    std::vector<float> values;
};

/// Everything that is drawn, at rest, and how it moves. All indices are in range, all numbers finite.
struct Scene {
    std::vector<Surface>
        surfaces;  ///< in file order: meshes, then primitives; a mesh shown again is one more, behind all
    std::vector<Material> materials;
    std::vector<Picture> pictures;
    std::vector<Node> nodes;
    std::vector<SceneSkin> skins;
    std::vector<Channel> channels;      ///< of the file's first animation
    std::vector<std::string> left_out;  ///< what the file has and the scene does not, a sentence each
};

/// A scene at one time.
struct ScenePose {
    std::vector<Affine> worlds;                     ///< one per node: from its space to the scene's
    std::vector<std::vector<float>> morph_weights;  ///< one list per node
};

/// The time of the last key, in seconds; 0 when nothing moves.
double duration(const Scene& scene);

/// The scene at `time` (seconds; before the first key and after the last one the nearest key holds).
ScenePose pose_at(const Scene& scene, double time);

/// The scene as its file shows it when nothing plays.
ScenePose rest_pose(const Scene& scene);

/// Where the surface's vertices are in the scene's space, into `positions` (one per vertex).
void surface_positions(const Scene& scene, const Surface& surface, const ScenePose& pose, std::span<Vec3f> positions);

/// The map of each of the skin's joints: from the mesh's space at rest to the scene's.
std::vector<Affine> joint_maps(const Scene& scene, const SceneSkin& skin, const ScenePose& pose);

}  // namespace mien
