// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/check_shapes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "slit_mask.hpp"

#include "mien/error.hpp"

namespace mien {
namespace {

// The upper edge of the left eye, or its lower one, moved up by `up`.
MorphTarget lid(const char* name, bool upper, float up) {
    const Face face = shapes::slit_mask();
    const std::uint32_t lower = face.points[*find_point(face.points, "3.3")].vertex - 3;
    MorphTarget shape{name, {}, {}};
    for (std::uint32_t i = 0; i < 7; ++i) {
        shape.vertices.push_back(upper ? 32 * 49 + 29 + i : lower + i);
        shape.deltas.push_back({0, up, 0});
    }
    return shape;
}

TEST(CheckShapes, a_lid_that_goes_half_the_way_leaves_half_open) {
    const Face face = shapes::slit_mask();
    const double height = face.points[*find_point(face.points, "3.1")].position.y -
                          face.points[*find_point(face.points, "3.3")].position.y;
    const MorphTarget half = lid("eyeBlinkLeft", true, static_cast<float>(-height / 2));
    const auto check = check_shapes(face, std::vector{half});
    ASSERT_TRUE(check.blink_left);
    EXPECT_NEAR(check.blink_left->most, 0.5, 0.02);
    EXPECT_FALSE(check.blink_right);
}

TEST(CheckShapes, lids_that_cross_are_open_by_less_than_nothing) {
    const Face face = shapes::slit_mask();
    const double height = face.points[*find_point(face.points, "3.1")].position.y -
                          face.points[*find_point(face.points, "3.3")].position.y;
    const auto check = check_shapes(face, std::vector{lid("eyeBlinkLeft", false, static_cast<float>(1.5 * height))});
    EXPECT_NEAR(check.blink_left->least, -1.2, 0.3);  // the ends, which were open least, cross most
}

TEST(CheckShapes, the_upper_lips_share_is_what_it_moves_of_the_lowers_way) {
    const Face face = shapes::slit_mask();
    const std::uint32_t upper = face.points[*find_point(face.points, "2.2")].vertex;
    const std::uint32_t lower = face.points[*find_point(face.points, "2.3")].vertex;
    const MorphTarget open{"jawOpen", {upper, lower}, {Vec3f{0, -0.1F, 0}, Vec3f{0, -0.4F, 0}}};
    EXPECT_NEAR(check_shapes(face, std::vector{open}).upper_lip.value(), 0.25, 1e-6);
}

TEST(CheckShapes, a_mouth_that_opens_and_closes_by_the_same_is_closed) {
    const Face face = shapes::slit_mask();
    const std::uint32_t lower = face.points[*find_point(face.points, "2.3")].vertex - 5;
    MorphTarget open{"jawOpen", {}, {}}, close{"mouthClose", {}, {}};
    for (std::uint32_t i = 0; i < 11; ++i) {
        open.vertices.push_back(lower + i), open.deltas.push_back({0, -0.2F, 0});
        close.vertices.push_back(lower + i), close.deltas.push_back({0, 0.15F, 0});
    }
    EXPECT_NEAR(check_shapes(face, std::vector{open, close}).closed_jaw->most, 0.25, 0.01);
    for (Vec3f& delta : close.deltas) delta.y = 0.2F;
    EXPECT_NEAR(check_shapes(face, std::vector{open, close}).closed_jaw->most, 0, 1e-5);
}

TEST(CheckShapes, faces_that_turn_over_are_counted_and_the_worst_shape_named) {
    const Face face = shapes::slit_mask();
    MorphTarget calm{"calm", {}, {}}, mirrored{"mirrored", {}, {}};
    for (std::uint32_t v = 0; v < face.mesh.positions.size(); ++v) {
        calm.vertices.push_back(v), calm.deltas.push_back({0, 0, 0.1F});
        mirrored.vertices.push_back(v), mirrored.deltas.push_back({-2 * face.mesh.positions[v].x, 0, 0});
    }
    const ShapesCheck check = check_shapes(face, std::vector{calm, mirrored});
    EXPECT_EQ(check.most_flipped, "mirrored");
    EXPECT_EQ(check.most_flipped_share, 1);
    EXPECT_NEAR(check.flipped, 0.5, 1e-9);
}

TEST(CheckShapes, refuses_a_vertex_that_the_head_does_not_have) {
    const MorphTarget wrong{"jawOpen", {1U << 20}, {Vec3f{}}};
    EXPECT_THROW((void)check_shapes(shapes::slit_mask(), std::vector{wrong}), Error);
}

}  // namespace
}  // namespace mien
