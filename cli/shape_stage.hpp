// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <span>
#include <vector>

#include "stage.hpp"

#include "mien/face.hpp"
#include "mien/render/renderer.hpp"

namespace mien::cli {

/// A head before a camera, moved by shapes. It is looked at from the front of the face however it lies in its file,
/// from so near that its feature points fill the picture.
class ShapeStage {
public:
    /// `rig`: says what is skin and what an eye; must be of the face's mesh.
    ShapeStage(const Face& face, const Rig& rig, const LookFlags& look, Size size);

    /// The head with these shapes.
    ModelId enter(std::span<const MorphTarget> shapes);
    /// It with the weights, one per shape. `error`: one number per vertex of the mesh that paints it where it reaches
    /// `low`; may be empty.
    Picture picture(ModelId model, std::span<const float> weights, std::span<const float> error = {}, float low = 0,
                    float high = 1);

private:
    Scene scene_;
    Look look_;
    Camera camera_;
    Affine place_;
    Renderer renderer_;
};

}  // namespace mien::cli
