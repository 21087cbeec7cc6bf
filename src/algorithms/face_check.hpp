// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include "mien/algorithms/weld.hpp"
#include "mien/face.hpp"

namespace mien {

/// What every rigger asks of a face. Throws Error if the mesh has no faces, a position that is not finite or no extent
/// in two directions, if there is no feature point or more than 65,535, if a point's vertex is out of range, or if two
/// points share an id or a place.
void check_face(const Face& face, const Weld& weld);

}  // namespace mien
