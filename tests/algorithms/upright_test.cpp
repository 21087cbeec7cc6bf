// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/upright.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "algorithms/fap_face.hpp"
#include "algorithms/rotation.hpp"
#include "slit_mask.hpp"

namespace mien {
namespace {

Take resting() {
    Take take;
    take.times = {0};
    for (const FeaturePoint& point : neutral_points()) {
        take.points.push_back(point.id);
        take.samples.push_back(point.position);
    }
    return take;
}

Take turned(Take take, const Quaternion& turn) {
    for (Vec3& sample : take.samples) sample = rotate(turn, sample);
    return take;
}

Quaternion about(const Vec3& axis, double degrees) {
    const double half = degrees * std::numbers::pi / 360;
    return {std::sin(half) * axis.x, std::sin(half) * axis.y, std::sin(half) * axis.z, std::cos(half)};
}

double degrees_between(const Quaternion& a, const Quaternion& b) {
    return 360 / std::numbers::pi * std::acos(std::min(1.0, std::abs((conjugate(a) * b).w)));
}

TEST(Upright, AFaceThatIsTurnedAndLeansComesBackToItsAxes) {
    const Quaternion turn = about({0, 1, 0}, 25) * about({0, 0, 1}, -10);
    const Take take = turned(resting(), turn);
    const auto found = face_turn(take);
    ASSERT_TRUE(found);
    EXPECT_LT(degrees_between(*found, turn), 0.1);
    const Take back = upright(take, *found);
    for (std::size_t c = 0; c < back.points.size(); ++c)
        EXPECT_LT(distance(back.samples[c], resting().samples[c]), 0.3) << back.points[c];
}

TEST(Upright, ASmallNodIsThatOfTheCapture) {
    const auto found = face_turn(turned(resting(), about({1, 0, 0}, 8)));
    ASSERT_TRUE(found);
    EXPECT_LT(degrees_between(*found, {}), 0.1);
}

TEST(Upright, ACaptureWithAnotherAxisForUpIsSetUpright) {
    const Take take = turned(resting(), about({1, 0, 0}, 90));  // z up
    const auto found = face_turn(take);
    ASSERT_TRUE(found);
    EXPECT_LT(degrees_between(*found, about({1, 0, 0}, 90)), 15);
}

TEST(Upright, HeadPosesTurnAlong) {
    Take take = turned(resting(), about({0, 1, 0}, 30));
    const Quaternion turn = about({0, 1, 0}, 30);
    take.head = {{about({1, 0, 0}, 20), {1, 2, 3}}};
    const Take back = upright(take, turn);
    const Vec3 captured = apply(take.head[0], take.samples[0]);
    EXPECT_LT(distance(apply(back.head[0], back.samples[0]), rotate(conjugate(turn), captured)), 1e-9);
}

TEST(Upright, LostSamplesStayLost) {
    Take take = resting();
    take.samples[3] = lost_sample;
    EXPECT_TRUE(std::isnan(upright(take, about({0, 1, 0}, 30)).samples[3].x));
}

TEST(Upright, TooFewPointsTellNothing) {
    Take take;
    take.points = {"8.3", "8.4", "dimple"};
    take.times = {0};
    take.samples = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}};
    EXPECT_FALSE(face_turn(take));
}

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
