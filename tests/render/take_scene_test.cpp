// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/render/take_scene.hpp"

#include <gtest/gtest.h>

#include "mien/error.hpp"

namespace mien {
namespace {

Take two_markers() {
    return {{"chin", "brow"},
            {0, 1, 2},
            {{0, 0, 0}, {0, 10, 0}, {0, -2, 0}, lost_sample, {0, -4, 1}, {0, 11, 0}},
            {},
            "mm"};
}

TEST(TakeScene, ABallStandsWhereItsSampleIs) {
    const Scene scene = scene_of(two_markers());
    ASSERT_EQ(scene.nodes.size(), 2U);
    EXPECT_EQ(scene.nodes[0].name, "chin");
    EXPECT_DOUBLE_EQ(duration(scene), 2);
    EXPECT_EQ(pose_at(scene, 1).worlds[0].offset, (Vec3{0, -2, 0}));
    EXPECT_EQ(pose_at(scene, 1.5).worlds[0].offset, (Vec3{0, -3, 0.5}));
    EXPECT_EQ(rest_pose(scene).worlds[1].offset, (Vec3{0, 10, 0}));
}

TEST(TakeScene, ALostSampleHasNoBall) {
    const Scene scene = scene_of(two_markers(), 0.1);
    const auto radius = [&](double time) { return length(pose_at(scene, time).worlds[1].columns[0]); };
    EXPECT_NEAR(radius(0.9), 1, 1e-6);  // a tenth of the distance of the two
    EXPECT_EQ(radius(1.1), 0);
    EXPECT_NEAR(radius(2), 1, 1e-6);
}

TEST(TakeScene, BallsAreClosedAndFaceOutwards) {
    const Surface ball = scene_of(two_markers()).surfaces[0];
    double volume = 0;
    for (std::size_t i = 0; i < ball.triangles.size(); i += 3) {
        const auto corner = [&](std::size_t k) { return to_double(ball.positions[ball.triangles[i + k]]); };
        volume += dot(corner(0), cross(corner(1), corner(2))) / 6;
    }
    EXPECT_NEAR(volume, 4.0 / 3 * 3.14159, 0.25);
}

TEST(TakeScene, RefusesATakeOfWhichNothingIsSeen) {
    EXPECT_THROW((void)scene_of(Take{}), Error);
    EXPECT_THROW((void)scene_of(Take{{"chin"}, {0}, {lost_sample}, {}, "mm"}), Error);
}

}  // namespace
}  // namespace mien
