// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/faps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "algorithms/fap_face.hpp"

#include "mien/algorithms/fapu.hpp"
#include "mien/error.hpp"
#include "mien/io/read.hpp"

namespace mien {
namespace {

Vec3 place(const Take& take, std::string_view point, std::size_t r = 0) {
    return row(take, r)[find_column(take, point).value()];
}

Vec3 rest(const Fapu& fapu, std::string_view point) {
    return fapu.points[find_point(fapu.points, point).value()].position;
}

double unit_distance(const Fapu& fapu, FapUnit unit) {
    switch (unit) {
        case FapUnit::irisd:
            return fapu.irisd;
        case FapUnit::es:
            return fapu.es;
        case FapUnit::ens:
            return fapu.ens;
        case FapUnit::mns:
            return fapu.mns;
        case FapUnit::mw:
            return fapu.mw;
        default:
            return 0;
    }
}

// Values of any size up to the limits of the table, for all that a take of points can show.
FapStream random_faps(std::mt19937& random, std::size_t frames, double share) {
    FapStream stream;
    for (std::uint32_t f = 0; f < frames; ++f) {
        FapFrame& frame = stream.frames.emplace_back();
        frame.number = f;
        for (int n = 3; n <= 68; ++n) {
            const Fap& fap = fap_info(n);
            if (fap.axis == FapAxis::scale) continue;
            frame.mask.set(fap_index(n));
            std::uniform_real_distribution<double> value(share * fap.intra.low * fap.quant_step,
                                                         share * fap.intra.high * fap.quant_step);
            frame.value[fap_index(n)] = static_cast<int>(std::lround(value(random)));
        }
    }
    return stream;
}

// The largest difference of a value that both frames send; -1 when they do not send the same.
int largest_difference(const FapFrame& a, const FapFrame& b) {
    if (a.mask != b.mask) return -1;
    int most = 0;
    for (std::size_t i = 0; i < fap_count; ++i) most = std::max(most, std::abs(a.value[i] - b.value[i]));
    return most;
}

TEST(Faps, AThousandAndTwentyFourUnitsAreTheDistanceOfTheUnitAlongTheAxis) {
    const Fapu fapu = measure_fapu(neutral_points());
    for (int n = 3; n <= 68; ++n) {
        const Fap& fap = fap_info(n);
        if (fap.unit == FapUnit::angle || fap.axis == FapAxis::scale) continue;
        const Take take = to_take(one_frame({{n, 1024}}), fapu);
        const Vec3 moved = place(take, fap.point) - rest(fapu, fap.point);
        const double length = fap.sign * unit_distance(fapu, fap.unit);
        const Vec3 expected = fap.axis == FapAxis::x   ? Vec3{length, 0, 0}
                              : fap.axis == FapAxis::y ? Vec3{0, length, 0}
                                                       : Vec3{0, 0, length};
        EXPECT_NEAR(distance(moved, expected), 0, 1e-9) << fap.name;
    }
}

TEST(Faps, WhatNoParameterMovesRests) {
    const Fapu fapu = measure_fapu(neutral_points());
    const Take take = to_take(one_frame({{3, 500}, {53, 200}}), fapu);
    EXPECT_EQ(take.points.size(), fapu.points.size());
    for (const FeaturePoint& point : fapu.points) {
        const bool moves = point.id == "2.1" || point.id == "8.3" || point.id.starts_with("6.");  // goes with 2.1
        EXPECT_EQ(distance(place(take, point.id), point.position) > 0, moves) << point.id;
    }
    EXPECT_TRUE(take.head.empty());
}

TEST(Faps, EyelidsCloseAndTheJawOpensWithPositiveValues) {
    const Fapu fapu = measure_fapu(neutral_points());
    const Take shut = to_take(one_frame({{19, 1024}, {20, 512}, {22, 512}, {3, 100}, {18, 100}}), fapu);
    EXPECT_NEAR(place(shut, "3.1").y, rest(fapu, "3.3").y, 1e-9);  // one lid alone goes the whole way
    EXPECT_NEAR(place(shut, "3.2").y, place(shut, "3.4").y, 1e-9);
    EXPECT_LT(place(shut, "2.1").y, rest(fapu, "2.1").y);
    EXPECT_GT(place(shut, "2.10").y, rest(fapu, "2.10").y);  // in spite of its name
}

TEST(Faps, TheHeadTurnsLeftNodsDownAndLeansRightAboutTheNeck) {
    const Fapu fapu = measure_fapu(neutral_points());
    const int angle = 10000;  // a tenth of a radian
    const Vec3 nose = rest(fapu, "9.3"), top = rest(fapu, "11.4");
    const auto pose = [&](int fap) { return to_take(one_frame({{fap, angle}}), fapu).head.at(0); };
    EXPECT_GT(apply(pose(49), nose).x, nose.x);
    EXPECT_LT(apply(pose(48), nose).y, nose.y);
    EXPECT_LT(apply(pose(50), top).x, top.x);
    for (const int fap : {48, 49, 50}) EXPECT_NEAR(distance(apply(pose(fap), fapu.neck), fapu.neck), 0, 1e-9);
    EXPECT_NEAR(2 * std::acos(pose(49).rotation.w), 0.1, 1e-12);
}

TEST(Faps, YawComesAfterPitchAndPitchAfterRoll) {
    const Fapu fapu = measure_fapu(neutral_points());
    const auto rotated = [&](std::initializer_list<std::pair<int, int>> values, const Vec3& v) {
        return rotate(to_take(one_frame(values), fapu).head.at(0).rotation, v);
    };
    const Vec3 v{1, 2, 3};
    EXPECT_NEAR(distance(rotated({{48, 30000}, {49, 50000}, {50, -20000}}, v),
                         rotated({{49, 50000}}, rotated({{48, 30000}}, rotated({{50, -20000}}, v)))),
                0, 1e-12);
}

TEST(Faps, EyesLookLeftAndDownAndStayOnTheirBalls) {
    const Fapu fapu = measure_fapu(neutral_points());
    const Take take = to_take(one_frame({{23, 30000}, {24, 30000}, {25, 20000}, {26, 20000}}), fapu);
    for (const auto& [pupil, centre] : {std::pair("3.5", fapu.left_eye), std::pair("3.6", fapu.right_eye)}) {
        const Vec3 before = rest(fapu, pupil), after = place(take, pupil);
        EXPECT_GT(after.x, before.x);
        EXPECT_LT(after.y, before.y);
        EXPECT_NEAR(distance(after, centre), distance(before, centre), 1e-9);
    }
}

TEST(Faps, TheTongueRollsBothEdgesUpAndCarriesThemWithIt) {
    const Fapu fapu = measure_fapu(neutral_points());
    const Take rolled = to_take(one_frame({{47, 50000}}), fapu);
    EXPECT_GT(place(rolled, "6.3").y, rest(fapu, "6.3").y);
    EXPECT_NEAR(place(rolled, "6.3").y, place(rolled, "6.4").y, 1e-9);
    EXPECT_NEAR(place(rolled, "6.3").x, -place(rolled, "6.4").x, 1e-9);
    const Take raised = to_take(one_frame({{46, 1024}}), fapu);
    EXPECT_NEAR(place(raised, "6.3").y, rest(fapu, "6.3").y + fapu.mns, 1e-9);
}

TEST(Faps, TheTongueGoesWithTheJawAndItsOwnParametersAddToThat) {
    const Fapu fapu = measure_fapu(neutral_points());
    const Take open = to_take(one_frame({{3, 500}, {14, 100}, {15, 50}}), fapu);
    const Vec3 jaw = place(open, "2.1") - rest(fapu, "2.1");
    EXPECT_LT(jaw.y, 0);
    EXPECT_GT(jaw.z, 0);
    EXPECT_NE(jaw.x, 0);
    for (const char* point : {"6.1", "6.2", "6.3", "6.4"})
        EXPECT_NEAR(distance(place(open, point), rest(fapu, point) + jaw), 0, 1e-9) << point;
    const Take raised = to_take(one_frame({{3, 500}, {14, 100}, {15, 50}, {44, 300}, {46, 200}, {47, 30000}}), fapu);
    EXPECT_NEAR(place(raised, "6.1").y, place(open, "6.1").y + fapu.mns * 300 / 1024, 1e-9);
    EXPECT_NEAR(place(raised, "6.2").y, place(open, "6.2").y + fapu.mns * 200 / 1024, 1e-9);
    EXPECT_GT(place(raised, "6.3").y, place(open, "6.3").y + fapu.mns * 200 / 1024);
}

TEST(Faps, NothingIsSaidOfTheTongueWhileTheJawIsLost) {
    const Fapu fapu = measure_fapu(neutral_points());
    Take take;
    take.points = {"2.1", "6.1"};
    take.times = {0, 0.04};
    const Vec3 down{0, -fapu.mns / 2, 0};
    take.samples = {rest(fapu, "2.1") + down, rest(fapu, "6.1") + down, lost_sample, rest(fapu, "6.1") + down};
    const FapStream stream = to_faps(take, fapu);
    EXPECT_TRUE(stream.frames.at(0).mask[fap_index(44)]);
    EXPECT_EQ(stream.frames.at(0).value[fap_index(44)], 0);
    EXPECT_TRUE(stream.frames.at(1).mask.none());
}

TEST(Faps, OneStreamMovesAWideFaceAndANarrowOneInProportion) {
    std::vector<FeaturePoint> wide = neutral_points();
    for (FeaturePoint& point : wide) point.position.x *= 1.5;
    const Fapu narrow_fapu = measure_fapu(neutral_points()), wide_fapu = measure_fapu(wide);
    const FapStream smile = one_frame({{53, 300}, {54, 300}, {37, 100}, {59, 200}});
    const Take a = to_take(smile, narrow_fapu), b = to_take(smile, wide_fapu);
    for (std::size_t c = 0; c < a.points.size(); ++c) {
        if (a.points[c] == "3.5" || a.points[c] == "3.6") continue;
        EXPECT_NEAR(1.5 * a.samples[c].x, b.samples[c].x, 1e-9);
        EXPECT_NEAR(a.samples[c].y, b.samples[c].y, 1e-9);
    }
}

// Turns up to three tenths of the table's limits, which themselves are turns of half a circle and more.
TEST(Faps, ParametersComeBackFromTheirTake) {
    const Fapu fapu = measure_fapu(neutral_points());
    std::mt19937 random(1);
    const FapStream stream = random_faps(random, 200, 0.3);
    const FapStream again = to_faps(to_take(stream, fapu), fapu);
    EXPECT_EQ(again.rate, stream.rate);
    ASSERT_EQ(again.frames.size(), stream.frames.size());
    for (std::size_t f = 0; f < stream.frames.size(); ++f) {
        EXPECT_EQ(again.frames[f].number, f);
        EXPECT_EQ(largest_difference(again.frames[f], stream.frames[f]), 0) << f;
    }
}

class FapsOnRealHeads : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(FapsOnRealHeads, ParametersComeBackWithinOneUnit) {
    const std::filesystem::path data = std::filesystem::path(MIEN_SHARED) / "data";
    if (!std::filesystem::exists(data / GetParam().first)) GTEST_SKIP() << "the head is not there";
    const Face face = read_face(data / GetParam().first, data / GetParam().second);
    const Fapu fapu = measure_fapu(face);
    std::mt19937 random(2);
    const FapStream stream = random_faps(random, 50, 0.3);
    const FapStream again = to_faps(to_take(stream, fapu), fapu);
    for (std::size_t f = 0; f < stream.frames.size(); ++f) {
        FapFrame sent = stream.frames[f];
        sent.mask &= again.frames[f].mask;  // what the head has points for
        EXPECT_GT(sent.mask.count(), 50U);
        for (std::size_t i = 0; i < fap_count; ++i)
            if (!sent.mask[i]) sent.value[i] = 0;
        const int difference = largest_difference(again.frames[f], sent);
        EXPECT_GE(difference, 0);
        EXPECT_LE(difference, 1);
    }
}

INSTANTIATE_TEST_SUITE_P(
    Heads, FapsOnRealHeads,
    testing::Values(std::pair("mh-caucasian/mh-caucasian-female.obj", "mh-caucasian/points-obj.json"),
                    std::pair("mh-caucasian/mh-caucasian-male.obj", "mh-caucasian/points-obj.json"),
                    std::pair("ict/ict_neutral.obj", "ict/feature_points.json"),
                    std::pair("suzanne/suzi.glb", "suzanne/points.json")));

// The axes on which parameters move a point.
std::array<bool, 3> reach(std::string_view point) {
    std::array<bool, 3> axes{};
    for (const Fap& fap : faps)
        if (fap.point == point && fap.axis >= FapAxis::x && fap.axis <= FapAxis::z)
            axes[static_cast<std::size_t>(fap.axis) - static_cast<std::size_t>(FapAxis::x)] = true;
    return axes;
}

TEST(Faps, ATakeComesBackAlongTheAxesThatParametersHave) {
    const Fapu fapu = measure_fapu(neutral_points());
    std::mt19937 random(3);
    std::normal_distribution<double> shake(0, 3);
    Take take;
    for (const FeaturePoint& point : fapu.points) take.points.push_back(point.id);
    for (int r = 0; r < 20; ++r) {
        take.times.push_back(r / 30.0);
        for (const FeaturePoint& point : fapu.points)
            take.samples.push_back(point.position + Vec3{shake(random), shake(random), shake(random)});
    }
    const Take again = to_take(to_faps(take, fapu), fapu);
    const double half_unit = 0.5 * 64 / 1024 + 1e-9;  // of the largest unit
    for (std::size_t r = 0; r < 20; ++r)
        for (const FeaturePoint& point : fapu.points) {
            const Vec3 was = place(take, point.id, r), is = place(again, point.id, r);
            if (point.id == "3.5" || point.id == "3.6") {
                EXPECT_LT(distance(was, is), 2 * half_unit);  // two turns and a thrust reach every place
            } else if (point.id != "6.3" && point.id != "6.4") {
                const auto axes = reach(point.id);
                const bool is_in_jaw = point.id.starts_with("6.");
                const Vec3 jaw = is_in_jaw ? place(again, "2.1", r) - rest(fapu, "2.1") : Vec3{};
                const Vec3 left = point.position + jaw;  // where it lies that no parameter moves
                EXPECT_NEAR(is.x, axes[0] ? was.x : left.x, half_unit) << point.id;
                EXPECT_NEAR(is.y, axes[1] ? was.y : left.y, half_unit) << point.id;
                EXPECT_NEAR(is.z, axes[2] ? was.z : left.z, half_unit) << point.id;
            }
        }
}

TEST(Faps, WhatIsLostOrHasNoColumnIsNotSent) {
    const Fapu fapu = measure_fapu(neutral_points());
    Take take;
    take.points = {"8.3", "8.4", "dimple"};
    take.times = {0, 0.04};
    take.samples = {rest(fapu, "8.3"), rest(fapu, "8.4"), {}, rest(fapu, "8.3"), lost_sample, {}};
    const FapStream stream = to_faps(take, fapu);
    EXPECT_EQ(stream.rate, 25);
    FapMask both;
    for (const int fap : {53, 54, 59, 60}) both.set(fap_index(fap));
    EXPECT_EQ(stream.frames.at(0).mask, both);
    both.reset(fap_index(54)), both.reset(fap_index(60));
    EXPECT_EQ(stream.frames.at(1).mask, both);
}

TEST(Faps, AnotherRateTakesTheNearestRows) {
    const Fapu fapu = measure_fapu(neutral_points());
    Take take;
    take.points = {"8.3"};
    for (int r = 0; r < 61; ++r) {
        take.times.push_back(100 + r / 60.0);
        take.samples.push_back(rest(fapu, "8.3") + Vec3{r * fapu.mw / 1024, 0, 0});
    }
    const FapStream stream = to_faps(take, fapu, {.rate = 25});
    EXPECT_EQ(stream.rate, 25);
    ASSERT_EQ(stream.frames.size(), 26U);
    for (std::size_t f = 0; f < 26; ++f) {
        EXPECT_EQ(stream.frames[f].number, f);
        EXPECT_NEAR(stream.frames[f].value[fap_index(53)], static_cast<double>(f) * 60 / 25, 0.5 + 1e-6);
    }
    const FapStream fast = to_faps(take, fapu, {.rate = 120});
    ASSERT_EQ(fast.frames.size(), 61U);  // what lies between the rows is left out
    EXPECT_EQ(fast.frames[60].number, 120U);
    EXPECT_THROW(to_faps(take, fapu, {.rate = -1}), Error);
    EXPECT_THROW(to_faps(Take{}, fapu), Error);
    take.times.back() = 1e30;
    EXPECT_THROW(to_faps(take, fapu), Error);
}

TEST(Faps, OneRowIsOneFrame) {
    const Fapu fapu = measure_fapu(neutral_points());
    const Take take = to_take(one_frame({{3, 77}}), fapu);
    const FapStream stream = to_faps(take, fapu);
    ASSERT_EQ(stream.frames.size(), 1U);
    EXPECT_EQ(stream.frames[0].value[2], 77);
}

TEST(Faps, AMirroredPerformanceHasMirroredParameters) {
    const Fapu fapu = measure_fapu(neutral_points());
    std::mt19937 random(4);
    const FapStream stream = random_faps(random, 20, 0.2);
    const Take take = to_take(stream, fapu);
    Take mirrored = take;
    for (std::size_t r = 0; r < row_count(take); ++r) {
        for (std::size_t c = 0; c < take.points.size(); ++c) {
            const Vec3 p = row(take, r)[c];
            row(mirrored, r)[*find_column(take, mirror_point(take.points[c]))] = {-p.x, p.y, p.z};
        }
        const Quaternion q = take.head[r].rotation;
        mirrored.head[r] = {{q.x, -q.y, -q.z, q.w}, {}};
    }
    const FapStream other = to_faps(mirrored, fapu);
    for (std::size_t r = 0; r < row_count(take); ++r)
        for (int n = 3; n <= 68; ++n) {
            if (fap_info(n).axis == FapAxis::scale) continue;
            EXPECT_NEAR(other.frames[r].value[fap_index(fap_info(n).mirror)],
                        fap_info(n).mirror_sign * stream.frames[r].value[fap_index(n)], 1)
                << fap_info(n).name;
        }
}

}  // namespace
}  // namespace mien
