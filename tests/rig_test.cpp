// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/rig.hpp"

#include <gtest/gtest.h>

namespace mien {
namespace {

// Two points, the second constrained to x; a vertex 1 under it that point 0 carries halfway along y.
Rig two_points() {
    Rig rig;
    rig.points = {{"8.1", 0, {0, 0, 0}, {}, 0}, {"2.1", 1, {2, 0, 0}, {true, false, false}, 0}};
    rig.rest = {{0, 0, 0}, {2, 0, 0}};
    rig.row_starts = {0, 1, 3};
    rig.row_points = {0, 0, 1};
    rig.weights = {{1, 1, 1}, {0, 0.5F, 0.25F}, {1, 0, 0}};
    return rig;
}

Rig with_eyeball(std::optional<std::uint32_t> aim) {
    Rig rig = two_points();
    rig.points.push_back({"3.5", 0, {0, 0, 1}, {}, 0});
    rig.eyeballs = {{"eye", {}, {0, 0, 0}, aim}};
    return rig;
}

TEST(BindTake, finds_columns_by_id_and_lists_what_is_left_over) {
    const Take take{{"9.1", "2.1"}, {0}, {{}, {}}, {}, "", false};
    const TakeBinding binding = bind_take(two_points(), take);
    EXPECT_EQ(binding.columns, (std::vector<std::int32_t>{-1, 1}));
    EXPECT_EQ(binding.missing, std::vector<std::string>{"8.1"});
    EXPECT_EQ(binding.unused, std::vector<std::string>{"9.1"});
}

TEST(Displacements, hold_a_lost_point_and_an_undriven_one_at_neutral) {
    const Rig rig = two_points();
    const Take take{{"2.1"}, {0, 1}, {{3, 1, 0}, lost_sample}, {}, "", false};
    std::vector<Vec3f> moved(2, Vec3f{9, 9, 9});
    displacements(rig, bind_take(rig, take), row(take, 0), moved);
    EXPECT_EQ(moved, (std::vector<Vec3f>{{0, 0, 0}, {1, 1, 0}}));
    displacements(rig, bind_take(rig, take), row(take, 1), moved);
    EXPECT_EQ(moved, (std::vector<Vec3f>{{0, 0, 0}, {0, 0, 0}}));
}

// An eyeball of radius 1 round the origin under two lids of different thickness.
Rig with_lids() {
    Rig rig;
    rig.points = {{"3.1", 0, 1.2 * Vec3{0, 0.6, 0.8}, {}, 0}, {"3.3", 1, 1.1 * Vec3{0, -0.6, 0.8}, {}, 0}};
    rig.rest = {{}, {}, {1, 0, 0}, {-1, 0, 0}, {0, 0, 1}};
    rig.row_starts = {0, 0, 0, 0, 0, 0};
    rig.eyeballs = {{"eye", {2, 3, 4}, {0, 0, 0}, {}}};
    return rig;
}

// The rig's points when the take's are at these places.
std::vector<Vec3> places(const Rig& rig, const Vec3& upper, const Vec3& lower) {
    const Take take{{rig.points[0].id, rig.points[1].id}, {0}, {upper, lower}, {}, "", false};
    std::vector<Vec3f> moved(2);
    displacements(rig, bind_take(rig, take), row(take, 0), moved);
    return {rig.points[0].position + to_double(moved[0]), rig.points[1].position + to_double(moved[1])};
}

// The margins of the lids, or their borders, which are all that a take may have.
TEST(Lids, slide_over_the_eyeball_where_the_straight_way_leads_through_it) {
    Rig rig = with_lids();
    const Vec3 up = rig.points[0].position, low = rig.points[1].position;
    for (const auto& [upper, lower] : {std::pair{"3.1", "3.3"}, {"3.2", "3.4"}, {"3.13", "3.9"}, {"3.14", "3.10"}}) {
        rig.points[0].id = upper;
        rig.points[1].id = lower;
        for (const double closed : {0.1, 0.3, 0.5, 0.7, 0.9}) {
            const Vec3 lid = places(rig, (1 - closed) * up + closed * low, low)[0];
            EXPECT_GE(length(lid), 1.1 - 1e-6) << upper << closed;
            EXPECT_LE(length(lid), 1.2 + 1e-6) << upper << closed;
        }
    }
}

TEST(Lids, that_meet_on_the_take_meet_over_the_eyeball) {
    const Rig rig = with_lids();
    const std::vector<Vec3> met = places(rig, {0, -0.2, 0.6}, {0, -0.2, 0.6});
    EXPECT_LT(distance(met[0], met[1]), 1e-6);
    EXPECT_GT(length(met[0]), 1.1);
}

TEST(Lids, rest_and_open_wide_as_told) {
    const Rig rig = with_lids();
    const Vec3 up = rig.points[0].position, low = rig.points[1].position;
    EXPECT_EQ(places(rig, up, low), (std::vector<Vec3>{up, low}));
    EXPECT_LT(distance(places(rig, {0, 1, 1}, low)[0], {0, 1, 1}), 1e-6);
}

TEST(Lids, go_as_told_where_there_is_no_eyeball_behind_them) {
    Rig rig = with_lids();
    rig.eyeballs[0].centre = {0, 0, -5};
    rig.rest = {{}, {}, {1, 0, -5}, {-1, 0, -5}, {0, 0, -4}};
    EXPECT_LT(length(places(rig, {0, 0, 0.5}, rig.points[1].position)[0] - Vec3{0, 0, 0.5}), 1e-6);
}

Rig with_lips() {
    Rig rig;
    rig.points = {{"8.1", 0, {0, 1, 0}, {}, 0},
                  {"2.2", 1, {0, 0.1, 0}, {}, 0},
                  {"2.3", 2, {}, {}, 0},
                  {"8.2", 3, {0, -1, 0}, {}, 0}};
    rig.rest.resize(4);
    rig.row_starts = {0, 0, 0, 0, 0};
    return rig;
}

// The two inner lip points when the take's are at these heights.
std::vector<double> inner_lips(double upper, double lower) {
    const Rig rig = with_lips();
    const Take take{{"2.2", "2.3"}, {0}, {{0.2, upper, 0}, {0, lower, 0}}, {}, "", false};
    std::vector<Vec3f> moved(4);
    displacements(rig, bind_take(rig, take), row(take, 0), moved);
    EXPECT_NEAR(moved[1].x, 0.2, 1e-6);
    EXPECT_EQ(moved[0], Vec3f{});
    return {rig.points[1].position.y + moved[1].y, rig.points[2].position.y + moved[2].y};
}

TEST(Lips, that_would_cross_meet_halfway) {
    const std::vector<double> lips = inner_lips(-0.2, 0.4);
    EXPECT_NEAR(lips[0], 0.1, 1e-6);
    EXPECT_NEAR(lips[1], 0.1, 1e-6);
}

TEST(Lips, that_open_or_just_meet_go_as_told) {
    for (const auto& [upper, lower] : {std::pair{0.5, -0.7}, std::pair{0.1, 0.0}, std::pair{0.3, 0.3}}) {
        EXPECT_NEAR(inner_lips(upper, lower)[0], upper, 1e-6);
        EXPECT_NEAR(inner_lips(upper, lower)[1], lower, 1e-6);
    }
}

TEST(JointPoses, move_free_points_as_told_and_constrained_ones_as_their_vertex) {
    const Rig rig = two_points();
    std::vector<Pose> poses(joint_count(rig), Pose{{}, {9, 9, 9}});
    joint_poses(rig, std::vector<Vec3f>{{1, 2, 4}, {3, 7, 7}}, poses);
    EXPECT_EQ(poses[0].translation, (Vec3{1, 2, 4}));
    EXPECT_EQ(poses[1].translation, (Vec3{3, 1, 1}));  // y: half of 2, z: a quarter of 4
    EXPECT_EQ(poses[2], Pose{});
}

TEST(JointPoses, turn_an_eyeball_so_that_it_looks_where_its_point_went) {
    const Rig rig = with_eyeball(2);
    std::vector<Pose> poses(joint_count(rig));
    joint_poses(rig, std::vector<Vec3f>{{}, {}, {1, 0, 0}}, poses);
    const Vec3 gaze = rotate(poses[4].rotation, {0, 0, 1});
    EXPECT_NEAR(gaze.x, std::sqrt(0.5), 1e-12);
    EXPECT_NEAR(gaze.y, 0, 1e-12);
    EXPECT_NEAR(gaze.z, std::sqrt(0.5), 1e-12);
    EXPECT_EQ(joint_origin(rig, 4), rig.eyeballs[0].centre);
}

TEST(EyeballTurn, is_none_without_a_point_or_where_no_shortest_turn_exists) {
    const std::vector<Vec3f> back{{}, {}, {0, 0, -2}}, centre{{}, {}, {0, 0, -1}};
    EXPECT_EQ(eyeball_turn(with_eyeball({}), with_eyeball({}).eyeballs[0], back), Quaternion{});
    EXPECT_EQ(eyeball_turn(with_eyeball(2), with_eyeball(2).eyeballs[0], back), Quaternion{});
    EXPECT_EQ(eyeball_turn(with_eyeball(2), with_eyeball(2).eyeballs[0], centre), Quaternion{});
}

}  // namespace
}  // namespace mien
