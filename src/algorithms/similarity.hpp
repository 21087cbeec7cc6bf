// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include "mien/retarget.hpp"

namespace mien {

/// x -> ratio * rotate(rotation, x - from) + to.
struct Similarity {
    Vec3 from, to;
    double ratio = 1;
    Quaternion rotation;
};

Vec3 apply(const Similarity& map, const Vec3& p);

/// The best similarity from the source's neutral to the target's: centre to centre, size by the root mean square
/// distance to the centre, turned in the least-squares sense; for a planar source all in the picture's plane.
Similarity best_similarity(const Retarget& map);

/// Root mean square distance of the source's neutral points to their centre; 0 for a single point.
double source_radius(const Retarget& map);

}  // namespace mien
