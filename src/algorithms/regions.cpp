// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Kshirsagar et al., section 2.1.1: regions grown from every feature point at once, and which of them touch. Ties are
// settled by the order of the points, never by that of vertices or edges, so that reordering a mesh changes nothing.

#include "algorithms/regions.hpp"

#include <algorithm>
#include <queue>
#include <tuple>

namespace mien {

std::vector<std::uint32_t> regions_by_steps(const EdgeGraph& graph, std::span<const std::uint32_t> seeds) {
    std::vector<std::uint32_t> region(graph.starts.size() - 1, no_region);
    std::vector<bool> settled(region.size(), false);
    std::vector<std::uint32_t> front(seeds.begin(), seeds.end());
    for (std::uint32_t s = 0; s < seeds.size(); ++s) region[seeds[s]] = s;
    while (!front.empty()) {
        for (const std::uint32_t p : front) settled[p] = true;
        std::vector<std::uint32_t> next;
        for (const std::uint32_t p : front)
            for (std::uint32_t e = graph.starts[p]; e < graph.starts[p + 1]; ++e) {
                const std::uint32_t n = graph.neighbours[e];
                if (settled[n]) continue;
                if (region[n] == no_region) next.push_back(n);
                region[n] = std::min(region[n], region[p]);
            }
        front = std::move(next);
    }
    return region;
}

std::vector<std::uint32_t> regions_by_distance(const EdgeGraph& graph, std::span<const std::uint32_t> seeds) {
    using Reached = std::tuple<double, std::uint32_t, std::uint32_t>;  // distance, seed, place
    std::priority_queue<Reached, std::vector<Reached>, std::greater<>> front;
    std::vector<std::uint32_t> region(graph.starts.size() - 1, no_region);
    for (std::uint32_t s = 0; s < seeds.size(); ++s) front.emplace(0, s, seeds[s]);
    while (!front.empty()) {
        const auto [so_far, seed, p] = front.top();
        front.pop();
        if (region[p] != no_region) continue;
        region[p] = seed;
        for (std::uint32_t e = graph.starts[p]; e < graph.starts[p + 1]; ++e)
            if (region[graph.neighbours[e]] == no_region)
                front.emplace(so_far + graph.lengths[e], seed, graph.neighbours[e]);
    }
    return region;
}

std::vector<std::vector<std::uint32_t>> region_neighbours(const EdgeGraph& graph,
                                                          std::span<const std::uint32_t> regions, std::size_t seeds) {
    std::vector<std::vector<std::uint32_t>> neighbours(seeds);
    for (std::size_t p = 0; p < regions.size(); ++p)
        for (std::uint32_t e = graph.starts[p]; e < graph.starts[p + 1]; ++e) {
            const std::uint32_t other = regions[graph.neighbours[e]];
            if (regions[p] != other) neighbours[regions[p]].push_back(other);
        }
    for (auto& list : neighbours) {
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
    }
    return neighbours;
}

}  // namespace mien
