// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/affine.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace mien {
namespace {

constexpr Affine shear{{Vec3{1, 2, 0}, Vec3{0, 3, 0}, Vec3{0, 0, -1}}, {5, 6, 7}};
constexpr Affine turn{{Vec3{0, 1, 0}, Vec3{-1, 0, 0}, Vec3{0, 0, 1}}, {1, 0, 0}};

TEST(Affine, a_point_is_offset_and_a_direction_is_not) {
    EXPECT_EQ(moved(shear, {1, 1, 1}), (Vec3{6, 11, 6}));
    EXPECT_EQ(turned(shear, {1, 1, 1}), (Vec3{1, 5, -1}));
}

TEST(Affine, a_product_does_the_right_map_first) {
    const Vec3 p{1, -2, 4};
    EXPECT_EQ(moved(shear * turn, p), moved(shear, moved(turn, p)));
    EXPECT_NE(moved(shear * turn, p), moved(turn, moved(shear, p)));
    EXPECT_EQ(shear * Affine{}, shear);
    EXPECT_EQ(Affine{} * shear, shear);
}

TEST(Affine, a_map_of_parts_scales_then_turns_then_shifts) {
    const Affine map = affine_map({10, 0, 0}, {0, 0, std::sqrt(0.5), std::sqrt(0.5)}, {2, 3, 4});  // +x to +y
    EXPECT_LT(distance(moved(map, {1, 0, 0}), {10, 2, 0}), 1e-14);
    EXPECT_LT(distance(moved(map, {0, 1, 1}), {7, 0, 4}), 1e-14);
}

TEST(Affine, the_determinant_is_the_volume_of_a_unit_cube_and_negative_when_mirrored) {
    EXPECT_EQ(determinant(Affine{}), 1);
    EXPECT_EQ(determinant(shear), -3);
    EXPECT_EQ(determinant(shear * turn), determinant(shear) * determinant(turn));
}

}  // namespace
}  // namespace mien
