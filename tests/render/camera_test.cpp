// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/render/camera.hpp"

#include <array>
#include <gtest/gtest.h>
#include <limits>

#include "mien/error.hpp"

namespace mien {
namespace {

constexpr Box box{{-1, -2, -0.5}, {3, 2, 1.5}};

std::vector<Vec3> corners() {
    std::vector<Vec3> list;
    for (const double x : {box.low.x, box.high.x})
        for (const double y : {box.low.y, box.high.y})
            for (const double z : {box.low.z, box.high.z}) list.push_back({x, y, z});
    return list;
}

TEST(Camera, TheMiddleOfTheBoxIsInTheMiddleOfThePicture) {
    for (const View view : {View::front, View::side, View::three_quarter}) {
        const auto seen = project(frame(box, view, 640, 480), {1, 0, 0.5});
        ASSERT_TRUE(seen);
        EXPECT_NEAR(seen->x, 320, 1e-9);
        EXPECT_NEAR(seen->y, 240, 1e-9);
    }
}

TEST(Camera, TheBoxFillsThePictureUpToTheMargin) {
    for (const View view : {View::front, View::side, View::three_quarter})
        for (const auto& [width, height] : {std::pair{640U, 480U}, {200U, 700U}}) {
            double share = 0;
            for (const Vec3& corner : corners()) {
                const auto seen = project(frame(box, view, width, height, 0.1), corner);
                ASSERT_TRUE(seen);
                share = std::max({share, std::abs(seen->x / width - 0.5), std::abs(seen->y / height - 0.5)});
            }
            EXPECT_NEAR(share, 0.4, 1e-9);
        }
}

TEST(Camera, FromTheFrontTheSubjectsLeftIsOnTheRightAndUpIsUp) {
    const Camera camera = frame(box, View::front, 640, 480);
    EXPECT_GT(project(camera, {2, 0, 0.5})->x, 320);
    EXPECT_LT(project(camera, {1, 1, 0.5})->y, 240);
}

TEST(Camera, FromTheSideTheFaceLooksToTheLeft) {
    const Camera camera = frame(box, View::side, 640, 480);
    EXPECT_LT(project(camera, {1, 0, 1.5})->x, 320);
    EXPECT_LT(project(camera, {3, 0, 0.5})->depth, project(camera, {-1, 0, 0.5})->depth);
}

TEST(Camera, WhatLiesBehindIsNotSeen) {
    EXPECT_FALSE(project(frame(box, View::front, 640, 480), {0, 0, 1e6}));
}

TEST(Camera, APointHasAPictureToo) {
    const Camera camera = frame({{5, 5, 5}, {5, 5, 5}}, View::front, 10, 10);
    EXPECT_EQ(distance(camera.eye, camera.target), 1);
}

TEST(Camera, RefusesAPictureWithoutPixelsAndABoxWithoutEnd) {
    EXPECT_THROW(frame(box, View::front, 0, 480), Error);
    EXPECT_THROW(frame({{}, {std::numeric_limits<double>::infinity(), 0, 0}}, View::front, 640, 480), Error);
}

}  // namespace
}  // namespace mien
