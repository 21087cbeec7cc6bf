// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/rig_surface_distance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <gmock/gmock.h>
#include <numbers>

#include "algorithms/regions.hpp"
#include "algorithms/weight_smoothing.hpp"
#include "shapes.hpp"

#include "mien/algorithms/deform.hpp"

// What holds for every rigger is in rig_laws_test.cpp; here are the paper's equations and the remedies one by one.

namespace mien {
namespace {

using testing::ElementsAre;

Face with_points_at(Mesh mesh, std::initializer_list<std::uint32_t> vertices) {
    Face face{std::move(mesh), {}};
    for (const std::uint32_t v : vertices) face.points.push_back(shapes::point_at(face.mesh, std::to_string(v), v));
    return face;
}

Rig rig(const Face& face, Reading reading) {
    return rig_surface_distance(face, {reading});
}

double weight(const Rig& rig, std::uint32_t vertex, std::size_t point) {
    for (std::uint32_t e = rig.row_starts[vertex]; e < rig.row_starts[vertex + 1]; ++e)
        if (rig.row_points[e] == point) return rig.weights[e].x;
    return 0;
}

// Eq. 4.
double w(double d_ip, double d) {
    return std::sin(0.5 * std::numbers::pi * (1 - d_ip / d));
}

EdgeGraph graph_of(const Mesh& mesh) {
    return edge_graph(mesh, weld(mesh));
}

TEST(Regions, GrowOneEdgeAtATimeAsWrittenAndByLengthAsRemedied) {
    // A row of places at 0, 1, 2, 3 and then at 10: by steps the middle lies between the ends, by length before them.
    Mesh mesh = shapes::strip(4);
    mesh.positions[4].x = mesh.positions[9].x = 10;
    const std::array<std::uint32_t, 2> seeds{0, 4};
    const auto steps = regions_by_steps(graph_of(mesh), seeds);
    const auto lengths = regions_by_distance(graph_of(mesh), seeds);
    EXPECT_THAT(std::vector(steps.begin(), steps.begin() + 5), ElementsAre(0, 0, 0, 1, 1));
    EXPECT_THAT(std::vector(lengths.begin(), lengths.begin() + 5), ElementsAre(0, 0, 0, 0, 1));
}

TEST(Regions, StopAtTheEdgeOfTheIsland) {
    Mesh mesh = shapes::strip(1);
    shapes::append(mesh, shapes::strip(1), {0, 5, 0});
    const std::array<std::uint32_t, 1> seeds{0};
    for (const auto& regions : {regions_by_steps(graph_of(mesh), seeds), regions_by_distance(graph_of(mesh), seeds)})
        EXPECT_THAT(regions, ElementsAre(0, 0, 0, 0, no_region, no_region, no_region, no_region));
}

TEST(Regions, NeighboursShareABoundary) {
    // Three seeds in a row: the outer ones do not meet.
    const Mesh mesh = shapes::strip(6);
    const std::array<std::uint32_t, 3> seeds{0, 3, 6};
    const auto graph = graph_of(mesh);
    EXPECT_THAT(region_neighbours(graph, regions_by_steps(graph, seeds), 3),
                ElementsAre(ElementsAre(1), ElementsAre(0, 2), ElementsAre(1)));
}

TEST(SurfaceDistancePaper, OneNeighbourGivesTheReachOfEquation2sRemark) {
    // A grid of unit quads, two points 4 apart on its lower border. At P straight between them cos = 1, d = 4; one row
    // up at (1, 1) from FP_1: d_1P = 2, cos = 1/sqrt 2, d = 4 sqrt 2; from FP_2: d_2P = 4, cos = 3/sqrt 10.
    const Rig made = rig(with_points_at(shapes::grid(4, 4), {0, 4}), Reading::paper);
    const double w1 = w(1, 4), w2 = w(3, 4);
    EXPECT_NEAR(weight(made, 1, 0), w1 / (w1 + w2 / 9), 1e-6);
    EXPECT_NEAR(weight(made, 1, 1), w2 / 9 / (w1 + w2 / 9), 1e-6);
    const double up_1 = w(2, 4 * std::sqrt(2)), up_2 = w(4, 4 * std::sqrt(10) / 3);
    EXPECT_NEAR(weight(made, 6, 0), up_1 / 4 / (up_1 / 4 + up_2 / 16), 1e-6);
}

TEST(SurfaceDistancePaper, TwoNeighboursShareTheReachByTheirCosines) {
    // FP_1 at a corner of the grid, FP_2 4 to its right, FP_3 6 above it. P = (2, 1): d_1P = 3, cosines 2 and 1 over
    // sqrt 5, so d = (4 * 2 + 6 * 1) / 3 = 14/3. P from FP_2: d_2P = 3, its only neighbour before P is FP_1 or FP_3.
    const Face face = with_points_at(shapes::grid(4, 6), {0, 4, 30});
    const Rig made = rig(face, Reading::paper);
    const double w_1 = w(3, 14.0 / 3) / 9;
    // FP_2 at (4, 0): towards P (-2, 1)/sqrt 5; FP_1 at (-1, 0), d = 4, cos 2/sqrt 5; FP_3 at (-4, 6)/sqrt 52, d = 10.
    const double cos_1 = 2 / std::sqrt(5), cos_3 = 14 / std::sqrt(5 * 52);
    const double w_2 = w(3, (4 * cos_1 + 10 * cos_3) / (cos_1 + cos_3)) / 9;
    // FP_3 at (0, 6): towards P (2, -5)/sqrt 29, d_3P = 7; FP_1 at (0, -1), d = 6; FP_2 at (4, -6)/sqrt 52, d = 10.
    const double cos_31 = 5 / std::sqrt(29), cos_32 = 38 / std::sqrt(29 * 52);
    const double d_3 = (6 * cos_31 + 10 * cos_32) / (cos_31 + cos_32);
    const double w_3 = 7 < d_3 ? w(7, d_3) / 49 : 0;
    EXPECT_NEAR(weight(made, 7, 0), w_1 / (w_1 + w_2 + w_3), 1e-6);
    EXPECT_NEAR(weight(made, 7, 1), w_2 / (w_1 + w_2 + w_3), 1e-6);
    EXPECT_NEAR(weight(made, 7, 2), w_3 / (w_1 + w_2 + w_3), 1e-6);
}

TEST(SurfaceDistancePaper, AVertexWithOneInfluenceFollowsItWhollyAndOthersSumToOne) {
    const Face face = shapes::mask();
    const Rig made = rig(face, Reading::paper);
    std::uint32_t empty = 0;
    for (std::uint32_t v = 0; v < vertex_count(made); ++v) {
        double sum = 0;
        for (std::size_t i = 0; i < face.points.size(); ++i) sum += weight(made, v, i);
        if (sum == 0) ++empty;
        EXPECT_TRUE(sum == 0 || std::abs(sum - 1) < 1e-5) << v;
    }
    EXPECT_EQ(made.unreached, empty);
    EXPECT_GT(empty, 0U);
}

TEST(SurfaceDistancePaper, BehindAPointWithoutNeighboursThereNothingMoves) {
    // The points are at x = 2 and 4 of a strip; places left of x = 2 have both neighbours behind a right angle.
    const Rig made = rig(with_points_at(shapes::strip(6), {2, 4}), Reading::paper);
    for (const std::uint32_t v : {0U, 1U}) EXPECT_EQ(weight(made, v, 0), 0) << v;
    EXPECT_NEAR(weight(made, 3, 0), 0.5, 1e-6);
}

TEST(SurfaceDistanceRemedied, WeightsLieBetweenNoneAndAllAndNeverSumToMore) {
    const Face face = shapes::mask();
    const Rig made = rig(face, Reading::remedied);
    for (std::uint32_t v = 0; v < vertex_count(made); ++v) {
        double sum = 0;
        for (std::size_t i = 0; i < face.points.size(); ++i) {
            EXPECT_GE(weight(made, v, i), 0);
            sum += weight(made, v, i);
        }
        EXPECT_LT(sum, 1 + 1e-5);
    }
}

TEST(SurfaceDistanceRemedied, AVertexWithOneInfluenceFollowsItAsFarAsItsWeightGoes) {
    // Points at 0 and 4 of a strip: 7 is reached by the second alone, 3 of its 4 units away. The smoothing reaches
    // 0.12.
    const Face face = with_points_at(shapes::strip(8), {0, 4});
    EXPECT_NEAR(weight(rig(face, Reading::remedied), 7, 1), w(3, 4), 0.02);
    EXPECT_NEAR(weight(rig(face, Reading::paper), 3, 1), w(1, 4) / (w(1, 4) + w(3, 4) / 9), 1e-6);
}

// Largest difference of the weight vectors of two vertices on an edge away from the points, as a share of what is
// possible.
double largest_jump(const Rig& made, const Face& face) {
    const EdgeGraph graph = graph_of(face.mesh);
    double largest = 0;
    for (std::uint32_t v = 0; v < vertex_count(made); ++v)
        for (std::uint32_t e = graph.starts[v]; e < graph.starts[v + 1]; ++e) {
            const auto is_end = [&](const FeaturePoint& p) { return p.vertex == v || p.vertex == graph.neighbours[e]; };
            if (std::any_of(face.points.begin(), face.points.end(), is_end)) continue;
            double sum = 0;
            for (std::size_t i = 0; i < face.points.size(); ++i)
                sum += std::abs(weight(made, v, i) - weight(made, graph.neighbours[e], i));
            largest = std::max(largest, sum / 2);
        }
    return largest;
}

TEST(SurfaceDistanceRemedied, WeightsJumpLessFromVertexToVertexThanAsWritten) {
    const Face face = shapes::mask();
    EXPECT_LT(largest_jump(rig(face, Reading::remedied), face), 0.8 * largest_jump(rig(face, Reading::paper), face));
}

TEST(SurfaceDistanceRemedied, ReachesEveryVertexNearAPoint) {
    const Face face = shapes::mask();
    const Rig made = rig(face, Reading::remedied);
    EXPECT_LT(made.unreached, rig(face, Reading::paper).unreached);
    for (const FeaturePoint& point : face.points)
        for (const std::uint32_t beside : {point.vertex - 1, point.vertex + 1, point.vertex - 25, point.vertex + 25})
            EXPECT_LT(made.row_starts[beside], made.row_starts[beside + 1]) << point.id;
}

TEST(SurfaceDistance, PointsOnEyeballsMoveNoSkin) {
    Face face = shapes::mask();
    const auto eye = static_cast<std::uint32_t>(vertex_count(face.mesh));
    shapes::append(face.mesh, shapes::ball({0.5F, 0, -0.3F}, 0.25F));
    face.points.push_back(shapes::point_at(face.mesh, "3.5", eye));
    for (const Reading reading : {Reading::paper, Reading::remedied}) {
        const Rig made = rig(face, reading);
        EXPECT_EQ(std::count(made.row_points.begin(), made.row_points.end(), face.points.size() - 1), 0);
        EXPECT_EQ(made.eyeballs.size(), 1U);
    }
}

TEST(SmoothWeights, KeepsWeightsThatAreTheSameEverywhere) {
    const Mesh mesh = shapes::grid(5, 5);
    WeightRows rows;
    for (std::uint32_t p = 0; p < 36; ++p) {
        rows.points.push_back(3);
        rows.weights.push_back(1);
        rows.starts.push_back(p + 1);
    }
    const WeightRows smooth =
        smooth_weights(rows, mesh, weld(mesh), std::vector<bool>(36, true), std::vector<HeldPlace>{{14, 3}}, 2);
    EXPECT_EQ(smooth.points, rows.points);
    for (const double weight : smooth.weights) EXPECT_NEAR(weight, 1, 1e-12);
}

TEST(SmoothWeights, FadesAlongAStripAsTheEquationOfHeatDoes) {
    // One implicit step for the time t from nothing but a held end solves w - t w'' = 0: w = cosh((l - x) / sqrt t) /
    // cosh(l / sqrt t) with a free end at l.
    constexpr std::uint32_t quads = 400, vertices = 2 * (quads + 1);
    Mesh mesh = shapes::grid(quads, 1, 0.01F);
    WeightRows rows;
    for (std::uint32_t p = 0; p < vertices; ++p) {
        if (p % (quads + 1) == 0) {
            rows.points.push_back(p == 0 ? 0 : 1);
            rows.weights.push_back(1);
        }
        rows.starts.push_back(static_cast<std::uint32_t>(rows.points.size()));
    }
    const std::vector<HeldPlace> held{{0, 0}, {quads + 1, 1}};
    const WeightRows smooth = smooth_weights(rows, mesh, weld(mesh), std::vector<bool>(vertices, true), held, 1);
    for (const std::uint32_t i : {50U, 100U, 200U, 400U}) {
        double sum = 0;
        for (std::uint32_t e = smooth.starts[i]; e < smooth.starts[i + 1]; ++e) sum += smooth.weights[e];
        EXPECT_NEAR(sum, std::cosh(4 - 0.01 * i) / std::cosh(4), 1e-3) << i;
    }
}

}  // namespace
}  // namespace mien
