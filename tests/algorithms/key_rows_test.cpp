// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/key_rows.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mien/error.hpp"

namespace mien {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// One point at these places on a line.
std::vector<Vec3f> on_a_line(std::initializer_list<float> places) {
    std::vector<Vec3f> rows;
    for (const float x : places) rows.push_back({x, 0, 0});
    return rows;
}

TEST(KeyRows, RefuseRowsThatAreNotWhole) {
    EXPECT_THROW((void)key_rows(on_a_line({1, 2, 3}), 2, 1), Error);
    EXPECT_THROW((void)key_rows({}, 0, 1), Error);
}

TEST(KeyRows, AreTheFirstAndThenTheFarthestFromAllChosen) {
    // From 0 the farthest is 10; from both, -4 (4 away) before 6 (4 away, but later); then 6.
    const auto rows = on_a_line({0, 1, -4, 10, 6, 9});
    EXPECT_THAT(key_rows(rows, 1, 1), ElementsAre(0));
    EXPECT_THAT(key_rows(rows, 1, 2), ElementsAre(0, 3));
    EXPECT_THAT(key_rows(rows, 1, 3), ElementsAre(0, 2, 3));
    EXPECT_THAT(key_rows(rows, 1, 4), ElementsAre(0, 2, 3, 4));
}

TEST(KeyRows, CopiesOfChosenRowsAreNotShownTwice) {
    EXPECT_THAT(key_rows(on_a_line({2, 2, 5, 2, 5}), 1, 4), ElementsAre(0, 2));
    EXPECT_THAT(key_rows({}, 1, 4), IsEmpty());
}

TEST(KeyRows, DoNotDependOnWhereTheFaceStandsOrHowLargeItIs) {
    std::vector<Vec3f> small, large;
    for (int i = 0; i < 40; ++i) {
        const Vec3f p{static_cast<float>(i * i % 17), static_cast<float>(i * 7 % 13), static_cast<float>(i % 5)};
        small.push_back(p);
        large.push_back(64.0F * p + Vec3f{128, -64, 32});
    }
    EXPECT_EQ(key_rows(small, 2, 6), key_rows(large, 2, 6));
}

TEST(KeyRows, LostPointsCountAsNotMoved) {
    std::vector<Vec3f> rows = on_a_line({0, 1, 3});
    rows[1] = to_float(lost_sample);
    EXPECT_THAT(key_rows(rows, 1, 3), ElementsAre(0, 2));
}

}  // namespace
}  // namespace mien
