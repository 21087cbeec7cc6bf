// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/fap_filters.hpp"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>

#include "algorithms/fap_face.hpp"
#include "io/fap_samples.hpp"

#include "mien/algorithms/faps.hpp"
#include "mien/algorithms/fapu.hpp"
#include "mien/algorithms/resolve_faps.hpp"
#include "mien/error.hpp"

namespace mien {
namespace {

void set(FapFrame& frame, int fap, int value) {
    frame.mask.set(fap_index(fap));
    frame.value[fap_index(fap)] = value;
}

int value(const FapFrame& frame, int fap) {
    return frame.mask[fap_index(fap)] ? frame.value[fap_index(fap)] : std::numeric_limits<int>::min();
}

// One parameter that rises by `step` with every frame.
FapStream ramp(int fap, int step, std::uint32_t frames, std::uint32_t first = 0) {
    FapStream stream;
    for (std::uint32_t f = 0; f < frames; ++f) {
        FapFrame& frame = stream.frames.emplace_back();
        frame.number = first + f;
        set(frame, fap, step * static_cast<int>(f));
    }
    return stream;
}

TEST(FapFilters, MirroredTwiceIsTheSameStream) {
    std::mt19937 random(1);
    for (int i = 0; i < 50; ++i) {
        const FapStream stream = random_stream(random, 12);
        EXPECT_EQ(mirrored(mirrored(stream)).frames, stream.frames);
    }
}

TEST(FapFilters, AMirroredStreamMovesAFaceAsAMirrorShowsIt) {
    const Fapu fapu = measure_fapu(neutral_points());
    FapStream stream;
    FapFrame& frame = stream.frames.emplace_back();
    std::mt19937 random(2);
    for (int fap = 3; fap <= 68; ++fap) set(frame, fap, static_cast<int>(random() % 400) - 200);
    const Take plain = to_take(stream, fapu), other = to_take(mirrored(stream), fapu);
    for (std::size_t c = 0; c < plain.points.size(); ++c) {
        const Vec3 p = plain.samples[c], q = other.samples[*find_column(other, mirror_point(plain.points[c]))];
        EXPECT_LT(distance({-p.x, p.y, p.z}, q), 1e-9) << plain.points[c];
    }
    const Vec3 nose{3, -34, 25}, there{-3, -34, 25};
    const Vec3 turned = apply(plain.head[0], nose), mirror = apply(other.head[0], there);
    EXPECT_LT(distance({-turned.x, turned.y, turned.z}, mirror), 1e-9);
}

TEST(FapFilters, BetweenTwoFramesValuesAreLinearAndBeyondTheEndsHeld) {
    const FapStream stream = ramp(53, 100, 3, 5);
    EXPECT_EQ(value(frame_at(stream, 5.25 / 25), 53), 25);
    EXPECT_EQ(value(frame_at(stream, 6.0 / 25), 53), 100);
    EXPECT_EQ(value(frame_at(stream, 0), 53), 0);
    EXPECT_EQ(value(frame_at(stream, 99), 53), 200);
    EXPECT_THROW(frame_at(FapStream{}, 0), Error);
}

TEST(FapFilters, AParameterThatOneFrameSendsIsTakenFromTheNearerFrame) {
    FapStream stream = ramp(53, 100, 2);
    set(stream.frames[1], 3, 70);
    EXPECT_EQ(value(frame_at(stream, 0.4 / 25), 3), std::numeric_limits<int>::min());
    EXPECT_EQ(value(frame_at(stream, 0.6 / 25), 3), 70);
}

TEST(FapFilters, TwiceTheSpeedTakesHalfOfTheTimeAndAnotherRateTheSame) {
    const FapStream stream = ramp(53, 10, 51, 10);
    const FapStream fast = retimed(stream, {.speed = 2});
    EXPECT_EQ(fast.rate, 25);
    ASSERT_EQ(fast.frames.size(), 26U);
    EXPECT_EQ(fast.frames[0].number, 5U);
    for (std::uint32_t f = 0; f < 26; ++f) EXPECT_EQ(value(fast.frames[f], 53), static_cast<int>(20 * f));
    const FapStream fine = retimed(stream, {.rate = 100});
    EXPECT_EQ(fine.rate, 100);
    ASSERT_EQ(fine.frames.size(), 201U);
    EXPECT_EQ(value(fine.frames[28], 53), 70);  // four frames for one: the seventh
    EXPECT_NEAR(fine.frames.back().number / fine.rate, stream.frames.back().number / stream.rate, 1e-9);
}

TEST(FapFilters, RetimedByNothingIsTheSameStream) {
    std::mt19937 random(3);
    for (int i = 0; i < 20; ++i) {
        FapStream stream = random_stream(random, 12);
        for (std::uint32_t f = 0; f < stream.frames.size(); ++f) stream.frames[f].number = f;
        EXPECT_EQ(retimed(stream, {}).frames, stream.frames);
    }
}

TEST(FapFilters, WhatCannotBeRetimedIsRefused) {
    const FapStream stream = ramp(53, 10, 3);
    for (const double wrong : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), 1.0 / 0.0}) {
        EXPECT_THROW(retimed(stream, {.speed = wrong}), Error) << wrong;
    }
    for (const double wrong : {-1.0, std::numeric_limits<double>::quiet_NaN(), 1.0 / 0.0}) {
        EXPECT_THROW(retimed(stream, {.rate = wrong}), Error) << wrong;
    }
    EXPECT_THROW(retimed(stream, {.speed = 1e-9}), Error);
    EXPECT_THROW(retimed(FapStream{}, {}), Error);
}

TEST(FapFilters, PartsAreRegionsPointsParametersAndTheHead) {
    EXPECT_EQ(part_faps("brows"), (std::vector<int>{31, 32, 33, 34, 35, 36, 37, 38}));
    EXPECT_EQ(part_faps("head"), (std::vector<int>{48, 49, 50}));
    EXPECT_EQ(part_faps("jaw"), (std::vector<int>{3, 14, 15, 18}));
    EXPECT_EQ(part_faps("8.3"), (std::vector<int>{53, 59}));
    EXPECT_EQ(part_faps("thrust_jaw"), (std::vector<int>{14}));
    EXPECT_THROW(part_faps("knee"), Error);
    EXPECT_THROW(part_faps(""), Error);
}

TEST(FapFilters, ScaledPartsMoveAsMuchAsAskedAndTheOthersAsBefore) {
    FapStream stream = ramp(53, 100, 2);
    set(stream.frames[1], 31, -50);
    set(stream.frames[1], 3, 40);
    const std::array<PartStrength, 2> strengths{{{"mouth", 1.5}, {"brows", 0}}};
    const FapStream result = scaled(stream, strengths);
    EXPECT_EQ(value(result.frames[1], 53), 150);
    EXPECT_EQ(value(result.frames[1], 31), 0);
    EXPECT_EQ(value(result.frames[1], 3), 40);
    const std::array<PartStrength, 1> wrong{{{"mouth", std::numeric_limits<double>::infinity()}}};
    EXPECT_THROW(scaled(stream, wrong), Error);
}

TEST(FapFilters, JoinedStreamsFollowEachOtherAndRestWhatTheyDoNotMove) {
    const std::array<FapStream, 2> streams{ramp(3, 10, 4, 7), ramp(31, 5, 3, 100)};
    const FapStream both = concatenated(streams);
    ASSERT_EQ(both.frames.size(), 7U);
    for (std::uint32_t f = 0; f < 7; ++f) EXPECT_EQ(both.frames[f].number, 7 + f);
    EXPECT_EQ(value(both.frames[3], 3), 30);
    EXPECT_EQ(value(both.frames[4], 3), 0);  // else a decoder held the jaw
    EXPECT_EQ(value(both.frames[6], 31), 10);
    EXPECT_EQ(value(both.frames[6], 32), 10);  // as the second stream alone shows it
}

TEST(FapFilters, JoinedStreamsShowWhatEachOfThemShows) {
    FapStream first = ramp(53, 10, 3), second = ramp(54, 20, 3);
    const std::array<FapStream, 2> streams{first, second};
    const FapStream shown = resolve_faps(concatenated(streams)), alone = resolve_faps(second);
    for (std::size_t f = 0; f < 3; ++f)
        for (int fap = 3; fap <= 68; ++fap)
            if (alone.frames[f].mask[fap_index(fap)]) {
                EXPECT_EQ(value(shown.frames[3 + f], fap), value(alone.frames[f], fap)) << fap_info(fap).name;
            }
}

TEST(FapFilters, AJoinedStreamTakesTheRateOfTheFirst) {
    FapStream slow = ramp(3, 10, 11);
    slow.rate = 10;
    const std::array<FapStream, 2> streams{ramp(3, 1, 5), slow};
    const FapStream both = concatenated(streams);
    EXPECT_EQ(both.frames.size(), 5U + 26U);
    EXPECT_EQ(value(both.frames.back(), 3), 100);
    EXPECT_THROW(concatenated({}), Error);
    const std::array<FapStream, 2> empty{ramp(3, 1, 5), FapStream{}};
    EXPECT_THROW(concatenated(empty), Error);
}

TEST(FapFilters, ABlendIsTheSharesOfBoth) {
    const FapStream a = ramp(3, 10, 3), b = ramp(3, 30, 5);
    const FapStream half = blended(a, b, 0.5);
    ASSERT_EQ(half.frames.size(), 5U);
    EXPECT_EQ(value(half.frames[2], 3), 40);
    EXPECT_EQ(value(half.frames[4], 3), 70);  // the shorter one keeps its end
    for (std::size_t f = 0; f < 3; ++f) EXPECT_EQ(value(blended(a, b, 0).frames[f], 3), value(a.frames[f], 3));
    for (std::size_t f = 0; f < 5; ++f) EXPECT_EQ(value(blended(a, b, 1).frames[f], 3), value(b.frames[f], 3));
    EXPECT_EQ(value(blended(a, ramp(31, 8, 3), 0.25).frames[2], 31), 4);
    EXPECT_EQ(value(blended(a, ramp(31, 8, 3), 0.25).frames[2], 3), 15);
    EXPECT_THROW(blended(a, b, std::numeric_limits<double>::quiet_NaN()), Error);
    EXPECT_THROW(blended(a, FapStream{}, 0.5), Error);
}

TEST(FapFilters, StatisticsAreThoseOfTheValuesThatAreSent) {
    FapStream stream = ramp(3, 0, 4);
    for (std::size_t f = 0; f < 4; ++f) stream.frames[f].value[2] = std::array{2, 4, 4, 6}[f];
    set(stream.frames[1], 14, -5);
    set(stream.frames[2], 53, 5000);
    const std::vector<FapStatistics> rows = statistics(stream);
    ASSERT_EQ(rows.size(), 3U);
    EXPECT_EQ(rows[0].fap, 3);
    EXPECT_EQ(rows[0].frames, 4U);
    EXPECT_EQ(rows[0].low, 2);
    EXPECT_EQ(rows[0].high, 6);
    EXPECT_DOUBLE_EQ(rows[0].mean, 4);
    EXPECT_DOUBLE_EQ(rows[0].deviation, std::sqrt(2.0));
    EXPECT_EQ(rows[1].negative, 1U);  // a jaw that is meant to go forwards alone
    EXPECT_EQ(rows[1].outside, 0U);
    EXPECT_EQ(rows[2].outside, 1U);
}

}  // namespace
}  // namespace mien
