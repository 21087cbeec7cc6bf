// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include "render/geometry.hpp"

namespace mien {

/// Fills the normals that are missing, the tangents, and the slopes of every weight along them.
///
/// A gradient is the least-squares fit over the edges round a vertex; vertices that lie in one place and move alike are
/// one, so that texture seams do not show. Rows grow by what moves a neighbour alone: its weight is zero here, but not
/// its slope.
void add_slopes(Geometry& geometry);

}  // namespace mien
