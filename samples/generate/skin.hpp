// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include "cage.hpp"
#include "character.hpp"
#include "limit_surface.hpp"

namespace mien::samples {

struct Skin {
    Cage cage;
    MirroredSurface mesh;
    std::vector<Vec3> neutral;  ///< where the neutral head has the vertices
};

/// The head's skin with the inner mouth: sampled, sculpted, given its character, lips closed to a slit, lids fitted
/// round the eyeball.
Skin make_skin(const Character& character);

}  // namespace mien::samples
