// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/rig_ellipsoid.hpp"

#include <gtest/gtest.h>

#include "shapes.hpp"

namespace mien {
namespace {

float weight(const Rig& rig, std::uint32_t vertex, std::size_t point) {
    for (std::uint32_t e = rig.row_starts[vertex]; e < rig.row_starts[vertex + 1]; ++e)
        if (rig.row_points[e] == point) return rig.weights[e].x;
    return 0;
}

// Points at (0, 0) and (4, 0) of a long strip: along x each has the other at 4, along y there is none, so that the
// radii are 6 along x and 24 along y and z.
Face two_on_a_strip() {
    Face face{shapes::grid(100, 1, 0.1F), {}};
    for (const std::uint32_t v : {0U, 40U}) face.points.push_back(shapes::point_at(face.mesh, std::to_string(v), v));
    return face;
}
Rig paper(const Face& face) {
    return rig_ellipsoid(face, {.reading = Reading::paper});
}
double on_axis(double way) {
    return 1 - way * way / 36;
}

TEST(EllipsoidPaper, WeightsFallWithTheSquareOfTheWayAndAreNormalised) {
    const Rig rig = paper(two_on_a_strip());
    EXPECT_NEAR(weight(rig, 20, 0), 0.5, 1e-6);
    EXPECT_NEAR(weight(rig, 10, 0), on_axis(1) / (on_axis(1) + on_axis(3)), 1e-6);
    EXPECT_NEAR(weight(rig, 10, 1), on_axis(3) / (on_axis(1) + on_axis(3)), 1e-6);
}

TEST(EllipsoidPaper, APointsOwnVertexMovesByLessThanThePointWhereAnotherEllipsoidCoversIt) {
    EXPECT_NEAR(weight(paper(two_on_a_strip()), 0, 0), 1 / (1 + on_axis(4)), 1e-6);
}

TEST(EllipsoidPaper, AVertexWithOneInfluenceFollowsItWholly) {
    const Rig rig = paper(two_on_a_strip());
    EXPECT_GT(on_axis(4), 0.5);
    EXPECT_EQ(weight(rig, 80, 1), 1);
    EXPECT_EQ(rig.unreached, 4U);  // at 9.9 and at 10, where a rim is near
}

TEST(EllipsoidPaper, AContributionUnderATwentiethIsNotSignificant) {
    const Rig rig = paper(two_on_a_strip());
    EXPECT_NEAR(weight(rig, 58, 0), on_axis(5.8) / (on_axis(5.8) + on_axis(1.8)), 1e-6);
    EXPECT_EQ(weight(rig, 59, 0), 0);
    EXPECT_EQ(weight(rig, 59, 1), 1);
}

// The paper's example: the upper lid reaches far towards the corners of the eye, and little towards the brow.
TEST(EllipsoidPaper, ReachIsTakenPerAxisFromThePointsThatLieAlongIt) {
    Face face{shapes::grid(12, 8, 1), {}};
    const auto at = [](std::uint32_t x, std::uint32_t y) { return y * 13 + x; };
    const auto add = [&](const char* id, std::uint32_t v) {
        face.points.push_back(shapes::point_at(face.mesh, id, v));
    };
    add("3.1", at(6, 4)), add("3.7", at(10, 4)), add("3.11", at(2, 4)), add("4.3", at(6, 6));
    const Rig rig = paper(face);
    EXPECT_GT(weight(rig, at(6, 5), 0), 0);
    EXPECT_GT(weight(rig, at(4, 4), 0), weight(rig, at(6, 6), 0));
    EXPECT_EQ(weight(rig, at(6, 1), 0), 0);  // 3 down: at the rim of ry = 3
}

TEST(EllipsoidPaper, FourWeightsAreKeptAndAPairThatTiesGoesTogether) {
    Face face{shapes::grid(12, 12, 1), {}};
    const auto at = [](std::uint32_t x, std::uint32_t y) { return y * 13 + x; };
    for (const std::uint32_t v : {at(6, 10), at(10, 7), at(2, 7), at(8, 2), at(4, 2)})
        face.points.push_back(shapes::point_at(face.mesh, std::to_string(v), v));
    const Rig rig = paper(face);
    const std::uint32_t middle = at(6, 6);
    EXPECT_EQ(rig.row_starts[middle + 1] - rig.row_starts[middle], 3U);
    EXPECT_EQ(weight(rig, middle, 1), weight(rig, middle, 2));
    for (std::uint32_t v = 0; v < vertex_count(rig); ++v) EXPECT_LE(rig.row_starts[v + 1] - rig.row_starts[v], 4U);
}

// Two sheets that touch in space: what the paper's straight lines do to closed lips.
Face two_sheets() {
    Face face{shapes::grid(12, 6, 0.25F), {}};
    shapes::append(face.mesh, shapes::grid(12, 6, 0.25F), {0, 0, 1e-3F});
    for (const std::uint32_t v : {15U, 50U, 91U + 24U})
        face.points.push_back(shapes::point_at(face.mesh, std::to_string(v), v));
    return face;
}

TEST(EllipsoidPaper, SheetsThatTouchFollowEachOther) {
    EXPECT_GT(weight(paper(two_sheets()), 91 + 16, 0), 0.3F);
    EXPECT_EQ(weight(rig_ellipsoid(two_sheets()), 91 + 16, 0), 0);
}

TEST(EllipsoidRemedied, AVertexWithOneInfluenceFollowsItAsFarAsItsWeightGoes) {
    EXPECT_NEAR(weight(rig_ellipsoid(two_on_a_strip()), 80, 1), on_axis(4), 0.02);
}

TEST(EllipsoidRemedied, WeightsLieBetweenNoneAndAllAndNeverSumToMore) {
    const Rig rig = rig_ellipsoid(shapes::mask());
    for (std::uint32_t v = 0; v < vertex_count(rig); ++v) {
        double sum = 0;
        for (std::uint32_t e = rig.row_starts[v]; e < rig.row_starts[v + 1]; ++e) {
            EXPECT_GE(rig.weights[e].x, 0);
            sum += double{rig.weights[e].x};
        }
        EXPECT_LE(sum, 1 + 1e-5);
    }
}

}  // namespace
}  // namespace mien
