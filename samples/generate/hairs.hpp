// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Brows and lashes as single hairs: flat ribbons that end in a point.

#pragma once

#include "character.hpp"
#include "skin.hpp"

namespace mien::samples {

Surface make_brows(const Character& character, const Skin& skin);
Surface make_lashes(const Character& character, const Skin& skin);

/// Linear colour of an sRGB tint.
Colour linear(const Tint& tint);

}  // namespace mien::samples
