// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/partial.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "refusal.hpp"

#include "mien/error.hpp"

namespace mien {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::vector<std::string> ids{"2.1", "2.2", "3.1", "3.5", "4.1", "5.1", "8.4", "9.1", "9.8", "marker"};

// Column c stands at (c, 0, 0) and after r rows is at (c, r, 10 r) of the step.
Take take_of(const std::vector<std::string>& points, std::vector<double> times = {0, 1, 2}, double step = 1) {
    Take take{points, std::move(times), {}, {}, "mm"};
    for (std::size_t r = 0; r < row_count(take); ++r)
        for (std::size_t c = 0; c < points.size(); ++c)
            take.samples.push_back(
                {static_cast<double>(c), step * static_cast<double>(r), 10 * step * static_cast<double>(r)});
    return take;
}

std::vector<Vec3> rest(const Take& take) {
    const auto first = row(take, 0);
    return {first.begin(), first.end()};
}

std::vector<std::string> moving(const Take& take) {
    std::vector<std::string> result;
    for (std::size_t c = 0; c < take.points.size(); ++c)
        if (row(take, 2)[c] != row(take, 0)[c]) result.push_back(take.points[c]);
    return result;
}

Take part_of(const PartialOptions& options) {
    const Take take = take_of(ids);
    return partial(take, rest(take), options);
}

TEST(Partial, without_options_is_the_take_itself) {
    EXPECT_EQ(part_of({}).samples, take_of(ids).samples);
    EXPECT_EQ(part_of({}).unit, "mm");
}

TEST(Partial, only_the_named_regions_and_points_move) {
    EXPECT_THAT(moving(part_of({{"mouth"}, {}})), ElementsAre("2.2", "8.4"));
    EXPECT_THAT(moving(part_of({{"jaw", "marker"}, {}})), ElementsAre("2.1", "marker"));
    EXPECT_THAT(moving(part_of({{"lids", "brows"}, {}})), ElementsAre("3.1", "4.1"));
    EXPECT_THAT(moving(part_of({{"eyes", "nose", "cheeks"}, {}})), ElementsAre("3.5", "5.1", "9.1"));
}

TEST(Partial, what_is_left_out_stands_at_rest_whatever_else_is_said) {
    const Take out = part_of({{}, {"mouth", "4.1"}, {{"mouth", 3}}});
    EXPECT_THAT(moving(out), ElementsAre("2.1", "3.1", "3.5", "5.1", "9.1", "9.8", "marker"));
    EXPECT_EQ(row(out, 2)[6], row(out, 0)[6]);
}

TEST(Partial, a_strength_scales_the_motion_about_rest_and_moves_nothing_that_is_off) {
    const Take out = part_of({{"mouth"}, {}, {{"mouth", 1.5}, {"8.4", -2}, {"brows", 3}}});
    EXPECT_EQ(row(out, 2)[1], (Vec3{1, 3, 30}));
    EXPECT_EQ(row(out, 2)[6], (Vec3{6, -4, -40}));
    EXPECT_EQ(row(out, 2)[4], row(out, 0)[4]);
}

TEST(Partial, lost_samples_stay_lost) {
    Take take = take_of(ids);
    row(take, 1)[1] = lost_sample;
    const Take out = partial(take, rest(take), {{}, {"mouth"}});
    EXPECT_FALSE(is_finite(row(out, 1)[1]));
    EXPECT_EQ(row(out, 2)[1], row(out, 0)[1]);
}

TEST(Partial, refuses_what_is_no_part_of_the_face_with_the_names_that_are) {
    const std::string said = refusal([] { (void)part_of({{"mouht"}, {}}); });
    EXPECT_THAT(said, HasSubstr("expected one of mouth, jaw, brows, lids, eyes, nose, cheeks or the id"));
    EXPECT_THAT(said, HasSubstr("mouht"));
    EXPECT_THROW((void)part_of({{}, {}, {{"mouth", std::nan("")}}}), Error);
    EXPECT_THROW((void)part_of({{}, {"8.3"}}), Error);
}

TEST(Merged, the_named_parts_come_from_the_other_take_and_the_rest_stays) {
    const Take a = take_of(ids), b = take_of(ids, {0, 1, 2}, 7);
    const std::vector<std::string> parts{"mouth", "4.1"};
    const Take both = merged(a, b, parts);
    for (std::size_t c = 0; c < ids.size(); ++c) {
        const bool other = ids[c] == "2.2" || ids[c] == "8.4" || ids[c] == "4.1";
        EXPECT_EQ(row(both, 2)[c], row(other ? b : a, 2)[c]) << ids[c];
    }
    EXPECT_EQ(both.times, a.times);
}

TEST(Merged, the_other_take_is_read_between_its_rows_and_held_at_its_ends) {
    const Take a = take_of({"4.1", "8.4"}, {0, 0.25, 3}), b = take_of({"8.4"}, {0, 1, 2});
    const std::vector<std::string> parts{"mouth"};
    const Take both = merged(a, b, parts);
    EXPECT_EQ(row(both, 1)[1], (Vec3{0, 0.25, 2.5}));
    EXPECT_EQ(row(both, 2)[1], (Vec3{0, 2, 20}));
}

TEST(Merged, a_sample_lost_in_the_other_take_is_lost_up_to_its_neighbours) {
    const Take a = take_of({"8.4"}, {0, 0.5, 2});
    Take b = take_of({"8.4"}, {0, 1, 2});
    row(b, 1)[0] = lost_sample;
    const std::vector<std::string> parts{"mouth"};
    const Take both = merged(a, b, parts);
    EXPECT_TRUE(is_finite(row(both, 0)[0]));
    EXPECT_FALSE(is_finite(row(both, 1)[0]));
    EXPECT_TRUE(is_finite(row(both, 2)[0]));
}

TEST(Merged, points_that_only_the_other_take_has_come_along_where_they_are_asked_for) {
    const Take a = take_of({"4.1"}), b = take_of({"8.4", "5.1"});
    const std::vector<std::string> parts{"mouth"};
    EXPECT_THAT(merged(a, b, parts).points, ElementsAre("4.1", "8.4"));
}

}  // namespace
}  // namespace mien
