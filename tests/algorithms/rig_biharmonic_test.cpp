// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/rig_biharmonic.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "shapes.hpp"

#include "mien/error.hpp"

namespace mien {
namespace {

constexpr BiharmonicOptions everything{.far_radius = 100, .influences = 0};

// Weight of a rig point at a vertex along x.
double weight(const Rig& rig, std::uint32_t vertex, std::uint16_t point) {
    for (std::uint32_t e = rig.row_starts[vertex]; e < rig.row_starts[vertex + 1]; ++e)
        if (rig.row_points[e] == point) return rig.weights[e].x;
    return 0;
}

double sum_of_weights(const Rig& rig, std::uint32_t vertex) {
    double sum = 0;
    for (std::uint32_t e = rig.row_starts[vertex]; e < rig.row_starts[vertex + 1]; ++e) sum += rig.weights[e].x;
    return sum;
}

// A strip along x whose columns `at` are held, both vertices of each.
Face held_strip(std::uint32_t quads, std::initializer_list<std::uint32_t> at) {
    Face face{shapes::strip(quads), {}};
    for (const std::uint32_t column : at) {
        face.points.push_back(shapes::point_at(face.mesh, "low" + std::to_string(column), column));
        face.points.push_back(shapes::point_at(face.mesh, "high" + std::to_string(column), column + quads + 1));
    }
    return face;
}

TEST(RigBiharmonic, RefusesOptionsThatMakeNoSheet) {
    const Face face = shapes::mask();
    for (const double wrong : {-1.0, std::numeric_limits<double>::quiet_NaN()}) {
        EXPECT_THROW(rig_biharmonic(face, {.tension = wrong}), Error);
        EXPECT_THROW(rig_biharmonic(face, {.far_radius = wrong}), Error);
    }
}

TEST(RigBiharmonic, RefusesFacesWithoutPointsAndPointsOffTheMesh) {
    Face face = shapes::mask();
    face.points[3].vertex = 100000;
    EXPECT_THROW(rig_biharmonic(face), Error);
    face.points.clear();
    EXPECT_THROW(rig_biharmonic(face), Error);
}

// w"" = s^2 w" between columns at 0 and 1, which the sheet meets without slope, at an open border as in the middle of
// a symmetric strip: with z measured from half way and c half the length, 1/2 - B (s cosh(s c) z - sinh(s z)); for
// s -> 0 the cubic 1 - 3 u^2 + 2 u^3.
double spline_in_tension(double s, double x, double length) {
    const double u = x / length, c = length / 2, z = x - c;
    if (s == 0) return 1 - u * u * (3 - 2 * u);
    const double b = 0.5 / (s * c * std::cosh(s * c) - std::sinh(s * c));
    return 0.5 - b * (s * std::cosh(s * c) * z - std::sinh(s * z));
}

BiharmonicOptions with_stiffness(const Face& face, double s) {
    BiharmonicOptions options = everything;
    options.tension = s * s * eye_distance(face.points) * eye_distance(face.points);
    return options;
}

TEST(RigBiharmonic, AStripHeldAtItsEndsIsASplineInTension) {
    const std::uint32_t n = 60;
    const Face face = held_strip(n, {0, n});
    for (const double s : {0.0, 0.05, 0.2}) {
        const Rig rig = rig_biharmonic(face, with_stiffness(face, s));
        for (std::uint32_t x = 0; x <= n; ++x)
            EXPECT_NEAR(weight(rig, x, 0) + weight(rig, x, 1), spline_in_tension(s, x, n), 0.004) << s << ", " << x;
    }
}

TEST(RigBiharmonic, TheMiddleOfThreeHeldColumnsIsASplineToBothSides) {
    const std::uint32_t m = 60;
    const Face face = held_strip(2 * m, {0, m, 2 * m});
    for (const double s : {0.0, 0.05, 0.2}) {
        const Rig rig = rig_biharmonic(face, with_stiffness(face, s));
        for (std::uint32_t x = 0; x <= 2 * m; ++x)
            EXPECT_NEAR(weight(rig, x, 2) + weight(rig, x, 3), 1 - spline_in_tension(s, x < m ? x : 2 * m - x, m),
                        0.004)
                << s << ", " << x;
    }
}

TEST(RigBiharmonic, PointsThatMoveAsOneCarryTheSkinAlong) {
    const Face face = shapes::mask();
    const Rig all = rig_biharmonic(face, everything);
    const Rig few = rig_biharmonic(face, {.far_radius = 100, .influences = 8});
    for (std::uint32_t v = 0; v < vertex_count(all); ++v) {
        EXPECT_NEAR(sum_of_weights(all, v), 1, 1e-5) << v;
        EXPECT_NEAR(sum_of_weights(few, v), 1, 1e-3) << v;
    }
}

TEST(RigBiharmonic, WhatLiesFarFromEveryPointKeepsStillAndIsCounted) {
    Face face = held_strip(60, {0, 4});
    const double radius = 2.5;
    const double reach = 4 + radius * eye_distance(face.points);
    const Rig rig = rig_biharmonic(face, {.far_radius = radius, .influences = 0});
    std::uint32_t still = 0;
    for (std::uint32_t v = 0; v < vertex_count(rig); ++v) {
        const bool is_far = face.mesh.positions[v].x > reach;
        EXPECT_EQ(rig.row_starts[v] == rig.row_starts[v + 1], is_far) << v;
        still += is_far ? 1 : 0;
    }
    EXPECT_EQ(rig.unreached, still);
    EXPECT_GT(still, 20U);
}

TEST(RigBiharmonic, AVertexFollowsAtMostTheInfluencesAskedFor) {
    for (const std::uint32_t influences : {4U, 8U, 12U}) {
        const Rig rig = rig_biharmonic(shapes::mask(), {.influences = influences});
        std::uint32_t most = 0;
        for (std::uint32_t v = 0; v < vertex_count(rig); ++v)
            most = std::max(most, rig.row_starts[v + 1] - rig.row_starts[v]);
        EXPECT_EQ(most, influences);
    }
}

TEST(RigBiharmonic, APointHeldAlongAnAxisIsOrdinarySkinThere) {
    Face face = shapes::mask();
    face.points[2].moves.y = false;
    const std::uint32_t chin = face.points[2].vertex;
    const Rig rig = rig_biharmonic(face, {.influences = 0});
    std::vector<std::string> others;
    for (const FeaturePoint& point : face.points)
        if (point.id != face.points[2].id) others.push_back(point.id);
    const Rig without = rig_biharmonic(with_points(face, others), {.influences = 0});
    float carried = 0;
    for (std::uint32_t e = rig.row_starts[chin]; e < rig.row_starts[chin + 1]; ++e) {
        const bool own = rig.row_points[e] == 2;
        EXPECT_EQ(rig.weights[e].x, own ? 1 : 0);
        EXPECT_EQ(rig.weights[e].z, own ? 1 : 0);
        EXPECT_TRUE(!own || rig.weights[e].y == 0);
        carried += rig.weights[e].y;
    }
    EXPECT_NEAR(carried, sum_of_weights(without, chin), 1e-5);
    EXPECT_GT(carried, 0.1);
}

}  // namespace
}  // namespace mien
