// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Dutreve et al., "Feature Points Based Facial Animation Retargeting", section 3.2; docs/papers/dutreve.md has the
// table of equations, tests and deviations.
//
// As written (Reading::paper): straight lines from point to vertex, the four largest of the weights of at least 0.05,
// normalised. Count and threshold are ours, the paper says "only the maximum weights with significant contribution".
// Remedied: the offset d keeps its direction and gets the length of the way along the surface, so that lips and lids
// are far from each other; all weights, times the coverage 1 - prod(1 - w), so that the
// rim of an ellipsoid moves little; the points held, and the smoothing of weight_smoothing.hpp.

#include "mien/algorithms/rig_ellipsoid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <tbb/parallel_for.h>
#include <vector>

#include "algorithms/island.hpp"
#include "algorithms/movers.hpp"
#include "algorithms/weight_smoothing.hpp"

#include "mien/algorithms/surface_distance.hpp"

namespace mien {

namespace {

constexpr double radius_factor = 1.5;
constexpr double along_axis = 0.6;  // cosine of 53 degrees: what lies "along" an axis
constexpr double across_a_gap = 2;  // how much longer than the straight line a way round is
constexpr double least_weight = 0.05;
constexpr std::size_t most_weights = 4;
constexpr double tie = 1e-5;
constexpr double smoothing_length = 0.1;  // in eye distances

std::vector<Vec3> positions_of(const Mesh& mesh, const Weld& weld, const Movers& movers) {
    std::vector<Vec3> positions;
    for (const std::uint32_t place : movers.places) positions.push_back(position(mesh, weld, place));
    return positions;
}

// The radii of point i, whose ways to the others are `ways`. A lip takes no measure from the other one, which it may
// touch. `alone`: the radius where there is no other point.
Vec3 radii(std::span<const Vec3> points, std::span<const double> ways, std::size_t i, double alone) {
    constexpr double none = std::numeric_limits<double>::infinity();
    double nearest = none, across = none, up = none;
    for (std::size_t j = 0; j < points.size(); ++j) {
        if (j == i) continue;
        const Vec3 offset = points[j] - points[i];
        const double far = length(offset);
        if (ways[j] > across_a_gap * far) continue;
        nearest = std::min(nearest, far);
        if (std::abs(offset.x) >= along_axis * far) across = std::min(across, far);
        if (std::abs(offset.y) >= along_axis * far) up = std::min(up, far);
    }
    if (nearest == none) return {alone, alone, alone};
    const double x = radius_factor * std::clamp(across, nearest, 4 * nearest);
    const double y = radius_factor * std::clamp(up, nearest, 4 * nearest);
    return {x, y, std::max(x, y)};
}

// w_ij of the paper; `stretch` is how much longer the way is than the straight line.
double ellipsoid(const Vec3& d, const Vec3& r, double stretch) {
    const double x = d.x / r.x, y = d.y / r.y, z = d.z / r.z;
    return std::max(0.0, 1 - stretch * stretch * (x * x + y * y + z * z));
}

struct Influence {
    std::uint32_t mover = 0;
    double weight = 0;
};
using Rows = std::vector<std::vector<Influence>>;

// The ways from one mover to every place: straight as written, else along the surface.
std::vector<double> ways_from(const Face& face, const Weld& weld, const EdgeGraph& graph, std::uint32_t from,
                              Reading reading) {
    if (reading == Reading::remedied) return surface_distances(graph, from);
    const Vec3 at = position(face.mesh, weld, from);
    std::vector<double> ways;
    ways.reserve(weld.vertex.size());
    for (std::uint32_t p = 0; p < weld.vertex.size(); ++p) ways.push_back(distance(position(face.mesh, weld, p), at));
    return ways;
}

// The places that one mover influences; `mover` then holds the place.
std::vector<Influence> influences_of(const Face& face, const Weld& weld, const std::vector<bool>& solved,
                                     std::span<const double> ways, std::span<const double> to_points,
                                     std::span<const Vec3> points, std::size_t i) {
    const Vec3 r = radii(points, to_points, i, face_scale(face));
    std::vector<Influence> influences;
    for (std::uint32_t p = 0; p < solved.size(); ++p) {
        if (!solved[p] || !std::isfinite(ways[p])) continue;
        const Vec3 d = position(face.mesh, weld, p) - points[i];
        const double straight = length(d);
        const double weight = ellipsoid(d, r, straight > 0 ? ways[p] / straight : 1);
        if (weight > 0) influences.push_back({p, weight});
    }
    return influences;
}

Rows influences(const Face& face, const Weld& weld, const std::vector<bool>& solved, const Movers& movers,
                Reading reading) {
    const EdgeGraph graph = edge_graph(face.mesh, weld);
    const std::vector<Vec3> points = positions_of(face.mesh, weld, movers);
    std::vector<std::vector<Influence>> by_mover(points.size());
    tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) {
        const std::vector<double> ways = ways_from(face, weld, graph, movers.places[i], reading);
        std::vector<double> to_points;
        to_points.reserve(points.size());
        for (const std::uint32_t place : movers.places) to_points.push_back(ways[place]);
        by_mover[i] = influences_of(face, weld, solved, ways, to_points, points, i);
    });
    Rows rows(solved.size());
    for (std::uint32_t i = 0; i < by_mover.size(); ++i)
        for (const Influence& at : by_mover[i]) rows[at.mover].push_back({i, at.weight});
    return rows;
}

// "The maximum weights with significant contribution". Weights that tie with the largest one left out go too, so that
// the order of the points does not choose between the sides of the face.
void keep_largest(std::vector<Influence>& row) {
    std::erase_if(row, [](const Influence& i) { return i.weight < least_weight; });
    if (row.size() <= most_weights) return;
    std::vector<double> sizes;
    sizes.reserve(row.size());
    for (const Influence& i : row) sizes.push_back(i.weight);
    std::sort(sizes.rbegin(), sizes.rend());
    const double left_out = sizes[most_weights] + tie;
    const double least = sizes.front() > left_out ? left_out : 0;
    std::erase_if(row, [&](const Influence& i) { return i.weight <= least; });
}

double coverage(std::span<const Influence> row) {
    double uncovered = 1;
    for (const Influence& i : row) uncovered *= 1 - i.weight;
    return 1 - uncovered;
}

void append(WeightRows& rows, std::span<const Influence> row, const Movers& movers, double share) {
    double sum = 0;
    for (const Influence& i : row) sum += i.weight;
    for (const Influence& i : row) {
        rows.points.push_back(movers.points[i.mover]);
        rows.weights.push_back(share * i.weight / sum);
    }
    rows.starts.push_back(static_cast<std::uint32_t>(rows.points.size()));
}

WeightRows as_written(Rows influences, const Movers& movers) {
    WeightRows rows;
    for (auto& row : influences) {
        keep_largest(row);
        append(rows, row, movers, 1);
    }
    return rows;
}

WeightRows remedied(Rows influences, const Face& face, const Weld& weld, const std::vector<bool>& solved,
                    const Movers& movers) {
    std::vector<HeldPlace> held;
    for (std::uint32_t i = 0; i < movers.places.size(); ++i) {
        influences[movers.places[i]] = {{i, 1}};
        held.push_back({movers.places[i], movers.points[i]});
    }
    WeightRows rows;
    for (const auto& row : influences) append(rows, row, movers, coverage(row));
    if (held.empty()) return rows;
    return smooth_weights(rows, face.mesh, weld, solved, held, smoothing_length * face_scale(face));
}

}  // namespace

Rig rig_ellipsoid(const Face& face, const EllipsoidOptions& options) {
    return rig_by_axes("ellipsoid", face, [&](const Weld& weld, const std::vector<bool>& solved, const Movers& movers) {
        Rows rows = influences(face, weld, solved, movers, options.reading);
        return options.reading == Reading::paper ? as_written(std::move(rows), movers)
                                                 : remedied(std::move(rows), face, weld, solved, movers);
    });
}

}  // namespace mien
