// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "mien/colour.hpp"
#include "mien/mesh.hpp"
#include "mien/picture.hpp"
#include "mien/render/camera.hpp"
#include "mien/render/look.hpp"
#include "mien/rig.hpp"
#include "mien/scene.hpp"

namespace mien {

struct RendererOptions {
    bool software = false;  ///< use the processor even where there is a graphics card
};

/// What moves a model instead of its scene's joints and morph targets: feature points, shapes, or both at once.
/// Everything is in the scene's space at rest; the scene's own animation does not play. Rows of the rig and vertices of
/// the shapes are those of the mesh in the same file (`Surface::mesh_vertices`; where a surface has none, its vertices
/// count on from those of the surface before).
struct Movement {
    const Rig* rig = nullptr;  ///< weights of any sign, any number per vertex; its prior's shapes; eyeballs turn
    std::span<const MorphTarget> shapes;  ///< moved by weights
};

/// Names a model in the renderer that made it.
using ModelId = std::uint32_t;

/// The numbers that paint a model, and what they mean.
struct Paint {
    std::span<const float> values;  ///< one per vertex of the scene's surfaces; NaN keeps the material; empty: no paint
    float low = 0, high = 1;        ///< the values at the ends of the scale
    ColourScale scale = ColourScale::heat;
};

/// Draws heads without a window: skinned, morphed or moved by feature points on the graphics processor (or, where there
/// is none, by its stand-in on the processor), lit like a portrait.
///
/// A model is uploaded once. Per frame go over only the joints, weights or displacements; one pass on the device moves
/// every vertex and its normal, and shadows and colours are drawn from the result. Positions are those of `deform` and
/// of glTF 2.0 to single precision. Normals are exact for linear motion: with every influence go the slopes of its
/// weight along two tangents, so that the tangents move as the surface does (after Tarini et al., Accurate and
/// Efficient Lighting for Skinned Models, 2014; there for joints only).
///
/// The same driver draws the same bytes. One thread at a time may use a renderer.
class Renderer {
public:
    /// Throws Error if there is no driver for OpenGL ES 3.0 that can draw without a window.
    explicit Renderer(const RendererOptions& options = {});
    ~Renderer();
    Renderer(Renderer&&) noexcept;
    Renderer& operator=(Renderer&&) noexcept;

    /// What draws, as the driver calls itself.
    [[nodiscard]] std::string device() const;

    /// Uploads a scene that its joints and morph targets move. It is at rest until posed.
    /// Throws Error if the scene has no triangle or is larger than the driver can take.
    ModelId upload(const Scene& scene);
    /// Uploads a scene that feature points or shapes move. A rig also says what is skin and what an eye: see `dress`.
    /// Throws Error, also if the rig has no row for a vertex.
    ModelId upload(const Scene& scene, const Movement& movement);
    /// Another of the same, with a pose, a place and paint of its own; the uploaded data are shared.
    ModelId copy(ModelId model);
    void remove(ModelId model);

    /// The whole model through an affine map: a head's motion, a place in a row of heads.
    void place(ModelId model, const Affine& map);
    /// For models without a Movement. Throws Error if the pose is not of the model's scene.
    void pose(ModelId model, const ScenePose& pose);
    /// For models with a Movement: a displacement per point of the rig and a weight per shape; empty: all at rest.
    /// Throws Error if the numbers differ.
    void pose(ModelId model, std::span<const Vec3f> displacements, std::span<const float> weights = {});
    /// Throws Error if the number of values is not that of the vertices.
    void paint(ModelId model, const Paint& paint);

    /// Draws models. Throws Error if there are none, or if the camera or the look is out of range.
    Picture draw(std::span<const ModelId> models, const Camera& camera, const Look& look = {});

    [[nodiscard]] std::size_t vertex_count(ModelId model) const;
    /// The box round the model at rest, in its place.
    [[nodiscard]] Box rest_box(ModelId model) const;
    /// Positions and normals of the pose, before `place`: one per vertex of the scene's surfaces, in order, filled.
    void read_positions(ModelId model, std::span<Vec3f> positions) const;
    void read_normals(ModelId model, std::span<Vec3f> normals) const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace mien
