// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <optional>
#include <span>
#include <vector>

#include "render/gl_objects.hpp"
#include "render/model.hpp"
#include "render/optics.hpp"
#include "render/targets.hpp"

#include "mien/picture.hpp"
#include "mien/render/camera.hpp"
#include "mien/render/look.hpp"

namespace mien {

/// Draws posed models: everything of the device that no model owns.
class Painter {
public:
    Painter();
    Picture draw(std::span<const Instance* const> models, const Camera& camera, const Look& look);

private:
    struct Shot;
    void draw_draft(const Shot& shot);
    void draw_full(const Shot& shot);
    void draw_shadows(const Shot& shot, const ShadowView& shadow);
    void draw_everything(const Shot& shot, GlProgram& program, const Matrix& view);
    void draw_piece(GlProgram& program, const Instance& model, const Piece& piece, int alpha_mode);
    void draw_wire(const Shot& shot, const Matrix& view);
    void draw_marks(const Shot& shot, const Matrix& view);
    void cover(GlProgram& program);

    GlProgram draft_, full_, shadow_, wire_, mark_, background_, add_, develop_;
    GlName heat_, opposite_, nothing_;  ///< `nothing_`: a vertex array without attributes
    std::optional<Targets> targets_;
};

}  // namespace mien
