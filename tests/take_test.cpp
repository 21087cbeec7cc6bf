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

}  // namespace
}  // namespace mien
