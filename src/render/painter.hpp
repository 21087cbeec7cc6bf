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
    struct Part;
    static void sort_parts(Shot& shot);
    void draw_draft(const Shot& shot);
    void draw_full(const Shot& shot);
    void draw_shadows(const Shot& shot, const ShadowView& shadow);
    void draw_facts(const Shot& shot, const Matrix& view);
    void draw_pass(const Shot& shot, const Pass& pass, const Matrix& view, std::size_t passes, float grain);
    void draw_parts(const Shot& shot, std::span<const Part> parts, GlProgram& program, const Matrix& view);
    void draw_clear(const Shot& shot, GlProgram& program, const Matrix& view);
    void draw_wire(const Shot& shot, const Matrix& view);
    void draw_marks(const Shot& shot, const Matrix& view);
    void take_up(const Shot& shot, const Instance& model, GlProgram& program);
    void cover(GlProgram& program);

    GlProgram one_colour_, quick_, draft_, facts_, deferred_, full_, shadow_, wire_, mark_, background_, add_, develop_;
    GlName heat_, opposite_, nothing_;  ///< `nothing_`: a vertex array without attributes
    std::optional<Targets> targets_;
};

}  // namespace mien
