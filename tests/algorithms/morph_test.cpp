// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/morph.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <limits>
#include <string>

#include "algorithms/fap_face.hpp"

#include "mien/algorithms/rig_biharmonic.hpp"
#include "mien/error.hpp"
#include "mien/io/read.hpp"

namespace mien {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

// A sheet of squares, 2 wide, with points near its corners and in its middle.
Face sheet() {
    constexpr std::uint32_t n = 17;
    Face face;
    for (std::uint32_t y = 0; y < n; ++y)
        for (std::uint32_t x = 0; x < n; ++x)
            face.mesh.positions.push_back({static_cast<float>(x) / 8 - 1, static_cast<float>(y) / 8 - 1, 0});
    for (std::uint32_t y = 0; y + 1 < n; ++y)
        for (std::uint32_t x = 0; x + 1 < n; ++x) {
            const std::uint32_t a = y * n + x;
            add_face(face.mesh, std::array<std::uint32_t, 4>{a, a + 1, a + n + 1, a + n});
        }
    const std::pair<const char*, std::uint32_t> points[] = {
        {"3.7", 13 * n + 13}, {"3.8", 13 * n + 3}, {"8.3", 3 * n + 13}, {"8.4", 3 * n + 3}, {"9.3", 8 * n + 8}};
    for (const auto& [id, v] : points) face.points.push_back({id, v, to_double(face.mesh.positions[v]), {}, 0});
    return face;
}

Rig bound(const Face& face) {
    BiharmonicOptions all;
    all.influences = 0;
    return rig_biharmonic(face, all);
}

std::vector<MeasuredPoint> measured(const Face& face) {
    std::vector<MeasuredPoint> points;
    for (const FeaturePoint& point : face.points) points.push_back({point.id, point.position});
    return points;
}

TEST(Morph, AHeadMorphedToItsOwnPointsStaysBitForBit) {
    const Face face = sheet();
    EXPECT_EQ(morph(bound(face), measured(face)), face.mesh.positions);
}

TEST(Morph, EveryMeasuredPointIsMet) {
    const Face face = sheet();
    std::vector<MeasuredPoint> to = measured(face);
    to[0].place += Vec3{0.1, -0.05, 0.2};
    to[4].place += Vec3{-0.05, 0.1, 0.3};
    const std::vector<Vec3f> positions = morph(bound(face), to);
    for (std::size_t i = 0; i < to.size(); ++i)
        EXPECT_LT(distance(to_double(positions[face.points[i].vertex]), to[i].place), 1e-6) << to[i].id;
}

TEST(Morph, AHeadElsewhereLargerAndTurnedIsTheSameHead) {
    const Face face = sheet();
    const auto elsewhere = [](const Vec3& p) { return Vec3{5 - 3 * p.y, 7 + 3 * p.x, 3 * p.z - 2}; };
    std::vector<MeasuredPoint> to = measured(face);
    for (MeasuredPoint& point : to) point.place = elsewhere(point.place);
    const std::vector<Vec3f> positions = morph(bound(face), to);
    for (std::size_t v = 0; v < positions.size(); ++v)
        EXPECT_LT(distance(to_double(positions[v]), elsewhere(to_double(face.mesh.positions[v]))), 1e-5);
}

TEST(Morph, TwoPicturesOfAHeadAreAsGoodAsItsPoints) {
    const Face face = sheet();
    std::vector<MeasuredPoint> to = measured(face);
    to[4].place += Vec3{0.1, 0.1, 0.4};
    std::vector<std::vector<MeasuredPoint>> pictures{to, to};
    for (MeasuredPoint& point : pictures[0]) point.place.z = none;
    for (MeasuredPoint& point : pictures[1]) point.place.x = none;
    const std::vector<Vec3f> both = morph(bound(face), merged(pictures)), whole = morph(bound(face), to);
    EXPECT_EQ(both, whole);
}

TEST(Morph, AFrontViewAloneKeepsTheDepthOfTheGenericHead) {
    const Face face = sheet();
    std::vector<MeasuredPoint> to = measured(face);
    for (MeasuredPoint& point : to) point.place = {2 * point.place.x, 2 * point.place.y, none};
    to[4].place.x += 0.2;
    for (const Vec3f& p : morph(bound(face), to)) EXPECT_LT(std::abs(p.z), 1e-6);
}

TEST(Morph, WhatTellsTooLittleIsRefused) {
    const Face face = sheet();
    const Rig rig = bound(face);
    EXPECT_THROW(morph(rig, {}), Error);
    EXPECT_THROW(morph(rig, std::vector<MeasuredPoint>{{"4.1", {1, 2, 3}}}), Error);
    EXPECT_THROW(morph(rig, std::vector<MeasuredPoint>{{"9.3", {1, 2, none}}, {"8.3", {none, 2, 3}}}), Error);
    std::vector<MeasuredPoint> line = measured(face);
    for (MeasuredPoint& point : line) point.place = {point.place.x + point.place.y, 0, 0};
    EXPECT_THROW(morph(rig, line), Error);
}

TEST(Morph, MergedCoordinatesAreTheMeanOfThoseThatWereMeasured) {
    const std::vector<std::vector<MeasuredPoint>> pictures{{{"9.3", {1, 2, none}}},
                                                           {{"9.3", {none, 4, 5}}, {"2.1", {none, 1, 2}}}};
    const std::vector<MeasuredPoint> both = merged(pictures);
    ASSERT_EQ(both.size(), 2U);
    EXPECT_EQ(both[0].place, (Vec3{1, 3, 5}));
    EXPECT_TRUE(std::isnan(both[1].place.x));
    EXPECT_EQ(both[1].place.z, 2);
}

TEST(Morph, EyeballsKeepTheirShapeAndGoWithTheEyeAndItsRig) {
    const Face face = face_with_eyeballs();
    const Rig rig = bound(face);
    ASSERT_EQ(rig.eyeballs.size(), 2U);
    std::vector<MeasuredPoint> to = measured(face);
    for (MeasuredPoint& point : to)
        if (point.id.starts_with("3.") && point.place.x > 0) point.place += Vec3{4, 2, 0};
    const std::vector<Vec3f> positions = morph(rig, to);
    const Rig carried = carried_over(rig, positions);
    for (std::size_t b = 0; b < 2; ++b) {
        const Eyeball &before = rig.eyeballs[b], &after = carried.eyeballs[b];
        std::vector<double> ratios;
        for (const std::uint32_t v : before.vertices)
            ratios.push_back(distance(to_double(positions[v]), after.centre) /
                             distance(to_double(rig.rest[v]), before.centre));
        const auto [least, most] = std::minmax_element(ratios.begin(), ratios.end());
        EXPECT_NEAR(*least, *most, 0.02);
    }
    const auto far = [&](std::size_t b) { return distance(carried.eyeballs[b].centre, rig.eyeballs[b].centre); };
    const std::size_t left = rig.eyeballs[0].centre.x > 0 ? 0 : 1;
    EXPECT_GT(far(left), far(1 - left) + 2);
    EXPECT_EQ(carried.weights, rig.weights);
    EXPECT_EQ(carried.rest, positions);
}

class MorphOnAFaceModel : public testing::TestWithParam<const char*> {};

// The mean over all vertices that are no feature points.
double mean_distance(const std::vector<Vec3f>& a, const std::vector<Vec3f>& b,
                     const std::vector<FeaturePoint>& points) {
    std::vector<bool> is_point(a.size(), false);
    for (const FeaturePoint& point : points) is_point[point.vertex] = true;
    double sum = 0, count = 0;
    for (std::size_t v = 0; v < a.size(); ++v) {
        if (is_point[v]) continue;
        sum += distance(to_double(a[v]), to_double(b[v]));
        ++count;
    }
    return sum / count;
}

Vec3 normal(const Mesh& mesh, const std::vector<Vec3f>& positions, std::size_t f) {
    const auto corners = face(mesh, f);
    Vec3 sum;
    for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
        const Vec3 a = to_double(positions[corners[0]]);
        sum += cross(to_double(positions[corners[k]]) - a, to_double(positions[corners[k + 1]]) - a);
    }
    return sum;
}

TEST_P(MorphOnAFaceModel, TheGenericHeadComesNearToSomebodyElseAndNothingFlips) {
    const std::filesystem::path folder = std::filesystem::path(MIEN_SHARED) / "data/ict";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "the face model is not there";
    const Face generic = read_face(folder / "ict_neutral.obj", folder / "feature_points.json");
    const Face other = read_face(folder / (std::string(GetParam()) + ".obj"), folder / "feature_points.json");
    const std::vector<Vec3f> positions = morph(bound(generic), measured(other));
    for (const FeaturePoint& point : other.points)
        EXPECT_LT(distance(to_double(positions[point.vertex]), point.position), 2e-6) << point.id;
    const double before = mean_distance(generic.mesh.positions, other.mesh.positions, other.points);
    const double after = mean_distance(positions, other.mesh.positions, other.points);
    RecordProperty("nearer_by_percent", static_cast<int>(100 * (1 - after / before)));
    EXPECT_LT(after, 0.6 * before);
    for (std::size_t f = 0; f < face_count(generic.mesh); ++f)
        EXPECT_GT(dot(normal(generic.mesh, generic.mesh.positions, f), normal(generic.mesh, positions, f)), 0);
}

INSTANTIATE_TEST_SUITE_P(People, MorphOnAFaceModel, testing::Values("ict_identity_a", "ict_identity_b"));

}  // namespace
}  // namespace mien
