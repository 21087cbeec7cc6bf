// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Kshirsagar et al., "Feature Point Based Mesh Deformation Applied to MPEG-4 Facial Animation", section 2, eq. 1-5;
// docs/papers/kshirsagar.md has the table of equations, tests and deviations.
//
// As written (Reading::paper): regions grown by edge steps, the two neighbours at the smallest angles below a right
// angle, eq. 2 or d12 / cos for one neighbour, eq. 4, and eq. 5 with its denominator folded into fixed weights.
// Remedied: regions by surface distance, eq. 2 over all neighbours with weights that fade with the angle instead of a
// cut, eq. 5 times the coverage 1 - prod(1 - W) so that a weight of little moves a vertex little, and the smoothing of
// weight_smoothing.hpp.

#include "mien/algorithms/rig_surface_distance.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <tbb/parallel_for.h>
#include <vector>

#include "algorithms/island.hpp"
#include "algorithms/movers.hpp"
#include "algorithms/regions.hpp"
#include "algorithms/weight_smoothing.hpp"

#include "mien/algorithms/surface_distance.hpp"

namespace mien {

namespace {

struct Surface {
    const Mesh& mesh;
    const Weld& weld;
    EdgeGraph graph;
    [[nodiscard]] Vec3 position(std::uint32_t place) const { return to_double(mesh.positions[weld.vertex[place]]); }
};

// A neighbouring feature point FP_j as seen from FP_i.
struct Neighbour {
    Vec3 direction;       // unit, straight through space
    double distance = 0;  // d_ij, along the surface
};

// The effect of one feature point at one place.
struct Influence {
    std::uint32_t place = 0;
    double weight = 0;    // W_iP
    double distance = 0;  // d_iP
};

Vec3 direction(const Vec3& from, const Vec3& to) {
    const double far = distance(from, to);
    return far > 0 ? (to - from) / far : Vec3{};
}

// Eq. 1 and 2: d from the two neighbours at the smallest angles below a right angle, d12 / cos when there is only one,
// nothing (0) when there is none.
double reach_as_written(const Vec3& towards_p, std::span<const Neighbour> neighbours) {
    double cos_2 = 0, d_12 = 0, cos_3 = 0, d_13 = 0;
    for (const Neighbour& neighbour : neighbours) {
        const double cosine = dot(towards_p, neighbour.direction);
        if (cosine > cos_2) {
            cos_3 = cos_2;
            d_13 = d_12;
            cos_2 = cosine;
            d_12 = neighbour.distance;
        } else if (cosine > cos_3) {
            cos_3 = cosine;
            d_13 = neighbour.distance;
        }
    }
    if (cos_2 <= 0) return 0;
    if (cos_3 <= 0) return d_12 / cos_2;
    return (d_12 * cos_2 + d_13 * cos_3) / (cos_2 + cos_3);
}

// Eq. 2 over all neighbours. The cut at a right angle leaves places without any influence and lets d jump where a
// neighbour crosses it; here a neighbour fades out behind the point. A point without any neighbour reaches as far as
// its island goes.
double reach_smooth(const Vec3& towards_p, std::span<const Neighbour> neighbours, double farthest) {
    double sum = 0, shares = 0;
    for (const Neighbour& neighbour : neighbours) {
        const double share = std::exp(3 * (dot(towards_p, neighbour.direction) - 1));
        sum += share * neighbour.distance;
        shares += share;
    }
    return shares > 0 ? sum / shares : farthest;
}

// Section 2.1.2: every place that FP_i influences, with W_iP (eq. 4) and d_iP.
std::vector<Influence> influences_of(const Surface& surface, const Movers& movers, std::size_t i,
                                     std::span<const std::uint32_t> neighbours, Reading reading) {
    const std::vector<double> d_i = surface_distances(surface.graph, movers.places[i]);
    const Vec3 fp_i = surface.position(movers.places[i]);
    std::vector<Neighbour> around;
    for (const std::uint32_t j : neighbours)
        around.push_back({direction(fp_i, surface.position(movers.places[j])), d_i[movers.places[j]]});

    double farthest = 0;
    for (const double d : d_i)
        if (std::isfinite(d)) farthest = std::max(farthest, d);

    std::vector<Influence> influences;
    for (std::uint32_t p = 0; p < d_i.size(); ++p) {
        if (!std::isfinite(d_i[p]) || p == movers.places[i]) continue;
        const Vec3 towards_p = direction(fp_i, surface.position(p));
        const double d =
            reading == Reading::paper ? reach_as_written(towards_p, around) : reach_smooth(towards_p, around, farthest);
        if (d_i[p] < d) influences.push_back({p, std::sin(0.5 * std::numbers::pi * (1 - d_i[p] / d)), d_i[p]});
    }
    return influences;
}

std::vector<std::vector<Influence>> all_influences(const Surface& surface, const Movers& movers, Reading reading) {
    const auto regions = reading == Reading::paper ? regions_by_steps(surface.graph, movers.places)
                                                   : regions_by_distance(surface.graph, movers.places);
    const auto neighbours = region_neighbours(surface.graph, regions, movers.places.size());
    std::vector<std::vector<Influence>> influences(movers.places.size());
    tbb::parallel_for(std::size_t{0}, influences.size(), [&](std::size_t i) {
        influences[i] = influences_of(surface, movers, i, neighbours[i], reading);
    });
    return influences;
}

// Turns influences per point into influences per place; `place` then holds the mover instead.
std::vector<std::vector<Influence>> by_place(const std::vector<std::vector<Influence>>& by_mover, const Movers& movers,
                                             std::size_t places) {
    std::vector<std::vector<Influence>> rows(places);
    for (std::uint32_t i = 0; i < by_mover.size(); ++i)
        for (const Influence& influence : by_mover[i])
            rows[influence.place].push_back({i, influence.weight, influence.distance});
    // A place at a feature point follows it alone: eq. 5 in the limit d -> 0.
    for (std::uint32_t i = 0; i < movers.places.size(); ++i) rows[movers.places[i]] = {{i, 1, 1}};
    return rows;
}

// Eq. 5 with D_i taken out: what FP_i's displacement is multiplied with at this place.
void append_row(WeightRows& rows, std::span<const Influence> influences, Reading reading) {
    double sum = 0, uncovered = 1;
    for (const Influence& i : influences) {
        sum += i.weight / (i.distance * i.distance);
        uncovered *= 1 - i.weight;
    }
    const double coverage = reading == Reading::paper ? 1 : 1 - uncovered;
    for (const Influence& i : influences) {
        if (i.weight <= 0) continue;
        rows.points.push_back(static_cast<std::uint16_t>(i.place));
        rows.weights.push_back(coverage * (i.weight / (i.distance * i.distance)) / sum);
    }
    rows.starts.push_back(static_cast<std::uint32_t>(rows.points.size()));
}

// How far the smoothing step reaches, in eye distances.
constexpr double smoothing_length = 0.1;

WeightRows rows_along(const Surface& surface, const Face& face, const std::vector<bool>& solved, const Movers& movers,
                      Reading reading) {
    const auto influences = by_place(all_influences(surface, movers, reading), movers, surface.weld.vertex.size());
    WeightRows rows;
    for (const auto& at_place : influences) append_row(rows, at_place, reading);
    for (std::uint16_t& point : rows.points) point = movers.points[point];
    if (reading == Reading::paper || movers.points.empty()) return rows;
    std::vector<HeldPlace> held;
    for (std::size_t i = 0; i < movers.points.size(); ++i) held.push_back({movers.places[i], movers.points[i]});
    return smooth_weights(rows, surface.mesh, surface.weld, solved, held, smoothing_length * face_scale(face));
}

}  // namespace

Rig rig_surface_distance(const Face& face, const SurfaceDistanceOptions& options) {
    return rig_by_axes("surface-distance", face,
                       [&](const Weld& weld, const std::vector<bool>& solved, const Movers& movers) {
                           const Surface surface{face.mesh, weld, edge_graph(face.mesh, weld)};
                           return rows_along(surface, face, solved, movers, options.reading);
                       });
}

}  // namespace mien
