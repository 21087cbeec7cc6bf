// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/head.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iostream>
#include <iterator>
#include <limits>
#include <random>

#include "refusal.hpp"

#include "mien/error.hpp"
#include "mien/io/trc.hpp"

namespace mien {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using Method = HeadOptions::Method;

constexpr Method methods[] = {Method::least_squares, Method::three_markers};
const std::vector<std::string> skull{"10.1", "10.2", "11.1", "11.4", "9.12"};

// Five markers on the skull, then three of a jaw and a brow that move on their own. Millimetres, origin off the head.
Take still_head(std::size_t rows = 40) {
    Take take;
    take.points = skull;
    take.points.insert(take.points.end(), {"2.1", "8.4", "4.1"});
    take.unit = "mm";
    for (std::size_t r = 0; r < rows; ++r) {
        const double t = static_cast<double>(r) / 30;
        take.times.push_back(t);
        const double open = 20 * (1 - std::cos(5 * t));
        for (const Vec3& p :
             {Vec3{75, 700, -20}, Vec3{-75, 702, -18}, Vec3{3, 780, 60}, Vec3{0, 820, -10}, Vec3{0, 710, 90},
              Vec3{0, 600 - open, 80}, Vec3{25, 630 - 0.5 * open, 75}, Vec3{30, 735 + 8 * std::sin(9 * t), 78}})
            take.samples.push_back(p);
    }
    return take;
}

Pose pose_at(double t) {
    const Vec3 turn{0.3 * std::sin(1.3 * t), 0.4 * std::sin(2.1 * t), 0.2 * std::sin(1.7 * t)};
    const double half = 0.5 * length(turn);
    const double s = half > 0 ? std::sin(half) / length(turn) : 0;
    return {{s * turn.x, s * turn.y, s * turn.z, std::cos(half)}, {90 * std::sin(t), 40 * t, -25 * std::sin(3 * t)}};
}

// The head moves as pose_at says; at time zero it is in its place.
Take moved(Take take) {
    for (std::size_t r = 0; r < row_count(take); ++r)
        for (Vec3& p : row(take, r)) p = apply(pose_at(take.times[r]), p);
    return take;
}

Take flat(Take take) {
    for (Vec3& p : take.samples) p.z = 0;
    take.planar = true;
    return take;
}

Take moved_in_plane(Take take) {
    for (std::size_t r = 0; r < row_count(take); ++r) {
        const double half = 0.2 * std::sin(take.times[r]);
        const Pose pose{{0, 0, std::sin(half), std::cos(half)}, {30 * take.times[r], -20, 0}};
        for (Vec3& p : row(take, r)) p = apply(pose, p);
    }
    return take;
}

Take lose(Take take, std::size_t column, std::size_t first, std::size_t end) {
    for (std::size_t r = first; r < end; ++r) row(take, r)[column] = lost_sample;
    return take;
}

Take shaken(Take take, double noise) {
    std::mt19937 random(7);
    // Not a std distribution: those differ between standard libraries.
    const auto step = [&] { return noise * (2 * static_cast<double>(random()) / 4294967295.0 - 1); };
    for (Vec3& p : take.samples) p += {step(), step(), step()};
    return take;
}

// Largest distance of samples that are seen in both; lost in only one of them counts as infinite.
double largest_difference(const Take& a, const Take& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.samples.size(); ++i) {
        if (is_finite(a.samples[i]) != is_finite(b.samples[i])) return std::numeric_limits<double>::infinity();
        if (is_finite(a.samples[i])) largest = std::max(largest, distance(a.samples[i], b.samples[i]));
    }
    return largest;
}

Take put_back(Take take) {
    for (std::size_t r = 0; r < row_count(take); ++r)
        for (Vec3& p : row(take, r)) p = apply(take.head[r], p);
    return take;
}

std::string refusal(const Take& take, const HeadOptions& options) {
    return mien::refusal([&] { (void)remove_head_motion(take, options); });
}

TEST(HeadMotion, refuses_markers_that_are_absent_too_few_or_on_a_line) {
    const Take take = moved(still_head());
    for (const Method method : methods) {
        EXPECT_THAT(refusal(take, {method, {"10.1", "10.2", "ear"}}), HasSubstr("expected a column ear in the take"));
        EXPECT_THAT(refusal(take, {method, {"10.1", "10.2"}}), HasSubstr("at least 3 head markers, found 2"));
        EXPECT_THAT(refusal(take, {method, {"10.1", "10.2", "10.2"}}), HasSubstr("at least 3 head markers, found 2"));
        EXPECT_THAT(refusal(take, {method, skull, 40}), HasSubstr("reference row below 40"));
        Take line = take;
        for (std::size_t r = 0; r < 40; ++r) row(line, r)[2] = 0.3 * row(line, r)[0] + 0.7 * row(line, r)[1];
        EXPECT_THAT(refusal(line, {method, {"10.1", "10.2", "11.1"}}), HasSubstr("not on a line"));
    }
    EXPECT_THAT(refusal(flat(take), {Method::least_squares, {"10.1"}}), HasSubstr("at least 2 head markers, found 1"));
}

TEST(HeadMotion, refuses_a_take_without_rigid_columns_when_none_are_named) {
    EXPECT_THAT(refusal(shaken(still_head(), 60), {}), HasSubstr("name the markers on the head"));
    EXPECT_THROW((void)remove_head_motion(Take{}), Error);
}

TEST(HeadMotion, a_rigid_motion_is_taken_out_and_kept_as_the_pose) {
    const Take still = still_head();
    const Take captured = moved(still);
    for (const Method method : methods)
        for (const auto& markers :
             {std::vector<std::string>{}, skull, std::vector<std::string>{"10.1", "10.2", "9.12"}}) {
            const Take face = remove_head_motion(captured, {method, markers});
            EXPECT_LT(largest_difference(face, still), 1e-9);
            EXPECT_LT(largest_difference(put_back(face), captured), 1e-9);
            ASSERT_EQ(face.head.size(), 40U);
            for (std::size_t r = 0; r < 40; ++r)
                EXPECT_LT(distance(apply(face.head[r], {10, 20, 30}), apply(pose_at(captured.times[r]), {10, 20, 30})),
                          1e-8);
        }
}

TEST(HeadMotion, three_markers_in_a_plane_are_never_mirrored) {
    Take take = still_head(2);
    for (Vec3& p : row(take, 1)) p = rotate({0, 1, 0, 0}, p);  // half a turn
    for (const Method method : methods) {
        const Take face = remove_head_motion(take, {method, {"10.1", "10.2", "9.12"}});
        EXPECT_LT(largest_difference(face, still_head(2)), 1e-9);
    }
}

TEST(HeadMotion, the_reference_row_stays_in_its_place) {
    const Take captured = moved(still_head());
    for (const Method method : methods) {
        const Take face = remove_head_motion(captured, {method, skull, 17});
        for (std::size_t c = 0; c < 8; ++c) EXPECT_LT(distance(row(face, 17)[c], row(captured, 17)[c]), 1e-9);
        EXPECT_LT(largest_difference(put_back(face), captured), 1e-9);
    }
}

TEST(HeadMotion, lost_markers_are_tolerated_while_three_are_seen) {
    const Take still = lose(lose(lose(still_head(), 0, 3, 20), 1, 12, 30), 6, 5, 6);
    for (const Method method : methods)
        EXPECT_LT(largest_difference(remove_head_motion(moved(still), {method, skull}), still), 1e-8);
}

TEST(HeadMotion, markers_lost_in_the_reference_row_get_their_place_from_other_rows) {
    const Take still = lose(lose(lose(lose(still_head(), 0, 0, 5), 1, 0, 8), 2, 20, 40), 3, 20, 40);
    for (const Method method : methods)
        EXPECT_LT(largest_difference(remove_head_motion(moved(still), {method, skull}), still), 1e-8);
}

TEST(HeadMotion, a_reference_row_without_markers_stands_for_the_nearest_with_them) {
    Take captured = moved(still_head());
    for (std::size_t c = 0; c < 5; ++c) captured = lose(captured, c, 0, 4);
    const Take face = remove_head_motion(captured, {Method::least_squares, skull});
    EXPECT_LT(distance(row(face, 4)[5], row(captured, 4)[5]), 1e-9);
    EXPECT_EQ(face.head[0], face.head[4]);
}

TEST(HeadMotion, where_too_few_are_seen_the_pose_runs_between_the_rows_around_and_is_held_at_the_ends) {
    Take take = still_head(21);
    for (std::size_t r = 0; r < 21; ++r) {
        const double half = 0.02 * static_cast<double>(r);
        for (Vec3& p : row(take, r)) p = rotate({0, std::sin(half), 0, std::cos(half)}, p);
    }
    const Take captured = lose(lose(lose(take, 0, 8, 14), 1, 8, 14), 2, 8, 14);
    const Take ends = lose(lose(lose(captured, 0, 18, 21), 1, 18, 21), 2, 18, 21);
    for (const Method method : methods) {
        const Take face = remove_head_motion(ends, {method, {"10.1", "10.2", "11.1", "9.12"}});
        for (std::size_t r = 0; r < 18; ++r) {
            EXPECT_NEAR(face.head[r].rotation.y, std::sin(0.02 * static_cast<double>(r)), 1e-9);
            // The middle of the head goes straight, not round the arc: 1 - cos of three steps on a radius under 100.
            EXPECT_LT(distance(row(face, r)[3], row(face, 0)[3]), 100 * (1 - std::cos(3 * 0.04)));
        }
        for (std::size_t r = 18; r < 21; ++r) EXPECT_EQ(face.head[r], face.head[17]);
    }
}

TEST(HeadMotion, a_marker_that_jumps_onto_another_spoils_no_row) {
    for (const Take& clean : {moved(still_head()), moved_in_plane(flat(still_head()))}) {
        Take captured = clean;
        row(captured, 9)[1] = row(captured, 9)[0];
        for (const Method method : methods) {
            const Take face = remove_head_motion(captured, {method, {"10.1", "10.2", "11.4"}});
            for (const Vec3& p : face.samples) EXPECT_TRUE(is_finite(p));
        }
    }
}

TEST(HeadMotion, markers_at_one_place_in_a_picture_tell_no_pose) {
    Take captured = moved_in_plane(flat(still_head()));
    row(captured, 9)[1] = row(captured, 9)[0];
    for (const auto& markers : {std::vector<std::string>{"10.1", "10.2"}, {"10.1", "10.2", "11.4"}}) {
        const Take face = remove_head_motion(captured, {Method::three_markers, markers});
        const Quaternion before = face.head[8].rotation, after = face.head[10].rotation;
        EXPECT_NEAR(face.head[9].rotation.z, 0.5 * (before.z + after.z), 1e-4);
    }
}

TEST(HeadMotion, noise_hurts_least_squares_over_five_markers_less_than_three_markers) {
    const Take still = still_head(200);
    const Take captured = shaken(moved(still), 1);
    double sums[2] = {0, 0};
    for (const Method method : methods) {
        const Take face = remove_head_motion(captured, {method, skull});
        for (std::size_t r = 1; r < 200; ++r) {
            const Pose truth = pose_at(still.times[r]);
            const Vec3 chin = row(still, r)[5];
            sums[method == Method::three_markers] += distance(apply(face.head[r], chin), apply(truth, chin));
        }
    }
    EXPECT_LT(sums[0] / 199, 2.0);
    EXPECT_LT(sums[0], 0.95 * sums[1]);
}

TEST(HeadMotion, a_translation_leaves_the_turn_of_three_markers_as_it_was) {
    const Take captured = shaken(moved(still_head()), 2);
    Take shifted = captured;
    for (std::size_t r = 1; r < 40; ++r)
        for (Vec3& p : row(shifted, r)) p += {1000, -500.0 * static_cast<double>(r), 300};
    for (const Method method : methods) {
        const Take a = remove_head_motion(captured, {method, skull});
        const Take b = remove_head_motion(shifted, {method, skull});
        for (std::size_t r = 0; r < 40; ++r) {
            EXPECT_NEAR(a.head[r].rotation.x, b.head[r].rotation.x, 1e-10);
            EXPECT_NEAR(a.head[r].rotation.w, b.head[r].rotation.w, 1e-10);
        }
    }
}

TEST(HeadMotion, a_planar_take_is_turned_and_shifted_in_its_plane) {
    const Take still = flat(still_head());
    const Take captured = moved_in_plane(still);
    for (const Method method : methods)
        for (const auto& markers : {skull, std::vector<std::string>{"10.1", "10.2"}}) {
            const Take face = remove_head_motion(captured, {method, markers});
            for (std::size_t r = 0; r < 40; ++r) {
                EXPECT_EQ(face.head[r].rotation.x, 0);
                EXPECT_EQ(face.head[r].rotation.y, 0);
                EXPECT_EQ(row(face, r)[5].z, 0);
                EXPECT_NEAR(distance(row(face, r)[5], row(face, r)[0]), distance(row(still, r)[5], row(still, r)[0]),
                            1e-9);
                EXPECT_LT(distance(row(face, r)[3], row(face, 0)[3]), 1e-9);
            }
            EXPECT_LT(largest_difference(put_back(face), captured), 1e-9);
        }
}

TEST(HeadMotion, poses_the_take_has_already_stay_its_outer_part) {
    Take captured = moved(still_head());
    const Pose room{{0.5, 0.5, 0.5, 0.5}, {7, 8, 9}};
    captured.head.assign(40, room);
    const Take face = remove_head_motion(captured);
    const Take before = put_back(captured);
    EXPECT_LT(largest_difference(put_back(face), before), 1e-9);
    EXPECT_LT(largest_difference(face, still_head()), 1e-9);
}

TEST(HeadMotion, neighbouring_poses_keep_to_one_sign_through_whole_turns) {
    Take take = still_head(40);
    for (std::size_t r = 0; r < 40; ++r) {
        const double half = 0.15 * static_cast<double>(r);
        for (Vec3& p : row(take, r)) p = rotate({0, std::sin(half), 0, std::cos(half)}, p);
    }
    const Take face = remove_head_motion(take);
    for (std::size_t r = 1; r < 40; ++r)
        EXPECT_GT(face.head[r].rotation.w * face.head[r - 1].rotation.w +
                      face.head[r].rotation.y * face.head[r - 1].rotation.y,
                  0.9);
}

TEST(HeadMarkers, are_those_on_the_skull_that_keep_their_distances) {
    const Take take = moved(still_head());
    EXPECT_EQ(head_markers(take), skull);
    Take loose = take;  // an ear marker that comes off
    for (std::size_t r = 0; r < 40; ++r) row(loose, r)[1] += {0, 0.5 * static_cast<double>(r), 0};
    EXPECT_THAT(head_markers(loose), ElementsAre("10.1", "11.1", "11.4", "9.12"));
}

TEST(HeadMarkers, are_known_by_a_word_that_begins_with_head) {
    Take take = moved(still_head());
    take.points = {"HeadTop", "subject:head_2", "ForeHead_M", "NoseHead", "L HEAD", "2.1", "8.4", "4.1"};
    EXPECT_THAT(head_markers(take), ElementsAre("HeadTop", "subject:head_2", "L HEAD"));
}

TEST(HeadMarkers, are_found_by_motion_alone_when_no_name_says_so) {
    Take take = moved(still_head());
    for (std::size_t c = 0; c < 8; ++c) take.points[c] = "marker" + std::to_string(c);
    EXPECT_THAT(head_markers(take), ElementsAre("marker0", "marker1", "marker2", "marker3", "marker4"));
    EXPECT_THAT(head_markers(lose(take, 4, 0, 25)), ElementsAre("marker0", "marker1", "marker2", "marker3"));
}

TEST(HeadMarkers, are_none_where_nothing_is_rigid_or_nothing_is_there) {
    EXPECT_THAT(head_markers(shaken(still_head(), 60)), IsEmpty());
    EXPECT_THAT(head_markers(Take{}), IsEmpty());
    Take none = still_head();
    none.times.clear();
    none.samples.clear();
    EXPECT_THAT(head_markers(none), IsEmpty());
}

// Real captures without markers on the skull: upper face while the jaw moves, cheeks and nose while the brows move. The
// head turns by up to 4.8 degrees and moves by up to 15 mm in them (centimetres).
struct Capture {
    std::string file, moves;
};

class RealCapture : public ::testing::TestWithParam<Capture> {};

Take read_trc(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    return parse_trc(std::as_bytes(std::span(bytes)));
}

double root_mean_square_shift(const Take& take, const std::vector<std::string>& markers) {
    double sum = 0;
    for (const std::string& marker : markers) {
        const std::size_t c = *find_column(take, marker);
        for (std::size_t r = 0; r < row_count(take); ++r) {
            const Vec3 shift = row(take, r)[c] - row(take, 0)[c];
            sum += dot(shift, shift);
        }
    }
    return std::sqrt(sum / static_cast<double>(markers.size() * row_count(take)));
}

TEST_P(RealCapture, keeps_its_head_markers_still_within_two_millimetres) {
    const std::filesystem::path path = std::filesystem::path(MIEN_SHARED) / "data/markers-41" / GetParam().file;
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
    const Take captured = read_trc(path);
    const std::vector<std::string> markers = head_markers(captured);
    EXPECT_GE(markers.size(), 8U);
    EXPECT_THAT(markers, Not(Contains(GetParam().moves)));
    for (const Method method : methods) {
        const Take face = remove_head_motion(captured, {method, markers});
        EXPECT_LT(root_mean_square_shift(face, markers), method == Method::least_squares ? 0.15 : 0.2);
        EXPECT_LT(root_mean_square_shift(face, markers), 0.5 * root_mean_square_shift(captured, markers));
        EXPECT_LT(largest_difference(put_back(face), captured), 1e-9);
        std::cout << GetParam().file << (method == Method::least_squares ? " least squares" : " three markers") << ": "
                  << markers.size() << " markers, " << 10 * root_mean_square_shift(captured, markers) << " mm before, "
                  << 10 * root_mean_square_shift(face, markers) << " mm after\n";
    }
}

INSTANTIATE_TEST_SUITE_P(HeadMotion, RealCapture,
                         ::testing::Values(Capture{"jaw.trc", "Chin"}, Capture{"eyebrows.trc", "Leyebrow_Inside"}),
                         [](const auto& test) { return test.param.moves; });

}  // namespace
}  // namespace mien
