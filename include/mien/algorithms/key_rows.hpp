// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "mien/vec.hpp"

namespace mien {

/// The rows of a motion that show most of it: the first, then again and again the row farthest from all chosen ones
/// (farthest-point sampling; T. Gonzalez, "Clustering to minimize the maximum intercluster distance", 1985).
///
/// - `positions`: rows x points, row after row, any unit. The distance of two rows is the root mean square distance of
///   their points; points that are not finite in one of them count as not moved.
/// - Returns at most `count` rows, ascending; fewer when the rest are copies of those.
/// Throws Error if the positions do not fill whole rows.
std::vector<std::size_t> key_rows(std::span<const Vec3f> positions, std::size_t points, std::size_t count);

}  // namespace mien
