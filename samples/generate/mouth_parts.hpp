// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include "surface.hpp"

namespace mien::samples {

/// Points round a section of a row of teeth: 0 gum outside, 1 gum line, 2 crown, 3 edge, then back up the inside.
inline constexpr std::uint32_t teeth_section = 8;

/// A horseshoe of fourteen teeth with its gum. The first `teeth_section` vertices are the section at the midline.
Surface make_upper_teeth();
Surface make_lower_teeth();

struct Tongue {
    Surface surface;
    std::uint32_t tip = 0, middle = 0, left_border = 0, right_border = 0;
};
Tongue make_tongue();

}  // namespace mien::samples
