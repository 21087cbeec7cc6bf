// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/take.hpp"

#include <gtest/gtest.h>

#include "mien/error.hpp"

namespace mien {
namespace {

Take two_markers() {
    return {{"chin", "brow"}, {0, 0.5}, {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {10, 11, 12}}, {}, "mm", false};
}

TEST(Take, frame_rate_is_the_inverse_of_the_median_step) {
    EXPECT_DOUBLE_EQ(frame_rate(two_markers()), 2);
    EXPECT_DOUBLE_EQ(frame_rate(Take{}), 0);
}

TEST(Take, renaming_keeps_the_samples_of_the_columns_it_names) {
    const Rename names[] = {{"chin", "2.1"}, {"brow", ""}};
    Take take = two_markers();
    take.repeated_rows = 1;
    const Take renamed = rename_points(take, names);
    ASSERT_EQ(renamed.points, std::vector<std::string>{"2.1"});
    EXPECT_EQ(renamed.samples, (std::vector<Vec3>{{1, 2, 3}, {7, 8, 9}}));
    EXPECT_EQ(renamed.unit, "mm");
    EXPECT_EQ(renamed.repeated_rows, 1U);
}

TEST(Take, renaming_two_columns_to_one_id_is_refused) {
    const Rename names[] = {{"chin", "2.1"}, {"brow", "2.1"}};
    EXPECT_THROW(rename_points(two_markers(), names), Error);
}

TEST(Take, BetweenRowsItIsLinearAndBeyondThemItHolds) {
    Take take{{"a", "b"}, {1, 3, 4}, {{0, 0, 0}, {5, 5, 5}, {4, 8, -2}, lost_sample, {4, 8, 2}, {1, 1, 1}}, {}, "m"};
    EXPECT_EQ(frame_at(take, 0).points[0], (Vec3{0, 0, 0}));
    EXPECT_EQ(frame_at(take, 1).points[1], (Vec3{5, 5, 5}));
    EXPECT_EQ(frame_at(take, 1.5).points[0], (Vec3{1, 2, -0.5}));
    EXPECT_EQ(frame_at(take, 3).points[0], (Vec3{4, 8, -2}));
    EXPECT_EQ(frame_at(take, 9).points[1], (Vec3{1, 1, 1}));
    EXPECT_FALSE(is_finite(frame_at(take, 2).points[1]));
    EXPECT_FALSE(is_finite(frame_at(take, 3.5).points[1]));
    take.head = {{{}, {1, 0, 0}}, {{}, {2, 0, 0}}, {{}, {3, 0, 0}}};
    EXPECT_EQ(frame_at(take, 1.9).head.translation.x, 1);
    EXPECT_EQ(frame_at(take, 2.1).head.translation.x, 2);
    EXPECT_THROW((void)frame_at(Take{}, 0), Error);
}

}  // namespace
}  // namespace mien
