// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "mien/face.hpp"

namespace mien {

/// What a points file gave, and what was noticed about it.
struct PointsFile {
    std::vector<FeaturePoint> points;
    std::vector<std::string> warnings;  ///< unknown MPEG-4 ids, far snaps
};

/// Feature points of `mesh` from JSON: a map id -> value at top level or under "points"; keys that start with `_` are
/// ignored. A value is a vertex index, a position [x, y, z] that is snapped to the nearest surface vertex, or an object
/// with `vertex` and `mesh` (name or number) or `position`, and optional `moves` ("xz"). With `mesh` the index counts
/// in that mesh, through its primitives; without, over all vertices of the file in file order. Ids that MPEG-4 does not
/// know are kept with a warning; so are positions that lie more than 5 % of the box diagonal away from the surface.
/// Throws Error naming the JSON pointer: no points, an index past the end, a key given twice, two points on one place.
PointsFile parse_points(std::span<const std::byte> bytes, const Mesh& mesh);

/// The same file back: vertex indices, and `moves` where constrained.
std::string format_points(std::span<const FeaturePoint> points);

}  // namespace mien
