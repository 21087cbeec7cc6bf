// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/tracks.hpp"

#include <cmath>
#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numbers>

#include "refusal.hpp"

#include "mien/error.hpp"

namespace mien {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// One column called "a", sampled at even times from a function of time.
Take track(std::size_t rows, double rate, const std::function<Vec3(double)>& f) {
    Take take{.points = {"a"}, .times = {}, .samples = {}, .head = {}, .unit = "mm"};
    for (std::size_t r = 0; r < rows; ++r) {
        take.times.push_back(static_cast<double>(r) / rate);
        take.samples.push_back(f(take.times.back()));
    }
    return take;
}

Take lose(Take take, std::size_t first, std::size_t end, std::size_t column = 0) {
    for (std::size_t r = first; r < end; ++r) row(take, r)[column] = lost_sample;
    return take;
}

Vec3 rest(double) {
    return {1, 2, 3};
}

double largest_difference(const Take& a, const Take& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.samples.size(); ++i)
        if (is_finite(a.samples[i]) || is_finite(b.samples[i])) {
            const double d = distance(a.samples[i], b.samples[i]);
            largest = std::isnan(d) ? d : std::max(largest, d);
        }
    return largest;
}

// Two markers a unit apart, at rest, in two columns.
Take two_markers(std::size_t rows) {
    Take take{.points = {"left", "right"}, .times = {}, .samples = {}, .head = {}, .unit = "mm"};
    for (std::size_t r = 0; r < rows; ++r) {
        take.times.push_back(0.01 * static_cast<double>(r));
        take.samples.push_back({0, 0, 0.001 * static_cast<double>(r)});
        take.samples.push_back({1, 0, 0.001 * static_cast<double>(r)});
    }
    return take;
}

TEST(CheckTake, counts_lost_samples_and_the_longest_gap_also_at_the_ends) {
    const Take take = lose(lose(lose(track(20, 60, rest), 0, 3), 8, 10), 15, 20);
    const TakeCheck check = check_take(take);
    ASSERT_EQ(check.lost.size(), 1U);
    EXPECT_EQ(check.lost[0].point, "a");
    EXPECT_EQ(check.lost[0].lost, 10U);
    EXPECT_EQ(check.lost[0].longest_gap, 5U);
    EXPECT_TRUE(check.never_seen.empty());
    EXPECT_EQ(check_take(lose(track(20, 60, rest), 0, 4)).lost[0].longest_gap, 4U);
}

TEST(CheckTake, a_clean_take_has_nothing_to_report) {
    const TakeCheck check = check_take(two_markers(10));
    EXPECT_TRUE(check.lost.empty());
    EXPECT_TRUE(check.never_seen.empty());
    EXPECT_TRUE(check.swaps.empty());
}

TEST(CheckTake, names_columns_that_are_never_seen) {
    EXPECT_THAT(check_take(lose(two_markers(4), 0, 4, 1)).never_seen, ElementsAre("right"));
}

TEST(CheckTake, finds_where_labels_are_swapped_once_and_not_where_they_change_back) {
    Take take = two_markers(30);
    for (std::size_t r = 12; r < 20; ++r) std::swap(row(take, r)[0], row(take, r)[1]);
    const TakeCheck check = check_take(take);
    ASSERT_EQ(check.swaps.size(), 1U);
    EXPECT_EQ(check.swaps[0].a, "left");
    EXPECT_EQ(check.swaps[0].b, "right");
    EXPECT_EQ(check.swaps[0].row, 12U);
}

TEST(CheckTake, finds_a_swap_that_happens_while_both_are_lost) {
    Take take = lose(lose(two_markers(30), 9, 12, 0), 10, 12, 1);
    for (std::size_t r = 12; r < 30; ++r) std::swap(row(take, r)[0], row(take, r)[1]);
    const TakeCheck check = check_take(take);
    ASSERT_EQ(check.swaps.size(), 1U);
    EXPECT_EQ(check.swaps[0].row, 12U);
}

TEST(CheckTake, a_jump_of_the_whole_head_is_no_swap) {
    Take take = two_markers(10);
    for (std::size_t r = 5; r < 10; ++r)
        for (Vec3& p : row(take, r)) p += {1, 0, 0};
    EXPECT_TRUE(check_take(take).swaps.empty());
}

TEST(MarkZerosLost, takes_zeros_for_lost_only_where_the_column_is_elsewhere) {
    Take take = track(3, 60, rest);
    take.samples[1] = {0, 0, 0};
    take = mark_zeros_lost(take);
    EXPECT_EQ(take.samples[0], rest(0));
    EXPECT_FALSE(is_finite(take.samples[1]));
    const Take still = track(3, 60, [](double) { return Vec3{}; });
    EXPECT_EQ(mark_zeros_lost(still).samples, still.samples);
}

TEST(MarkZerosLost, keeps_an_origin_that_was_written_as_seen) {
    Take take = track(3, 60, rest);
    take.samples[1] = {-0.0, 0, 0};
    EXPECT_TRUE(is_finite(mark_zeros_lost(take).samples[1]));
}

TEST(DropNeverSeen, keeps_the_others_and_their_samples) {
    Take take = lose(two_markers(4), 0, 4, 0);
    take.head.resize(4);
    take.planar = true;
    const Take kept = drop_never_seen(take);
    EXPECT_THAT(kept.points, ElementsAre("right"));
    ASSERT_EQ(kept.samples.size(), 4U);
    EXPECT_EQ(kept.samples[3], row(take, 3)[1]);
    EXPECT_EQ(kept.head.size(), 4U);
    EXPECT_TRUE(kept.planar);
    EXPECT_EQ(kept.unit, "mm");
}

Vec3 cubic(double t) {
    return {1 + 2 * t - 3 * t * t + 4 * t * t * t, t * t * t, -2 * t * t};
}

TEST(FillGaps, a_track_that_is_a_cubic_comes_back) {
    const Take whole = track(60, 60, cubic);
    for (const auto& [first, end] : {std::pair<std::size_t, std::size_t>{12, 40}, {30, 31}, {15, 45}}) {
        GapReport report;
        const Take filled = fill_gaps(lose(whole, first, end), {.longest = 1}, &report);
        EXPECT_LT(largest_difference(filled, whole), 1e-12) << first << " to " << end;
        EXPECT_EQ(report.filled, end - first);
        EXPECT_EQ(report.left, 0U);
    }
}

TEST(FillGaps, a_cubic_comes_back_at_uneven_times) {
    Take whole = track(40, 40, cubic);
    for (std::size_t r = 0; r < 40; ++r) {
        whole.times[r] = std::pow(static_cast<double>(r) / 40, 1.5);
        whole.samples[r] = cubic(whole.times[r]);
    }
    EXPECT_LT(largest_difference(fill_gaps(lose(whole, 10, 20), {.longest = 1}), whole), 1e-12);
}

TEST(FillGaps, with_few_samples_round_it_the_curve_has_one_degree_less) {
    const Take parabola = track(8, 8, [](double t) { return Vec3{t * t, 0, 1 - t}; });
    EXPECT_LT(largest_difference(fill_gaps(lose(parabola, 1, 5), {.longest = 1}), parabola), 1e-12);
    const Take line = track(8, 8, [](double t) { return Vec3{t, 0, 1 - t}; });
    EXPECT_LT(largest_difference(fill_gaps(lose(line, 1, 7), {.longest = 1}), line), 1e-12);
}

TEST(FillGaps, longer_gaps_and_gaps_at_the_ends_stay_open) {
    const Take take = lose(lose(lose(track(100, 10, cubic), 0, 2), 20, 25), 40, 46);
    GapReport report;
    const Take filled = fill_gaps(take, {.longest = 0.5}, &report);
    EXPECT_EQ(report.filled, 5U);
    EXPECT_EQ(report.left, 8U);
    EXPECT_FALSE(is_finite(filled.samples[0]));
    EXPECT_TRUE(is_finite(filled.samples[24]));
    EXPECT_FALSE(is_finite(filled.samples[40]));
    EXPECT_FALSE(is_finite(filled.samples[45]));
}

TEST(FillGaps, seen_samples_are_not_touched) {
    const Take take = lose(track(50, 60, cubic), 20, 30);
    const Take filled = fill_gaps(take, {});
    for (std::size_t r = 0; r < 50; ++r) {
        if (r < 20 || r >= 30) {
            EXPECT_EQ(filled.samples[r], take.samples[r]);
        }
    }
}

Take wave(std::size_t rows, double rate, double frequency) {
    return track(rows, rate, [&](double t) {
        return Vec3{std::sin(2 * std::numbers::pi * frequency * t), std::cos(2 * std::numbers::pi * frequency * t), 0};
    });
}

// The amplitude and phase that a wave keeps in the middle of the take, from both of its coordinates.
double gain(const Take& filtered, const Take& original) {
    const std::size_t r = filtered.samples.size() / 2;
    return dot(filtered.samples[r], original.samples[r]);
}
double leak(const Take& filtered, const Take& original) {
    const std::size_t r = filtered.samples.size() / 2;
    return length(cross(filtered.samples[r], original.samples[r]));
}

TEST(LowPass, refuses_a_cut_off_that_the_frames_cannot_carry) {
    const Take take = track(50, 60, rest);
    EXPECT_THAT(refusal([&] { (void)low_pass(take, {.cutoff = 30}); }),
                HasSubstr("half the frame rate of 60 Hz, found 30"));
    for (const double cutoff : {0.0, -1.0, std::nan(""), 31.0})
        EXPECT_THROW((void)low_pass(take, {.cutoff = cutoff}), Error);
    EXPECT_EQ(low_pass(track(1, 60, rest), {}).samples[0], rest(0));
}

TEST(LowPass, half_the_power_is_left_at_the_cut_off) {
    for (const double rate : {30.0, 60.0, 120.0})
        for (const double cutoff : {2.0, 8.0, 12.0}) {
            const Take take = wave(1200, rate, cutoff);
            const Take smooth = low_pass(take, {.cutoff = cutoff});
            EXPECT_NEAR(gain(smooth, take), std::sqrt(0.5), 1e-4) << rate << " " << cutoff;
        }
}

TEST(LowPass, keeps_slow_motion_and_removes_fast) {
    const Take slow = wave(1200, 60, 0.8);
    EXPECT_NEAR(gain(low_pass(slow, {.cutoff = 8}), slow), 1, 1e-4);
    const Take fast = wave(1200, 60, 25);
    EXPECT_LT(std::abs(gain(low_pass(fast, {.cutoff = 8}), fast)), 1e-3);
}

TEST(LowPass, shifts_nothing_in_time) {
    for (const double frequency : {1.0, 5.0, 8.0, 12.0}) {
        const Take take = wave(1200, 60, frequency);
        EXPECT_LT(leak(low_pass(take, {.cutoff = 8}), take), 1e-9) << frequency;
    }
    const Take pulse = track(201, 60, [](double t) {
        return Vec3{std::exp(-900 * (t - 100.0 / 60) * (t - 100.0 / 60)), 0, 0};
    });
    const Take smooth = low_pass(pulse, {.cutoff = 6});
    for (std::size_t i = 0; i <= 100; ++i) EXPECT_NEAR(smooth.samples[100 - i].x, smooth.samples[100 + i].x, 1e-9);
    EXPECT_LT(smooth.samples[100].x, 0.9);
}

TEST(LowPass, a_face_at_rest_or_in_even_motion_stays_as_it_is_up_to_the_ends) {
    for (const double cutoff : {0.5, 8.0, 29.0}) {
        const Take still = track(90, 60, rest);
        EXPECT_LT(largest_difference(low_pass(still, {.cutoff = cutoff}), still), 1e-12);
    }
    const Take even = track(90, 60, [](double t) { return Vec3{t, -2 * t, 1}; });
    EXPECT_LT(largest_difference(low_pass(even, {.cutoff = 8}), even), 1e-6);
}

TEST(LowPass, lost_samples_stay_lost_and_touch_no_other) {
    const Take take = lose(lose(track(90, 60, rest), 0, 1), 40, 50);
    const Take smooth = low_pass(take, {});
    for (std::size_t r = 0; r < 90; ++r) {
        EXPECT_EQ(is_finite(smooth.samples[r]), is_finite(take.samples[r]));
        if (is_finite(take.samples[r])) {
            EXPECT_LT(distance(smooth.samples[r], rest(0)), 1e-12);
        }
    }
}

TEST(LowPass, uneven_times_are_filtered_by_time_and_not_by_row) {
    const double f = 8;
    Take take = wave(1200, 60, f);
    for (std::size_t r = 0; r < 1200; ++r) {
        take.times[r] += 0.005 * std::sin(0.7 * static_cast<double>(r));
        const double angle = 2 * std::numbers::pi * f * take.times[r];
        take.samples[r] = {std::sin(angle), std::cos(angle), 0};
    }
    const Take smooth = low_pass(take, {.cutoff = f});
    EXPECT_NEAR(gain(smooth, take), std::sqrt(0.5), 0.02);
    EXPECT_LT(leak(smooth, take), 0.02);
}

TEST(LowPass, a_hole_in_the_times_of_the_file_is_not_filled_with_work) {
    Take take = track(90, 60, rest);
    for (std::size_t r = 45; r < 90; ++r) take.times[r] += 1e9;
    EXPECT_LT(largest_difference(low_pass(take, {}), take), 1e-12);
}

TEST(Neutral, refuses_rows_that_are_not_there) {
    const Take take = track(5, 60, rest);
    EXPECT_THAT(refusal([&] { (void)neutral(take, {.row = 3, .rows = 3}); }), HasSubstr("the take's 5 rows"));
    EXPECT_THROW((void)neutral(take, {.row = 5, .rows = 1}), Error);
    EXPECT_THROW((void)neutral(take, {.row = 1, .rows = 0}), Error);
    EXPECT_THROW((void)neutral(take, {.row = 1, .rows = std::numeric_limits<std::size_t>::max()}), Error);
    EXPECT_THROW((void)neutral(Take{}), Error);
}

TEST(Neutral, is_the_mean_of_its_rows_with_lost_samples_left_out) {
    const Take take = track(10, 1, [](double t) { return Vec3{t, 0, 1}; });
    EXPECT_EQ(neutral(take)[0], (Vec3{0, 0, 1}));
    EXPECT_EQ(neutral(take, {.row = 2, .rows = 3})[0], (Vec3{3, 0, 1}));
    EXPECT_EQ(neutral(lose(take, 3, 4), {.row = 2, .rows = 4})[0], (Vec3{11.0 / 3, 0, 1}));
}

TEST(Neutral, a_lost_column_takes_its_nearest_sample_in_time) {
    const Take take = track(10, 1, [](double t) { return Vec3{t, 0, 1}; });
    EXPECT_EQ(neutral(lose(take, 3, 7), {.row = 4})[0].x, 2);
    EXPECT_EQ(neutral(lose(take, 3, 7), {.row = 5})[0].x, 7);
    EXPECT_EQ(neutral(lose(take, 0, 3))[0].x, 3);
    EXPECT_FALSE(is_finite(neutral(lose(take, 0, 10))[0]));
}

}  // namespace
}  // namespace mien
