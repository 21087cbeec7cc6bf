// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The pictures that colour a head. They are computed from places and noise, so that they need no photograph.

#pragma once

#include <vector>

#include "character.hpp"
#include "skin.hpp"

#include "mien/picture.hpp"

namespace mien::samples {

/// Colours the skin in its own texture layout. `hair_cover` as `hair_cover` gives it.
Picture paint_skin(const Character& character, const Skin& skin, const std::vector<double>& hair_cover);

/// The eye from the front: iris in the middle (radius `iris_in_picture`), white round it.
Picture paint_eye(const IrisLook& look);
inline constexpr double iris_in_picture = 0.25;

/// Strands along v.
Picture paint_hair(const HairLook& look);

}  // namespace mien::samples
