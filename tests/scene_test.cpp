// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// What a scene does over time, against closed forms; tests/io/scene_test.cpp plays whole files beside another player.

#include "mien/scene.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

namespace mien {
namespace {

using Between = Channel::Between;
using Property = Channel::Property;

constexpr double rounding = 1e-6;  // keys are floats

Scene one_node(Channel channel) {
    Scene scene;
    scene.nodes.resize(1);
    scene.nodes[0].morph_weights = {0.25F, 0.5F};
    scene.channels.push_back(std::move(channel));
    return scene;
}

Vec3 offset_at(const Scene& scene, double time) {
    return pose_at(scene, time).worlds.back().offset;
}

// A turn about y by `degrees`, as a file holds it.
std::array<float, 4> about_y(double degrees) {
    const double half = degrees * std::numbers::pi / 360;
    return {0, static_cast<float>(std::sin(half)), 0, static_cast<float>(std::cos(half))};
}

Scene turning(std::array<float, 4> from, std::array<float, 4> to, Between between = Between::linear) {
    Channel channel{0, Property::rotation, between, {0, 1}, {from.begin(), from.end()}};
    channel.values.insert(channel.values.end(), to.begin(), to.end());
    return one_node(channel);
}

// The angle about y that +z has been turned by.
double degrees_at(const Scene& scene, double time) {
    const Vec3 z = turned(pose_at(scene, time).worlds[0], {0, 0, 1});
    return std::atan2(z.x, z.z) * 180 / std::numbers::pi;
}

TEST(Scene, nothing_that_moves_lasts_no_time_and_rests) {
    Scene scene;
    EXPECT_EQ(duration(scene), 0);
    EXPECT_TRUE(pose_at(scene, 1).worlds.empty());
    scene = one_node({0, Property::translation, Between::linear, {}, {}});
    EXPECT_EQ(duration(scene), 0);
    EXPECT_EQ(offset_at(scene, 3), Vec3{});
}

TEST(Scene, lasts_until_the_last_key_of_all_channels) {
    Scene scene = one_node({0, Property::translation, Between::step, {1, 2.5F}, {0, 0, 0, 1, 1, 1}});
    scene.channels.push_back({0, Property::scale, Between::step, {0, 1}, {1, 1, 1, 1, 1, 1}});
    EXPECT_EQ(duration(scene), 2.5);
}

TEST(Scene, a_step_holds_its_key_until_the_next) {
    const Scene scene = one_node({0, Property::translation, Between::step, {1, 2}, {1, 2, 3, 4, 5, 6}});
    EXPECT_EQ(offset_at(scene, 1.999), (Vec3{1, 2, 3}));
    EXPECT_EQ(offset_at(scene, 2), (Vec3{4, 5, 6}));
}

TEST(Scene, a_line_runs_straight_from_key_to_key_and_keys_hold_exactly) {
    const Scene scene = one_node({0, Property::translation, Between::linear, {1, 2, 4}, {1, 2, 3, 5, 2, -1, 5, 0, 1}});
    EXPECT_EQ(offset_at(scene, 1), (Vec3{1, 2, 3}));
    EXPECT_EQ(offset_at(scene, 1.25), (Vec3{2, 2, 2}));
    EXPECT_EQ(offset_at(scene, 2), (Vec3{5, 2, -1}));
    EXPECT_EQ(offset_at(scene, 3.5), (Vec3{5, 0.5, 0.5}));
}

TEST(Scene, the_nearest_key_holds_outside_of_the_keys) {
    for (const Between between : {Between::step, Between::linear}) {
        const Scene scene = one_node({0, Property::translation, between, {1, 2}, {1, 2, 3, 4, 5, 6}});
        EXPECT_EQ(offset_at(scene, -5), (Vec3{1, 2, 3}));
        EXPECT_EQ(offset_at(scene, 0.999), (Vec3{1, 2, 3}));
        EXPECT_EQ(offset_at(scene, 1e9), (Vec3{4, 5, 6}));
        EXPECT_TRUE(is_finite(offset_at(scene, std::numeric_limits<double>::quiet_NaN())));
    }
}

TEST(Scene, one_key_holds_always_and_keys_at_one_time_jump) {
    const Scene one = one_node({0, Property::translation, Between::linear, {2}, {1, 2, 3}});
    for (const double time : {0.0, 2.0, 3.0}) EXPECT_EQ(offset_at(one, time), (Vec3{1, 2, 3}));
    const Scene jump =
        one_node({0, Property::translation, Between::linear, {0, 1, 1, 2}, {0, 0, 0, 1, 0, 0, 5, 0, 0, 6, 0, 0}});
    EXPECT_NEAR(offset_at(jump, 1 - 1e-9).x, 1, 1e-8);
    EXPECT_EQ(offset_at(jump, 1).x, 5);
}

// A cubic polynomial and its derivative at the keys give that polynomial back, whatever the time between the keys.
TEST(Scene, a_spline_with_the_tangents_of_a_cubic_is_that_cubic) {
    const auto f = [](double t) { return Vec3{t * t * t - 2 * t, 3 - t * t, 0.5 * t}; };
    const auto slope = [](double t) { return Vec3{3 * t * t - 2, -2 * t, 0.5}; };
    Channel channel{0, Property::translation, Between::cubic, {1, 1.5F, 3}, {}};
    for (const float key : channel.times)
        for (const Vec3& v : {slope(key), f(key), slope(key)})
            for (const double x : {v.x, v.y, v.z}) channel.values.push_back(static_cast<float>(x));
    const Scene scene = one_node(channel);
    for (const double time : {1.0, 1.125, 1.5, 2.0, 2.75, 3.0})
        EXPECT_LT(distance(offset_at(scene, time), f(time)), 1e-12) << time;
    EXPECT_EQ(offset_at(scene, 0), f(1));
    EXPECT_EQ(offset_at(scene, 9), f(3));
}

// The tangent into a key has no say after it, nor the one out of it before.
TEST(Scene, a_spline_may_have_a_corner_at_a_key) {
    const Scene scene =
        one_node({0, Property::translation, Between::cubic, {0, 1, 2}, {9, 9,  9,  0,  0,  0,  1,  1, 1, 1, 1, 1, 1, 1,
                                                                        1, -1, -1, -1, -1, -1, -1, 0, 0, 0, 9, 9, 9}});
    EXPECT_NEAR(offset_at(scene, 0.25).x, 0.25, 1e-12);
    EXPECT_NEAR(offset_at(scene, 1.25).x, 0.75, 1e-12);
}

TEST(Scene, a_turn_is_even_and_keeps_its_length) {
    const Scene scene = turning(about_y(0), about_y(120));
    for (const double share : {0.0, 0.1, 0.25, 0.5, 0.9, 1.0}) {
        EXPECT_NEAR(degrees_at(scene, share), 120 * share, 1e-4);
        EXPECT_NEAR(determinant(pose_at(scene, share).worlds[0]), 1, rounding);
    }
}

// Both signs of a quaternion are one turn: the way from 10 to 350 degrees goes back over 0.
TEST(Scene, a_turn_takes_the_short_way) {
    EXPECT_NEAR(degrees_at(turning(about_y(10), about_y(350)), 0.25), 5, 1e-4);
    std::array<float, 4> other = about_y(50);
    for (float& x : other) x = -x;
    EXPECT_NEAR(degrees_at(turning(about_y(10), other), 0.25), 20, 1e-4);
}

TEST(Scene, a_turn_between_equal_keys_stands_still) {
    EXPECT_NEAR(degrees_at(turning(about_y(30), about_y(30)), 0.5), 30, 1e-4);
    std::array<float, 4> other = about_y(30);
    for (float& x : other) x = -x;
    EXPECT_NEAR(degrees_at(turning(about_y(30), other), 0.5), 30, 1e-4);
    EXPECT_NEAR(degrees_at(turning(about_y(30), about_y(30.00001)), 0.5), 30, 1e-4);
}

TEST(Scene, a_turn_by_steps_and_one_of_odd_length_are_turns) {
    EXPECT_NEAR(degrees_at(turning(about_y(30), about_y(90), Between::step), 0.9), 30, 1e-4);
    const Scene twice = turning({0, 0, 0, 2}, {0, 3, 0, 3});
    EXPECT_NEAR(degrees_at(twice, 0.5), 45, 1e-4);
    EXPECT_NEAR(determinant(pose_at(twice, 0).worlds[0]), 1, rounding);
    EXPECT_EQ(pose_at(turning({0, 0, 0, 0}, {0, 0, 0, 0}), 0).worlds[0], Affine{});
}

// Without tangents a spline goes from key to key along the chord, slowly at both ends; the result is a turn all the
// same.
TEST(Scene, a_spline_of_turns_is_a_turn) {
    const std::array<float, 4> a = about_y(0), b = about_y(90);
    Channel channel{0, Property::rotation, Between::cubic, {0, 2}, {}};
    for (const auto& key : {a, b}) {
        channel.values.insert(channel.values.end(), 4, 0.0F);
        channel.values.insert(channel.values.end(), key.begin(), key.end());
        channel.values.insert(channel.values.end(), 4, 0.0F);
    }
    const Scene scene = one_node(channel);
    EXPECT_NEAR(degrees_at(scene, 1), 45, 1e-4);
    EXPECT_LT(degrees_at(scene, 0.5), 22);
    EXPECT_NEAR(determinant(pose_at(scene, 0.5).worlds[0]), 1, rounding);
}

TEST(Scene, weights_of_morphs_move_and_rest) {
    const Scene scene = one_node({0, Property::morph_weights, Between::linear, {0, 1}, {0, 1, 1, -1}});
    EXPECT_THAT(pose_at(scene, 0.25).morph_weights[0], testing::ElementsAre(0.25F, 0.5F));
    EXPECT_THAT(pose_at(scene, 1).morph_weights[0], testing::ElementsAre(1, -1));
    EXPECT_THAT(rest_pose(scene).morph_weights[0], testing::ElementsAre(0.25F, 0.5F));
}

Scene chain() {
    Scene scene;
    scene.nodes.resize(3);
    scene.nodes[0].translation = {1, 0, 0};
    scene.nodes[0].rotation = {0, std::sqrt(0.5), 0, std::sqrt(0.5)};  // +z to +x
    scene.nodes[1].parent = 0;
    scene.nodes[1].scale = {2, 3, 4};
    scene.nodes[2].parent = 1;
    scene.nodes[2].matrix = Affine{{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, -1}}, {0, 0, 5}};
    return scene;
}

TEST(Scene, a_child_goes_where_its_parent_takes_it_by_scale_then_turn_then_shift) {
    const std::vector<Affine> worlds = rest_pose(chain()).worlds;
    EXPECT_LT(distance(moved(worlds[0], {0, 0, 1}), {2, 0, 0}), rounding);
    EXPECT_LT(distance(moved(worlds[1], {0, 0, 1}), {5, 0, 0}), rounding);
    EXPECT_LT(distance(moved(worlds[1], {0, 1, 0}), {1, 3, 0}), rounding);
    EXPECT_LT(distance(moved(worlds[2], {0, 0, 1}), {17, 0, 0}), rounding);
}

TEST(Scene, what_no_channel_moves_rests_beside_what_moves) {
    Scene scene = chain();
    scene.channels.push_back({1, Property::scale, Between::linear, {0, 1}, {1, 1, 1, 3, 3, 3}});
    const ScenePose pose = pose_at(scene, 0.5);
    EXPECT_EQ(pose.worlds[0], rest_pose(scene).worlds[0]);
    EXPECT_LT(distance(moved(pose.worlds[1], {0, 0, 1}), {3, 0, 0}), rounding);
    EXPECT_LT(distance(pose.worlds[2].offset, {11, 0, 0}), rounding);
}

TEST(Scene, a_joint_moves_what_is_bound_to_it_from_where_it_was_bound) {
    Scene scene = chain();
    SceneSkin skin{{2, 0}, {Affine{}, Affine{}}};
    skin.inverse_binds[1].offset = {-1, 0, 0};
    const ScenePose pose = rest_pose(scene);
    const std::vector<Affine> maps = joint_maps(scene, skin, pose);
    ASSERT_EQ(maps.size(), 2U);
    EXPECT_EQ(maps[0], pose.worlds[2]);
    EXPECT_LT(distance(moved(maps[1], {1, 0, 2}), {3, 0, 0}), rounding);
}

}  // namespace
}  // namespace mien
