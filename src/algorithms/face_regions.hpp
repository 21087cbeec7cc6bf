// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "mien/algorithms/surface_distance.hpp"
#include "mien/algorithms/weld.hpp"
#include "mien/face.hpp"

namespace mien {

/// The regions that reports tell apart: those of partial.hpp, and all else.
inline constexpr std::array<std::string_view, 8> region_names{"mouth", "jaw",  "brows",  "lids",
                                                              "eyes",  "nose", "cheeks", "rest"};
inline constexpr std::size_t eyes_region = 4, rest_region = 7;

/// The region of every vertex, an index into `region_names`: that of the feature point that is nearest along the
/// surface.
std::vector<std::size_t> vertex_regions(const Face& face, const Weld& weld, const EdgeGraph& graph);

}  // namespace mien
