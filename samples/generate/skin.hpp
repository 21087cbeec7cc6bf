// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include "cage.hpp"
#include "limit_surface.hpp"

namespace mien::samples {

struct Skin {
    Cage cage;
    MirroredSurface mesh;
};

/// The head's skin with the inner mouth: sampled, lips closed to a slit, lids fitted round the eyeball, coloured.
Skin make_skin();

}  // namespace mien::samples
