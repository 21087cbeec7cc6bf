// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mien/algorithms/surface_distance.hpp"

namespace mien {

/// Marks a place that no seed reaches.
inline constexpr std::uint32_t no_region = ~0U;

/// The seed (index into `seeds`) that reaches each place first when all advance one edge at a time: the *feature point
/// regions* of Kshirsagar et al., section 2.1.1, as written. A place reached by several in one step goes to the lowest.
std::vector<std::uint32_t> regions_by_steps(const EdgeGraph& graph, std::span<const std::uint32_t> seeds);

/// The same by surface distance, which does not depend on how dense the mesh is.
std::vector<std::uint32_t> regions_by_distance(const EdgeGraph& graph, std::span<const std::uint32_t> seeds);

/// For every seed the seeds whose regions share a boundary with its own (an edge between them), ascending.
std::vector<std::vector<std::uint32_t>> region_neighbours(const EdgeGraph& graph,
                                                          std::span<const std::uint32_t> regions, std::size_t seeds);

}  // namespace mien
