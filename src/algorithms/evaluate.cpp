// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The measure of docs/evaluate.md: every vertex weighs the same, and motion that leaks into parts that are still is
// charged, because it stands in the numerator while the denominator is the true motion of all.

#include "mien/algorithms/evaluate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <span>
#include <string_view>

#include "algorithms/face_regions.hpp"
#include "algorithms/flipped_faces.hpp"
#include "algorithms/margins.hpp"

#include "mien/algorithms/deform.hpp"
#include "mien/error.hpp"

namespace mien {

namespace {

constexpr std::size_t places_along_a_slit = 19;

using Positions = std::vector<Vec3f>;

struct Slit {
    Margin margin;
    std::vector<Opposite> places;
};

// What does not change from shape to shape.
struct Ground {
    const Face& face;
    Weld weld;
    double eyes = 1;
    std::vector<std::size_t> region;  // one per vertex
    std::vector<Slit> slits;
};

Ground ground_of(const Face& face, const Rig& rig) {
    Ground ground{face, weld(face.mesh), eye_distance(face.points), {}, {}};
    const EdgeGraph graph = edge_graph(face.mesh, ground.weld);
    ground.region = vertex_regions(face, ground.weld, graph);
    for (const Eyeball& eyeball : rig.eyeballs)
        for (const std::uint32_t v : eyeball.vertices) ground.region[v] = eyes_region;
    for (Margin& margin : find_margins(face, ground.weld, graph)) {
        std::vector<Opposite> places = opposite_places(margin, face, ground.weld, places_along_a_slit);
        ground.slits.push_back({std::move(margin), std::move(places)});
    }
    return ground;
}

Positions truth_of(const Mesh& mesh, const MorphTarget& shape) {
    Positions positions = mesh.positions;
    for (std::size_t i = 0; i < shape.vertices.size(); ++i) positions[shape.vertices[i]] += shape.deltas[i];
    return positions;
}

Positions made_by(const Mesh& mesh, const Rig& rig, const Positions& truth) {
    std::vector<Vec3f> moves;
    for (const FeaturePoint& point : rig.points) moves.push_back(truth[point.vertex] - mesh.positions[point.vertex]);
    Positions found(mesh.positions.size());
    deform(rig, moves, found);
    return found;
}

double squared(const Vec3f& a, const Vec3f& b) {
    const Vec3 d = to_double(a) - to_double(b);
    return dot(d, d);
}

double share(double squared_error, double squared_motion) {
    if (squared_error == 0) return 0;
    return squared_motion > 0 ? std::sqrt(squared_error / squared_motion) : std::numeric_limits<double>::infinity();
}

double percentile_95(std::vector<double>& values) {
    if (values.empty()) return 0;
    const auto at = static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + at, values.end());
    return values[static_cast<std::size_t>(at)];
}

// Sums over some of the vertices.
struct Sums {
    std::size_t vertices = 0;
    double error = 0, motion = 0, max = 0;  // squared; squared; in eye distances
    std::vector<double> moving;             // errors where the truth moves, in eye distances
};

void add(Sums& sums, double error, double motion, double eyes) {
    const double here = std::sqrt(error) / eyes;
    ++sums.vertices;
    sums.error += error;
    sums.motion += motion;
    sums.max = std::max(sums.max, here);
    if (motion > least_motion * least_motion * eyes * eyes) sums.moving.push_back(here);
}

double opening(const Ground& ground, const Slit& slit, const Opposite& at, const Positions& positions) {
    const auto place = [&](std::uint32_t p) { return to_double(positions[ground.weld.vertex[p]]); };
    return dot(slit.margin.up, value_on(at.upper, place) - value_on(at.lower, place)) / ground.eyes;
}

void measure_contact(const Ground& ground, const Positions& truth, const Positions& found, ShapeFigures& figures) {
    for (const Slit& slit : ground.slits) {
        double& gap = slit.margin.kind == Margin::Kind::lips ? figures.lip_gap : figures.lid_gap;
        for (const Opposite& at : slit.places) {
            const double wanted = opening(ground, slit, at, truth), got = opening(ground, slit, at, found);
            gap = std::max(gap, std::abs(got - wanted));
            figures.crossing = std::max(figures.crossing, std::min(wanted, 0.0) - got);
        }
    }
}

// What has been summed up over the shapes.
struct Totals {
    Sums all;
    std::array<Sums, region_names.size()> regions;
    FlippedFaces faces;
};

RegionFigures figures_of(std::size_t region, Sums& sums) {
    return {std::string(region_names[region]), sums.vertices, share(sums.error, sums.motion),
            percentile_95(sums.moving), sums.max};
}

ShapeFigures measure(const Ground& ground, const std::string& name, const Positions& truth, const Positions& found,
                     Totals& totals) {
    Sums all;
    std::array<Sums, region_names.size()> regions;
    const Positions& rest = ground.face.mesh.positions;
    for (std::size_t v = 0; v < rest.size(); ++v) {
        const double error = squared(found[v], truth[v]), motion = squared(truth[v], rest[v]);
        add(all, error, motion, ground.eyes);
        add(regions[ground.region[v]], error, motion, ground.eyes);
    }
    const FlippedFaces faces = flipped_faces(ground.face.mesh, truth, found, least_motion * ground.eyes);
    ShapeFigures figures;
    figures.shape = name;
    figures.error = share(all.error, all.motion);
    figures.p95 = percentile_95(all.moving);
    figures.max = all.max;
    figures.flipped = share(faces);
    measure_contact(ground, truth, found, figures);
    for (std::size_t r = 0; r < regions.size(); ++r) {
        if (regions[r].vertices == 0) continue;
        totals.regions[r].error += regions[r].error;
        totals.regions[r].motion += regions[r].motion;
        figures.regions.push_back(figures_of(r, regions[r]));
    }
    totals.all.error += all.error;
    totals.all.motion += all.motion;
    totals.faces += faces;
    return figures;
}

// The head's figures in a region: the largest of the shapes', but for the error.
void add_regions(const Totals& totals, Evaluation& evaluation) {
    evaluation.regions = evaluation.shapes.front().regions;
    for (std::size_t i = 0; i < evaluation.regions.size(); ++i) {
        RegionFigures& region = evaluation.regions[i];
        const auto r = std::find(region_names.begin(), region_names.end(), region.name) - region_names.begin();
        const Sums& sums = totals.regions[static_cast<std::size_t>(r)];
        region.error = share(sums.error, sums.motion);
        for (const ShapeFigures& shape : evaluation.shapes) {
            region.p95 = std::max(region.p95, shape.regions[i].p95);
            region.max = std::max(region.max, shape.regions[i].max);
        }
    }
}

void sum_up(const Totals& totals, Evaluation& evaluation) {
    const auto count = static_cast<double>(evaluation.shapes.size());
    for (const ShapeFigures& shape : evaluation.shapes) {
        evaluation.error += shape.error / count;
        evaluation.p95 += shape.p95 / count;
        evaluation.max = std::max(evaluation.max, shape.max);
        evaluation.lid_gap = std::max(evaluation.lid_gap, shape.lid_gap);
        evaluation.lip_gap = std::max(evaluation.lip_gap, shape.lip_gap);
        evaluation.crossing = std::max(evaluation.crossing, shape.crossing);
    }
    evaluation.pooled = share(totals.all.error, totals.all.motion);
    evaluation.flipped = share(totals.faces);
    add_regions(totals, evaluation);
}

void check(const Face& face, const Rig& rig) {
    if (vertex_count(rig) != vertex_count(face.mesh))
        throw Error(fmt::format("evaluate: expected a rig of the head's {} vertices, found one of {}",
                                vertex_count(face.mesh), vertex_count(rig)));
    for (const FeaturePoint& point : rig.points)
        if (point.vertex >= vertex_count(face.mesh))
            throw Error(fmt::format("evaluate: expected vertices below {}, found {} at point {}",
                                    vertex_count(face.mesh), point.vertex, point.id));
}

}  // namespace

Evaluation evaluate(const Face& face, const Rig& rig) {
    check(face, rig);
    const Ground ground = ground_of(face, rig);
    if (!(ground.eyes > 0)) throw Error("evaluate: expected points that are apart, to measure lengths by; found one");
    Evaluation evaluation;
    evaluation.method = rig.method;
    Totals totals;
    for (const MorphTarget& shape : face.mesh.morph_targets) {
        const Positions truth = truth_of(face.mesh, shape);
        if (truth == face.mesh.positions) {
            evaluation.still.push_back(shape.name);
            continue;
        }
        evaluation.shapes.push_back(measure(ground, shape.name, truth, made_by(face.mesh, rig, truth), totals));
    }
    if (evaluation.shapes.empty())
        throw Error(fmt::format("evaluate: expected a head with shapes that move something, found {} shapes",
                                evaluation.still.size()));
    sum_up(totals, evaluation);
    return evaluation;
}

std::vector<MorphTarget> reproduce_shapes(const Face& face, const Rig& rig) {
    check(face, rig);
    std::vector<MorphTarget> shapes;
    for (const MorphTarget& shape : face.mesh.morph_targets) {
        const Positions found = made_by(face.mesh, rig, truth_of(face.mesh, shape));
        MorphTarget& made = shapes.emplace_back();
        made.name = shape.name;
        for (std::uint32_t v = 0; v < found.size(); ++v) {
            if (found[v] == face.mesh.positions[v]) continue;
            made.vertices.push_back(v);
            made.deltas.push_back(found[v] - face.mesh.positions[v]);
        }
    }
    return shapes;
}

}  // namespace mien
