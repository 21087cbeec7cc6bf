// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "render/geometry.hpp"
#include "render/gl_objects.hpp"

namespace mien {

/// What a model and its copies share on the device.
struct StillModel {
    std::size_t vertices = 0;
    std::vector<Piece> pieces;
    std::vector<Material> materials;
    GlName still, indices, edges, uvs, eyes;  ///< buffers; `eyes` only where an eye is painted
    GLsizei edge_count = 0;
    GlName move_array;
    GlList plain, full, bones;
    std::vector<GlName> pictures;  ///< one per picture of the scene and use of it
    /// For each material, which of `pictures`: colour, roughness, normal, emission.
    std::vector<std::array<std::optional<std::uint32_t>, 4>> pictures_of;
    std::size_t amount_count = 0, joint_count = 0;
    double millimetre = 0;
    // How it is posed: by the scene it came from, or by a rig and shapes.
    Scene scene;  ///< nodes and skins alone; without nodes when a Movement moves it
    SceneTables tables;
    Rig rig;  ///< points, eyeballs and prior (its shapes without vertices) alone
    std::size_t shapes = 0;
};

/// One model to draw.
struct Instance {
    std::shared_ptr<const StillModel> still;
    GlName posed;  ///< buffer: position and normal of every vertex
    GlName array;
    GlName values;  ///< buffer, when painted
    bool painted = false;
    float low = 0, high = 1;
    ColourScale scale = ColourScale::heat;
    Affine place;
    Box rest;                   ///< before `place`
    std::vector<Vec3> centres;  ///< of each piece at rest, before `place`
};

/// What vertices are moved by in one frame.
struct Amounts {
    std::vector<Texel> amounts;  ///< one per point and shape
    std::vector<Texel> maps;     ///< three rows per joint
};
Amounts amounts_of(const StillModel& still, const ScenePose& pose);
Amounts amounts_of(const StillModel& still, std::span<const Vec3f> displacements, std::span<const float> weights);

/// The pass that moves vertices.
class Mover {
public:
    Mover();
    void run(const Instance& instance, Amounts amounts);

private:
    GlProgram program_;
    GlList amounts_, maps_;
    GlName nowhere_, pixel_;  ///< a framebuffer: without a window nothing can be drawn without one
};

StillModel make_still(const Scene& scene, const Geometry& geometry);
Instance make_instance(std::shared_ptr<const StillModel> still);
void set_values(Instance& instance, std::span<const float> values);

/// `first` 0: positions, 1: normals.
void read_posed(const Instance& instance, std::size_t which, std::span<Vec3f> out);

}  // namespace mien
