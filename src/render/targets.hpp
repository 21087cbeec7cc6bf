// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <array>
#include <cstdint>

#include "render/gl_objects.hpp"

#include "mien/picture.hpp"

namespace mien {

/// What pictures of one size are drawn into.
class Targets {
public:
    static constexpr int shadow_size = 1024;

    /// Throws Error if the driver cannot make them.
    Targets(std::uint32_t width, std::uint32_t height);

    [[nodiscard]] bool fits(std::uint32_t width, std::uint32_t height) const {
        return width_ == static_cast<GLsizei>(width) && height_ == static_cast<GLsizei>(height);
    }

    /// Four samples a pixel, cleared.
    void begin_draft();
    /// The samples joined, ready to be read.
    void end_draft();

    /// For a sum of passes, in this order: an empty sum; for each shift of the picture the facts of its surfaces; for
    /// each pass its shadow, its picture, its share of the sum; at last the place for the developed picture. Throws
    /// Error if the driver cannot draw into numbers beyond 0 to 1.
    void begin_sum();
    void begin_facts();
    void begin_shadow();
    void begin_pass();
    void begin_adding();
    void begin_developing();

    /// Rgb, normal, scatter, depth.
    [[nodiscard]] GLuint fact(std::size_t which) const { return facts_pictures_[which].name(); }
    [[nodiscard]] GLuint pass_picture() const { return pass_picture_.name(); }
    [[nodiscard]] GLuint sum_picture() const { return sum_picture_.name(); }
    [[nodiscard]] GLuint shadow_map() const { return shadow_map_.name(); }

    /// What is drawn, from the upper row on.
    [[nodiscard]] Picture read() const;

private:
    void make_full();

    GLsizei width_, height_;
    GlName draft_, draft_colour_, draft_depth_, done_, done_colour_;
    GlName shadow_, shadow_map_, facts_, pass_, pass_picture_, depth_, sum_, sum_picture_;
    std::array<GlName, 4> facts_pictures_;
};

}  // namespace mien
