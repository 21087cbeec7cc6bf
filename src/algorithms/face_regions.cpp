// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "algorithms/face_regions.hpp"

#include <span>

#include "algorithms/regions.hpp"

#include "mien/algorithms/partial.hpp"

namespace mien {

namespace {

// The region of each feature point.
std::vector<std::size_t> regions_of(std::span<const FeaturePoint> points) {
    Take names;
    for (const FeaturePoint& point : points) names.points.push_back(point.id);
    std::vector<std::size_t> regions(points.size(), rest_region);
    for (std::size_t r = 0; r < rest_region; ++r)
        for (const std::size_t c : part_columns(names, region_names[r])) regions[c] = r;
    return regions;
}

}  // namespace

std::vector<std::size_t> vertex_regions(const Face& face, const Weld& weld, const EdgeGraph& graph) {
    std::vector<std::uint32_t> seeds;
    for (const FeaturePoint& point : face.points) seeds.push_back(weld.place[point.vertex]);
    const std::vector<std::uint32_t> nearest = regions_by_distance(graph, seeds);
    const std::vector<std::size_t> of_point = regions_of(face.points);
    std::vector<std::size_t> regions;
    for (const std::uint32_t place : weld.place)
        regions.push_back(nearest[place] == no_region ? rest_region : of_point[nearest[place]]);
    return regions;
}

}  // namespace mien
