// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The sample performance: a face that could be real, in a form that exercises every step after it.

#include "performance.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <set>

namespace mien::samples {
namespace {

const Head& head() {
    static const Head made = make_head(cast().front());
    return made;
}

const Performance& performance() {
    static const Performance made = perform(head());
    return made;
}

Vec3 at(std::size_t frame, const std::string& marker) {
    const Take& take = performance().take;
    return row(take, frame)[find_column(take, marker).value()];
}

std::size_t rows() {
    return row_count(performance().take);
}

// Distances of two markers over the take, without the rows where one is lost.
std::vector<double> distances(const std::string& a, const std::string& b) {
    std::vector<double> result;
    for (std::size_t r = 0; r < rows(); ++r)
        if (const double d = distance(at(r, a), at(r, b)); std::isfinite(d)) result.push_back(d);
    return result;
}

double change(const std::string& a, const std::string& b) {
    const auto all = distances(a, b);
    return *std::max_element(all.begin(), all.end()) - all.front();
}

double drop(const std::string& a, const std::string& b) {
    const auto all = distances(a, b);
    return all.front() - *std::min_element(all.begin(), all.end());
}

TEST(SamplePerformance, LastsEightSecondsAtSixtyRowsASecond) {
    EXPECT_EQ(rows(), 480U);
    EXPECT_NEAR(frame_rate(performance().take), 60, 1e-9);
    EXPECT_GE(performance().take.points.size(), 30U);
    EXPECT_EQ(performance().take.unit, "mm");
}

TEST(SamplePerformance, EveryMarkerHasItsOwnFeaturePointOfTheHead) {
    std::set<std::string> ids, known;
    for (const HeadPoint& p : head().points) known.insert(p.id);
    for (const Rename& name : performance().names) {
        EXPECT_TRUE(known.contains(name.to)) << name.from;
        ids.insert(name.to);
    }
    EXPECT_EQ(ids.size(), performance().take.points.size());
}

TEST(SamplePerformance, FirstRowIsCompleteAndLostSamplesAreShort) {
    for (const Vec3& p : row(performance().take, 0)) EXPECT_TRUE(is_finite(p));
    std::size_t lost = 0;
    for (const std::string& marker : performance().take.points) {
        std::size_t run = 0;
        for (std::size_t r = 0; r < rows(); ++r) {
            run = is_finite(at(r, marker)) ? 0 : run + 1;
            lost += run > 0;
            ASSERT_LE(run, 18U) << marker;
        }
    }
    EXPECT_GT(lost, 50U);
}

TEST(SamplePerformance, StartsAtRest) {
    for (const std::string& marker : performance().take.points)
        for (std::size_t r = 1; r < 15; ++r) ASSERT_EQ(at(r, marker), at(0, marker)) << marker;
}

TEST(SamplePerformance, HeadMarkersAreRigidAndTheHeadMoves) {
    for (const auto& [a, b] : {std::pair{"HeadTop", "HeadL"}, {"HeadTop", "HeadR"}, {"HeadL", "HeadR"}}) {
        const auto all = distances(a, b);
        EXPECT_NEAR(*std::max_element(all.begin(), all.end()), *std::min_element(all.begin(), all.end()), 1e-9);
    }
    double far = 0;
    for (std::size_t r = 0; r < rows(); ++r)
        if (is_finite(at(r, "HeadL"))) far = std::max(far, distance(at(r, "HeadL"), at(0, "HeadL")));
    EXPECT_GT(far, 10);
}

TEST(SamplePerformance, ActionsHaveTheSizeOfRealOnes) {
    EXPECT_NEAR(change("NoseTip", "ChinMid"), 31, 4) << "jaw";
    EXPECT_NEAR(change("LipUpMid", "LipLowMid"), 25, 4) << "lips part";
    EXPECT_GT(change("LMouthCorner", "RMouthCorner"), 14) << "smile";
    EXPECT_GT(drop("LMouthCorner", "RMouthCorner"), 12) << "pucker";
    EXPECT_GT(drop("LBrowInner", "RBrowInner"), 7) << "frown";
    EXPECT_NEAR(drop("LLidUp", "LLidLow"), distances("LLidUp", "LLidLow").front() * .98, .5) << "blink";
    EXPECT_GT(change("LBrowMid", "NoseBridge"), 5) << "brows up";
}

TEST(SamplePerformance, LidsAndLipsNeverCross) {
    for (std::size_t r = 0; r < rows(); ++r)
        for (const auto& [upper, lower] : {std::pair{"LLidUp", "LLidLow"},
                                           {"RLidUp", "RLidLow"},
                                           {"LipUpMid", "LipLowMid"},
                                           {"LLipUp", "LLipLow"},
                                           {"RLipUp", "RLipLow"}}) {
            const Vec3 up = at(r, "LBrowMid") - at(r, "LCheekBone"), gap = at(r, upper) - at(r, lower);
            ASSERT_FALSE(dot(up, gap) < 0) << upper << " row " << r;
        }
}

TEST(SamplePerformance, MotionIsSmooth) {
    // The fastest thing is a lid: its gap in 100 ms means at most about 3.5 mm a row.
    for (const std::string& marker : performance().take.points)
        for (std::size_t r = 1; r < rows(); ++r)
            ASSERT_FALSE(distance(at(r, marker), at(r - 1, marker)) > 4.5) << marker;
}

}  // namespace
}  // namespace mien::samples
