// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <string>
#include <vector>

#include "mien/face.hpp"
#include "mien/take.hpp"

namespace mien {

/// Adds to a take the feature points of the face that it lacks, moved as the skin between the driven points would carry
/// them: a capture of 38 markers then drives a rig of 83 points without the other 45 holding the skin fast.
///
/// The driven points alone are bound with `rig_biharmonic`; its field, read at the missing points, is what a rig of all
/// points needs to give the same deformation as a rig of the driven ones. Points on teeth and tongue follow the jaw,
/// points on eyeballs keep still.
///
/// `take`: retargeted to this face. The columns it has stay as they are, but along axes on which their point does not
/// move: there the skin carries it, too. The new ones follow, in the face's order.
/// Throws Error if the take drives no point of the face.
Take complete(const Face& face, const Take& take);

/// Ids of the face's points that the take has no column for.
std::vector<std::string> missing_points(const Face& face, const Take& take);

}  // namespace mien
