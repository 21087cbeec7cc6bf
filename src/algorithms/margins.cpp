// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "algorithms/margins.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>

namespace mien {

namespace {

using Ids = std::array<std::string_view, 5>;  // from corner to corner; the middle one names the edge

struct Candidate {
    Margin::Kind kind;
    Ids upper, lower;
};
constexpr std::array<Candidate, 3> candidates{
    {{Margin::Kind::left_lids, {"3.11", "", "3.1", "", "3.7"}, {"3.11", "", "3.3", "", "3.7"}},
     {Margin::Kind::right_lids, {"3.8", "", "3.2", "", "3.12"}, {"3.8", "", "3.4", "", "3.12"}},
     {Margin::Kind::lips, {"2.4", "2.6", "2.2", "2.7", "2.5"}, {"2.4", "2.8", "2.3", "2.9", "2.5"}}}};

// Appends the shortest path from the last place of `path` to `to`.
bool extend(const EdgeGraph& graph, std::uint32_t to, std::vector<std::uint32_t>& path) {
    const std::vector<double> left = surface_distances(graph, to);
    if (!std::isfinite(left[path.back()])) return false;
    while (path.back() != to) {
        const std::uint32_t p = path.back();
        std::uint32_t next = to;
        double least = std::numeric_limits<double>::infinity();
        for (std::uint32_t e = graph.starts[p]; e < graph.starts[p + 1]; ++e) {
            const double whole = graph.lengths[e] + left[graph.neighbours[e]];
            if (left[graph.neighbours[e]] >= left[p] || whole >= least) continue;
            least = whole;
            next = graph.neighbours[e];
        }
        path.push_back(next);
    }
    return true;
}

std::vector<std::uint32_t> edge_through(const Face& face, const Weld& weld, const EdgeGraph& graph, const Ids& ids) {
    std::vector<std::uint32_t> path;
    for (std::size_t i = 0; i < ids.size(); ++i) {
        const std::optional<std::size_t> point = find_point(face.points, ids[i]);
        if (!point && i % 2 == 0) return {};
        if (!point) continue;
        const std::uint32_t place = weld.place[face.points[*point].vertex];
        if (path.empty())
            path.push_back(place);
        else if (!extend(graph, place, path))
            return {};
    }
    return path;
}

bool is_slit(const Margin& margin) {
    if (margin.upper.size() < 3 || margin.lower.size() < 3) return false;
    const auto shared = std::count_if(margin.upper.begin(), margin.upper.end(), [&](std::uint32_t p) {
        return std::find(margin.lower.begin(), margin.lower.end(), p) != margin.lower.end();
    });
    return 2 * (shared - 2) < std::ssize(margin.upper) - 2;
}

Vec3 of(const Face& face, const Weld& weld, std::uint32_t place) {
    return to_double(face.mesh.positions[weld.vertex[place]]);
}

// Lids open from one point to the other; lips may touch, so they open across the mouth, in the plane of the chin.
Vec3 opening_direction(const Face& face, const Margin& margin) {
    const Vec3 upper = face.points[margin.points[0]].position, lower = face.points[margin.points[1]].position;
    if (margin.kind != Margin::Kind::lips) return upper - lower;
    const auto eyes = find_point(face.points, "3.11"), other = find_point(face.points, "3.8");
    if (!eyes || !other) return upper - lower;
    return 0.5 * (face.points[*eyes].position + face.points[*other].position) - lower;
}

}  // namespace

std::vector<Margin> find_margins(const Face& face, const Weld& weld, const EdgeGraph& graph) {
    std::vector<Margin> margins;
    for (const Candidate& candidate : candidates) {
        Margin margin{candidate.kind,
                      {},
                      {},
                      edge_through(face, weld, graph, candidate.upper),
                      edge_through(face, weld, graph, candidate.lower)};
        if (!is_slit(margin)) continue;
        for (const std::string_view id : {candidate.upper[2], candidate.lower[2]})
            margin.points.push_back(static_cast<std::uint32_t>(*find_point(face.points, id)));
        const Vec3 chord = of(face, weld, margin.upper.back()) - of(face, weld, margin.upper.front());
        const Vec3 open = opening_direction(face, margin);
        const Vec3 up = open - (dot(open, chord) / dot(chord, chord)) * chord;
        if (!(length(up) > 0) || !is_finite(up)) continue;
        margin.up = up / length(up);
        margins.push_back(std::move(margin));
    }
    return margins;
}

std::vector<double> along_chord(const std::vector<std::uint32_t>& edge, const Face& face, const Weld& weld) {
    const Vec3 start = of(face, weld, edge.front());
    const Vec3 chord = of(face, weld, edge.back()) - start;
    std::vector<double> along;
    along.reserve(edge.size());
    for (const std::uint32_t p : edge)
        along.push_back(std::clamp(dot(of(face, weld, p) - start, chord) / dot(chord, chord), 0.0, 1.0));
    return along;
}

// The first stretch that passes `along`, so that an edge that turns back is met where it is met first.
OnEdge on_edge(const std::vector<std::uint32_t>& edge, const std::vector<double>& chord, double along) {
    for (std::size_t i = 0; i + 1 < edge.size(); ++i)
        if (chord[i] <= along && along <= chord[i + 1]) {
            const double step = chord[i + 1] - chord[i];
            return {edge[i], edge[i + 1], step > 0 ? (along - chord[i]) / step : 0};
        }
    return {edge.back(), edge.back(), 0};
}

std::vector<Opposite> opposite_places(const Margin& margin, const Face& face, const Weld& weld, std::size_t count) {
    const std::vector<double> upper = along_chord(margin.upper, face, weld);
    const std::vector<double> lower = along_chord(margin.lower, face, weld);
    std::vector<Opposite> places;
    for (std::size_t i = 1; i <= count; ++i) {
        const double along = static_cast<double>(i) / static_cast<double>(count + 1);
        places.push_back({on_edge(margin.upper, upper, along), on_edge(margin.lower, lower, along)});
    }
    return places;
}

std::vector<double> openings(const Margin& margin, const std::function<Vec3(std::uint32_t)>& at, std::size_t count) {
    const Vec3 start = at(margin.upper.front()), chord = at(margin.upper.back()) - start;
    const auto along = [&](const std::vector<std::uint32_t>& edge) {
        std::vector<double> shares;
        shares.reserve(edge.size());
        for (const std::uint32_t p : edge) shares.push_back(dot(at(p) - start, chord) / dot(chord, chord));
        return shares;
    };
    const std::vector<double> upper = along(margin.upper), lower = along(margin.lower);
    std::vector<double> result;
    for (std::size_t i = 1; i <= count; ++i) {
        const double step = static_cast<double>(i) / static_cast<double>(count + 1);
        const Vec3 above = value_on(on_edge(margin.upper, upper, step), at);
        result.push_back(dot(margin.up, above - value_on(on_edge(margin.lower, lower, step), at)));
    }
    return result;
}

Vec3 value_on(const OnEdge& place, const std::function<Vec3(std::uint32_t)>& at) {
    return (1 - place.share) * at(place.from) + place.share * at(place.to);
}

}  // namespace mien
