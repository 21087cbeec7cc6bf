// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include "mien/retarget.hpp"

namespace mien {

/// Fit the network of eq. 1 to the neutral points that `map` holds: as written (eq. 3), or with an affine term.
/// Throw Error if the residual at the points exceeds 1e-6 of the target's diagonal.
void fit_as_written(Retarget& map);
void fit_with_affine(Retarget& map);

}  // namespace mien
