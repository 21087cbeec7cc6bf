// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/vec.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace mien {
namespace {

const Quaternion quarter_about_y{0, std::sqrt(0.5), 0, std::sqrt(0.5)};

TEST(Vec, TheCrossProductStandsOnBothAndFollowsTheRightHand) {
    EXPECT_EQ(cross(Vec3{1, 0, 0}, Vec3{0, 1, 0}), (Vec3{0, 0, 1}));
    const Vec3 a{1, -2, 3}, b{0.5, 4, -1};
    EXPECT_EQ(dot(cross(a, b), a), 0);
    EXPECT_EQ(dot(cross(a, b), b), 0);
}

TEST(Vec, LengthAndDistanceAreEuclidean) {
    EXPECT_EQ(length(Vec3{2, 3, 6}), 7);
    EXPECT_EQ(distance(Vec3{1, 1, 1}, Vec3{3, 4, 7}), 7);
}

TEST(Vec, ALostSampleIsNotFinite) {
    EXPECT_FALSE(is_finite(lost_sample));
    EXPECT_FALSE(is_finite(Vec3{0, INFINITY, 0}));
    EXPECT_TRUE(is_finite(Vec3{0, 1e308, -1e308}));
}

TEST(Vec, AQuarterTurnAboutYTakesZToX) {
    EXPECT_LT(distance(rotate(quarter_about_y, {0, 0, 2}), {2, 0, 0}), 1e-15);
    EXPECT_LT(distance(rotate(conjugate(quarter_about_y), {2, 0, 0}), {0, 0, 2}), 1e-15);
}

TEST(Vec, APoseTurnsAndThenShifts) {
    const Pose pose{quarter_about_y, {10, 0, 0}};
    EXPECT_LT(distance(apply(pose, {0, 1, 2}), {12, 1, 0}), 1e-14);
    EXPECT_EQ(apply(Pose{}, Vec3{1, 2, 3}), (Vec3{1, 2, 3}));
}

TEST(Vec, FloatsComeBackFromDoublesUnchanged) {
    const Vec3f v{0.1F, -3e7F, 1e-20F};
    EXPECT_EQ(to_float(to_double(v)), v);
}

}  // namespace
}  // namespace mien
