// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Surface distance as Kshirsagar et al., section 2 define it: "the sum of the edge lengths encountered while traversing
// from one point to the other", taken over the shortest such path (Dijkstra). The paper's traversal is by edge steps
// and does not say which path it means; the shortest is the only one that does not depend on the order of edges.

#include "mien/algorithms/surface_distance.hpp"

#include <algorithm>
#include <queue>
#include <utility>

namespace mien {

namespace {

// Calls visit(a, b) for both directions of every polygon side between two places.
template <class Visit>
void for_each_side(const Mesh& mesh, const Weld& weld, Visit visit) {
    for (std::size_t f = 0; f < face_count(mesh); ++f) {
        const auto corners = face(mesh, f);
        std::uint32_t a = weld.place[corners.back()];
        for (const std::uint32_t v : corners) {
            const std::uint32_t b = weld.place[v];
            if (a != b) {
                visit(a, b);
                visit(b, a);
            }
            a = b;
        }
    }
}

// Where each place's entries start when place p has `counts[p]` of them.
std::vector<std::uint32_t> starts_of(const std::vector<std::uint32_t>& counts) {
    std::vector<std::uint32_t> starts(counts.size() + 1, 0);
    for (std::size_t p = 0; p < counts.size(); ++p) starts[p + 1] = starts[p] + counts[p];
    return starts;
}

}  // namespace

EdgeGraph edge_graph(const Mesh& mesh, const Weld& weld) {
    const std::size_t places = weld.vertex.size();
    std::vector<std::uint32_t> counts(places, 0);
    for_each_side(mesh, weld, [&](std::uint32_t a, std::uint32_t) { ++counts[a]; });
    const std::vector<std::uint32_t> all_starts = starts_of(counts);
    std::vector<std::uint32_t> all(all_starts.back());
    std::vector<std::uint32_t> next(all_starts.begin(), all_starts.end() - 1);
    for_each_side(mesh, weld, [&](std::uint32_t a, std::uint32_t b) { all[next[a]++] = b; });

    EdgeGraph graph;
    graph.starts.reserve(places + 1);
    graph.starts.push_back(0);
    for (std::size_t p = 0; p < places; ++p) {
        const auto first = all.begin() + all_starts[p];
        std::sort(first, all.begin() + all_starts[p + 1]);
        const auto last = std::unique(first, all.begin() + all_starts[p + 1]);
        const Vec3 at = to_double(mesh.positions[weld.vertex[p]]);
        for (auto n = first; n != last; ++n) {
            graph.neighbours.push_back(*n);
            graph.lengths.push_back(distance(at, to_double(mesh.positions[weld.vertex[*n]])));
        }
        graph.starts.push_back(static_cast<std::uint32_t>(graph.neighbours.size()));
    }
    return graph;
}

std::vector<double> surface_distances(const EdgeGraph& graph, std::uint32_t source, double limit) {
    std::vector<double> distances(graph.starts.size() - 1, std::numeric_limits<double>::infinity());
    using Reached = std::pair<double, std::uint32_t>;
    std::priority_queue<Reached, std::vector<Reached>, std::greater<>> front;
    distances[source] = 0;
    front.emplace(0, source);
    while (!front.empty()) {
        const auto [so_far, p] = front.top();
        front.pop();
        if (so_far > distances[p]) continue;
        for (std::uint32_t e = graph.starts[p]; e < graph.starts[p + 1]; ++e) {
            const double there = so_far + graph.lengths[e];
            if (there > limit || there >= distances[graph.neighbours[e]]) continue;
            distances[graph.neighbours[e]] = there;
            front.emplace(there, graph.neighbours[e]);
        }
    }
    return distances;
}

}  // namespace mien
