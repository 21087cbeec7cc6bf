// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <span>
#include <vector>

#include "mien/face.hpp"

namespace mien {

/// Shapes of one head on the vertices of another, of any topology, through the feature points that both have and the
/// surfaces between them. What lies on the same side of lips and lids stays there: places are matched by where they
/// are, after the source was warped onto the target, and by how much each point moves them along the surface.
///
/// Skin only: eyeballs, teeth, lashes and hair get nothing, and neither does skin that the source does not have.
/// `shapes`: on the vertices of `source`. The result has the same names in the same order, in the target's unit.
/// Source: docs/methods.md, "From the shapes of another head".
///
/// Throws Error if fewer than four feature points are shared, or where `rig_biharmonic` does for either head.
std::vector<MorphTarget> carry_shapes(const Face& source, std::span<const MorphTarget> shapes, const Face& target);

}  // namespace mien
