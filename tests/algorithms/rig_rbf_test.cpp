// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/rig_rbf.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "shapes.hpp"

namespace mien {
namespace {

using Kernel = RbfRigOptions::Kernel;

double weight(const Rig& rig, std::uint32_t vertex, std::size_t point) {
    for (std::uint32_t e = rig.row_starts[vertex]; e < rig.row_starts[vertex + 1]; ++e)
        if (rig.row_points[e] == point) return double{rig.weights[e].x};
    return 0;
}

// Lids at (0, 0) and (4, 0) of a strip: eye distance 4, so that nothing on a strip of 8 is far.
Face lids_on_a_strip(std::uint32_t quads) {
    Face face{shapes::strip(quads), {}};
    face.points = {shapes::point_at(face.mesh, "3.1", 0), shapes::point_at(face.mesh, "3.2", 4)};
    return face;
}

TEST(RbfRig, TheLinearKernelIsLinearBetweenTwoPoints) {
    const Rig rig = rig_rbf(lids_on_a_strip(8));
    for (std::uint32_t x = 0; x <= 4; ++x) {
        EXPECT_NEAR(weight(rig, x, 0), 1 - 0.25 * x, 1e-5);
        EXPECT_NEAR(weight(rig, x, 1), 0.25 * x, 1e-5);
    }
    EXPECT_NEAR(weight(rig, 8, 1), 1, 1e-5);
    // Off the line, at (1, 1): 1/2 + (|v - b| - |v - a|) / 8.
    EXPECT_NEAR(weight(rig, 9 + 1, 0), 0.5 + (std::sqrt(10.0) - std::sqrt(2.0)) / 8, 1e-5);
}

TEST(RbfRig, TheSurfaceKernelIsItsClosedFormForTwoPoints) {
    const Rig rig = rig_rbf(lids_on_a_strip(8), {.kernel = Kernel::surface});
    const auto k = [](double way) { return std::exp(-way / 8); };
    const double a = k(1), b = k(3), between = k(4);
    EXPECT_NEAR(weight(rig, 1, 0), (a - between * b) / (1 - between * between), 1e-5);
    EXPECT_NEAR(weight(rig, 1, 1), (b - between * a) / (1 - between * between), 1e-5);
    // At (1, 1) the way runs along two sides.
    EXPECT_NEAR(weight(rig, 9 + 1, 0), (k(2) - between * k(4)) / (1 - between * between), 1e-5);
}

TEST(RbfRig, WhatIsFarKeepsStill) {
    for (const Kernel kernel : {Kernel::linear, Kernel::surface}) {
        const Rig rig = rig_rbf(lids_on_a_strip(40), {.kernel = kernel});
        for (std::uint32_t x = 14; x <= 40; ++x) {
            EXPECT_NEAR(weight(rig, x, 0), 0, 0.02) << x;
            EXPECT_NEAR(weight(rig, x, 1), 0, 0.02) << x;
        }
        EXPECT_NEAR(weight(rig, 40, 1), 0, 1e-6);
    }
}

TEST(RbfRig, AShiftOfAllPointsShiftsAllThatNothingHolds) {
    const Rig rig = rig_rbf(lids_on_a_strip(8));
    for (std::uint32_t v = 0; v < 18; ++v) EXPECT_NEAR(weight(rig, v, 0) + weight(rig, v, 1), 1, 1e-5);
}

TEST(RbfRig, KeepsAsManyPointsAVertexAsAsked) {
    for (const Kernel kernel : {Kernel::linear, Kernel::surface}) {
        const Rig cut = rig_rbf(shapes::mask(), {kernel, 4}), all = rig_rbf(shapes::mask(), {kernel, 0});
        for (std::uint32_t v = 0; v < vertex_count(cut); ++v) EXPECT_LE(cut.row_starts[v + 1] - cut.row_starts[v], 4U);
        EXPECT_GT(all.weights.size(), cut.weights.size());
    }
}

TEST(RbfRig, NamesItself) {
    EXPECT_EQ(rig_rbf(shapes::mask()).method, "rbf");
    EXPECT_EQ(rig_rbf(shapes::mask(), {.kernel = Kernel::surface}).method, "rbf-surface");
}

}  // namespace
}  // namespace mien
