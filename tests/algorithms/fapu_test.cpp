// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/fapu.hpp"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <initializer_list>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "algorithms/fap_face.hpp"

#include "mien/error.hpp"

namespace mien {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<FeaturePoint> without(std::vector<FeaturePoint> points, std::vector<std::string> ids) {
    std::erase_if(points, [&](const FeaturePoint& p) { return std::find(ids.begin(), ids.end(), p.id) != ids.end(); });
    return points;
}

TEST(MeasureFapu, UnitsAreTheDistancesOfTheStandard) {
    const Fapu fapu = measure_fapu(neutral_points());
    EXPECT_DOUBLE_EQ(fapu.es, 64);
    EXPECT_DOUBLE_EQ(fapu.irisd, 12);
    EXPECT_DOUBLE_EQ(fapu.ens, 50);
    EXPECT_DOUBLE_EQ(fapu.mns, 20);
    EXPECT_DOUBLE_EQ(fapu.mw, 52);
    EXPECT_EQ(fapu.neck, (Vec3{0, -40, -90}));
    EXPECT_THAT(fapu.estimated, IsEmpty());
    EXPECT_EQ(fapu.points.size(), neutral_points().size());
}

TEST(MeasureFapu, ScaleScalesEveryUnitAndAShiftChangesNone) {
    std::vector<FeaturePoint> points = neutral_points();
    for (FeaturePoint& point : points) point.position = 10.0 * point.position + Vec3{5, 1000, -3};
    const Fapu fapu = measure_fapu(points);
    EXPECT_NEAR(fapu.es, 640, 1e-9);
    EXPECT_NEAR(fapu.irisd, 120, 1e-9);
    EXPECT_NEAR(fapu.ens, 500, 1e-9);
    EXPECT_NEAR(fapu.mns, 200, 1e-9);
    EXPECT_NEAR(fapu.mw, 520, 1e-9);
}

TEST(MeasureFapu, WhatIsMissingIsEstimatedAndNamed) {
    const auto all = neutral_points();
    const auto told = [](const std::vector<FeaturePoint>& points, const char* part) {
        return testing::Value(measure_fapu(points).estimated, Contains(HasSubstr(part)));
    };
    EXPECT_TRUE(told(without(all, {"3.5"}), "ES: 3.5 or 3.6 is missing; taken from 3.7 and 3.11, and 3.8 and 3.12"));
    EXPECT_DOUBLE_EQ(measure_fapu(without(all, {"3.5"})).es, 64);
    EXPECT_TRUE(told(without(all, {"3.1", "3.4"}), "IRISD: neither eye has both lids"));
    EXPECT_THAT(measure_fapu(without(all, {"3.1"})).estimated, IsEmpty());  // the other eye serves
    EXPECT_TRUE(told(without(all, {"9.15"}), "ENS and MNS: 9.15 is missing"));
    EXPECT_TRUE(told(without(all, {"2.2"}), "MNS: 2.2 is missing or above the nose; taken from 2.4 and 2.5"));
    EXPECT_DOUBLE_EQ(measure_fapu(without(all, {"2.2", "2.4"})).mns, 20);  // the outer corners are as high
    EXPECT_TRUE(told(without(all, {"8.3"}), "MW: 8.3 or 8.4 is missing; taken from 2.4 and 2.5"));
    EXPECT_TRUE(told(without(all, {"8.3", "2.5"}), "MW: the corners of the mouth are missing"));
    EXPECT_TRUE(told(without(all, {"7.1"}), "centre of head turns: 7.1 is missing"));
}

TEST(MeasureFapu, EveryEstimateIsNearWhatIsThere) {
    const Fapu whole = measure_fapu(neutral_points());
    for (const auto& gone : std::vector<std::vector<std::string>>{{"3.5", "3.6"},
                                                                  {"3.5", "3.7"},
                                                                  {"3.1", "3.2"},
                                                                  {"9.15"},
                                                                  {"9.15", "9.4"},
                                                                  {"9.15", "9.4", "9.1"},
                                                                  {"9.15", "9.4", "9.1", "9.3"},
                                                                  {"2.2"},
                                                                  {"2.2", "2.4"},
                                                                  {"2.2", "2.4", "8.3"},
                                                                  {"8.3"},
                                                                  {"8.3", "2.4"}}) {
        const Fapu part = measure_fapu(without(neutral_points(), gone));
        EXPECT_NEAR(part.es / whole.es, 1, 0.2);
        EXPECT_NEAR(part.irisd / whole.irisd, 1, 0.2);
        EXPECT_NEAR(part.ens / whole.ens, 1, 0.2);
        EXPECT_NEAR(part.mns / whole.mns, 1, 0.35);
        EXPECT_NEAR(part.mw / whole.mw, 1, 0.2);
    }
}

TEST(MeasureFapu, UnitsStayPositiveWhateverTheLidsAndLipsDo) {
    std::vector<FeaturePoint> points = neutral_points();
    for (FeaturePoint& point : points)
        if (point.id == "3.1" || point.id == "3.2") point.position.y = -8;  // shut, and past the lower lid
    EXPECT_GT(measure_fapu(points).irisd, 0);
    EXPECT_THAT(measure_fapu(points).estimated, Contains(HasSubstr("the lids touch")));
    for (FeaturePoint& point : points)
        if (point.id == "2.2") point.position.y = 100;
    EXPECT_GT(measure_fapu(points).mns, 0);
}

TEST(MeasureFapu, APointCloudWithoutEyesStillHasASizeAndOnePointHasNone) {
    const std::vector<FeaturePoint> mouth = {{"8.3", 0, {26, -75, 0}, {}, 0}, {"8.4", 0, {-26, -75, 0}, {}, 0}};
    const Fapu fapu = measure_fapu(mouth);
    for (const double unit : {fapu.es, fapu.irisd, fapu.ens, fapu.mns, fapu.mw}) EXPECT_GT(unit, 0);
    EXPECT_DOUBLE_EQ(fapu.mw, 52);
    EXPECT_THROW(measure_fapu(std::span(mouth).first(1)), Error);
    EXPECT_THROW(measure_fapu(std::vector<FeaturePoint>{}), Error);
}

TEST(MeasureFapu, AFaceThatLooksTheOtherWayIsRefused) {
    std::vector<FeaturePoint> points = neutral_points();
    for (FeaturePoint& point : points) point.position.x = -point.position.x;
    EXPECT_THROW(measure_fapu(points), Error);
}

TEST(MeasureFapu, EyesTurnAboutPlacesBehindThePupils) {
    const Fapu fapu = measure_fapu(neutral_points());
    EXPECT_DOUBLE_EQ(fapu.left_eye.x, 32);
    EXPECT_DOUBLE_EQ(fapu.right_eye.x, -32);
    EXPECT_NEAR(fapu.left_eye.z, -12, 0.5);  // of a human eye, in millimetres
}

TEST(MeasureFapu, TheEyeballsOfTheMeshAreWhatTheEyesTurnAbout) {
    const Face face = face_with_eyeballs();
    const Fapu fapu = measure_fapu(face);
    EXPECT_NEAR(distance(fapu.left_eye, {32, 0, -11}), 0, 1e-3);
    EXPECT_NEAR(distance(fapu.right_eye, {-32, 0, -11}), 0, 1e-3);
}

TEST(MeasureFapu, LostSamplesOfARowAreNoPoints) {
    Take take;
    take.points = {"8.3", "8.4"};
    take.times = {0, 1};
    take.samples = {{1, 2, 3}, {4, 5, 6}, lost_sample, {7, 8, 9}};
    EXPECT_EQ(points_of_row(take, 0).size(), 2U);
    const auto points = points_of_row(take, 1);
    ASSERT_EQ(points.size(), 1U);
    EXPECT_EQ(points[0].id, "8.4");
    EXPECT_EQ(points[0].position, (Vec3{7, 8, 9}));
    EXPECT_THROW(points_of_row(take, 2), Error);
}

TEST(Fapu, UnitsThatComeFromOtherPointsAreNamed) {
    const auto uncertain = [](std::initializer_list<std::string_view> missing) {
        std::vector<FeaturePoint> points;
        for (const FeaturePoint& point : neutral_points())
            if (std::find(missing.begin(), missing.end(), point.id) == missing.end()) points.push_back(point);
        return measure_fapu(points).uncertain;
    };
    EXPECT_EQ(uncertain({}), std::vector<FapUnit>{});
    EXPECT_EQ(uncertain({"3.5"}), std::vector<FapUnit>{});  // the middles of the corners do as well
    EXPECT_EQ(uncertain({"3.5", "3.7"}), std::vector<FapUnit>{FapUnit::es});
    EXPECT_EQ(uncertain({"9.15"}), (std::vector<FapUnit>{FapUnit::ens, FapUnit::mns}));
    EXPECT_EQ(uncertain({"8.3"}), std::vector<FapUnit>{FapUnit::mw});
    EXPECT_EQ(uncertain({"3.1", "3.4"}), std::vector<FapUnit>{FapUnit::irisd});
}

TEST(Fapu, TheNeutralPointsOfATakeAreTheMeanOfItsNeutralRows) {
    Take take;
    take.points = {"8.3", "8.4", "2.1"};
    take.times = {0, 1};
    take.samples = {{1, 2, 3}, {0, 0, 0}, lost_sample, {3, 2, 3}, lost_sample, lost_sample};
    const std::vector<FeaturePoint> points = neutral_points(take, {.row = 0, .rows = 2});
    ASSERT_EQ(points.size(), 2U);
    EXPECT_EQ(points[0].position, (Vec3{2, 2, 3}));
    EXPECT_EQ(points[1].id, "8.4");
}

TEST(Restrained, MnsFollowsTheWidthWhereAMouthIsNarrowBesideItsDistanceFromTheNose) {
    Fapu fapu;
    fapu.es = 1, fapu.mns = 0.33, fapu.mw = 0.82;
    EXPECT_EQ(restrained(fapu).mns, 0.33);
    fapu.mw = 0.41;
    EXPECT_DOUBLE_EQ(restrained(fapu).mns, 0.33 * 0.5 / 0.8);
    EXPECT_EQ(restrained(fapu).mw, 0.41);
    EXPECT_DOUBLE_EQ(restrained(restrained(fapu)).mns, restrained(fapu).mns);
}

}  // namespace
}  // namespace mien
