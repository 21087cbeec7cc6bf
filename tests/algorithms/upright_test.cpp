// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/upright.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "slit_mask.hpp"

namespace mien {
namespace {

Face turned(Face face, const Quaternion& turn) {
    for (FeaturePoint& point : face.points) point.position = rotate(turn, point.position);
    return face;
}

TEST(Upright, a_face_turned_by_q_lies_turned_by_q) {
    const Face face = shapes::slit_mask();
    const Quaternion quarter{0, -std::sqrt(0.5), 0, std::sqrt(0.5)};
    const auto before = face_turn(face.points);
    const auto after = face_turn(turned(face, quarter).points);
    ASSERT_TRUE(before && after);
    for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}})
        EXPECT_NEAR(distance(rotate(*after, axis), rotate(quarter, rotate(*before, axis))), 0, 1e-9);
}

TEST(Upright, a_symmetric_face_looks_straight_ahead_to_the_side) {
    const auto turn = face_turn(shapes::slit_mask().points);
    ASSERT_TRUE(turn);
    EXPECT_NEAR(rotate(*turn, {1, 0, 0}).x, 1, 1e-9);
}

TEST(Upright, two_points_do_not_say) {
    Face face = shapes::slit_mask();
    face.points.resize(2);
    EXPECT_FALSE(face_turn(face.points));
}

TEST(Upright, points_that_no_standard_names_do_not_say) {
    Face face = shapes::slit_mask();
    for (FeaturePoint& point : face.points) point.id = "mine " + point.id;
    EXPECT_FALSE(face_turn(face.points));
}

}  // namespace
}  // namespace mien
