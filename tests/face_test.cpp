// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/face.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace mien {
namespace {

std::vector<FeaturePoint> points(std::initializer_list<std::pair<const char*, Vec3>> list) {
    std::vector<FeaturePoint> result;
    for (const auto& [id, position] : list) result.push_back({id, 0, position, {}, 0});
    return result;
}

TEST(Face, PointsAreFoundByTheirWholeId) {
    const auto list = points({{"2.1", {}}, {"2.10", {}}});
    EXPECT_EQ(find_point(list, "2.10"), 1U);
    EXPECT_EQ(find_point(list, "2"), std::nullopt);
}

TEST(Face, NamedPointsStayInTheOrderOfTheFace) {
    const Face face{{}, points({{"a", {}}, {"b", {}}, {"c", {}}})};
    const std::vector<std::string> ids = {"c", "nobody", "a"};
    const Face some = with_points(face, ids);
    ASSERT_EQ(some.points.size(), 2U);
    EXPECT_EQ(some.points[0].id, "a");
    EXPECT_EQ(some.points[1].id, "c");
}

TEST(Face, TheEyesAreTheMiddlesOfTheirCorners) {
    const auto list = points(
        {{"3.7", {5, 0, 0}}, {"3.11", {1, 0, 0}}, {"3.8", {-5, 0, 0}}, {"3.12", {-1, 0, 0}}, {"2.1", {0, -9, 0}}});
    EXPECT_DOUBLE_EQ(eye_distance(list), 6);
}

TEST(Face, PupilsServeWhereCornersAreMissingThenLidsThenOneLid) {
    const auto pupils = points({{"3.5", {3, 0, 0}}, {"3.6", {-3, 0, 0}}, {"3.1", {9, 0, 0}}, {"3.2", {-9, 0, 0}}});
    EXPECT_DOUBLE_EQ(eye_distance(pupils), 6);
    const auto lids = points({{"3.1", {3, 1, 0}}, {"3.3", {3, -1, 0}}, {"3.2", {-3, 1, 0}}, {"3.4", {-3, -1, 0}}});
    EXPECT_DOUBLE_EQ(eye_distance(lids), 6);
    EXPECT_DOUBLE_EQ(eye_distance(points({{"3.1", {3, 1, 0}}, {"3.2", {-3, 1, 0}}, {"8.1", {0, -4, 1}}})), 6);
}

TEST(Face, WithoutEyesTheSpreadOfThePointsServes) {
    EXPECT_DOUBLE_EQ(eye_distance(points({{"a", {10, 0, 0}}, {"b", {-10, 0, 0}}})), 6);
    EXPECT_EQ(eye_distance(points({{"a", {10, 0, 0}}})), 0);
    EXPECT_EQ(eye_distance({}), 0);
}

TEST(Face, MirrorPointsAreThoseOfTheStandard) {
    EXPECT_EQ(mirror_point("8.3"), "8.4");
    EXPECT_EQ(mirror_point("3.7"), "3.12");  // the outer corner of the left eye, and of the right
    EXPECT_EQ(mirror_point("2.1"), "2.1");
    EXPECT_EQ(mirror_point("2"), "");
    EXPECT_EQ(mirror_point("dimple"), "");
    std::ifstream file(std::filesystem::path(MIEN_SHARED) / "mpeg4/fdps.csv");
    if (!file) GTEST_SKIP() << "the table of the standard is not there";
    std::size_t count = 0;
    std::string line;
    std::getline(file, line);
    while (std::getline(file, line)) {
        if (line.ends_with('\r')) line.pop_back();
        const std::string id = line.substr(0, line.find(','));
        EXPECT_EQ(mirror_point(id), line.substr(line.rfind(',') + 1)) << line;
        ASSERT_LT(count, standard_points().size());
        EXPECT_EQ(standard_points()[count].id, id);
        ++count;
    }
    EXPECT_EQ(count, 84U);
}

TEST(Face, StandardPointsComeInMirroredPairs) {
    EXPECT_EQ(standard_points().size(), 84U);
    for (const StandardPoint& point : standard_points()) {
        EXPECT_EQ(mirror_point(point.mirror), point.id);
        EXPECT_EQ(point.side == Side::middle, point.mirror == point.id);
        for (const StandardPoint& other : standard_points())
            if (other.id == point.mirror && point.side != Side::middle) {
                EXPECT_NE(point.side, other.side) << point.id;
            }
    }
}

}  // namespace
}  // namespace mien
