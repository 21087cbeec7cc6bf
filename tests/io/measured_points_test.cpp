// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/io/measured_points.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "io/hostile.hpp"

namespace mien {
namespace {

using testing::HasSubstr;

std::string refusal(std::string_view text) {
    return hostile::refusal(parse_measured_points, text);
}

TEST(MeasuredPoints, ReadsPlacesAndWhatAPictureDoesNotShow) {
    for (const char* text : {R"({"8.4": [1, 2.5, -3], "_note": 1, "2.1": [null, 4, 5]})",
                             R"({"points": {"8.4": [1, 2.5, -3], "2.1": [null, 4, 5], "_x": 0}})"}) {
        const auto points = parse_measured_points(hostile::Copy(text).bytes());
        ASSERT_EQ(points.size(), 2U);
        EXPECT_EQ(points[0].id, "8.4");
        EXPECT_EQ(points[0].place, (Vec3{1, 2.5, -3}));
        EXPECT_TRUE(std::isnan(points[1].place.x));
        EXPECT_EQ(points[1].place.z, 5);
    }
}

TEST(MeasuredPoints, RefusesWhatIsNoPlaceAndNamesIt) {
    EXPECT_THAT(refusal("{}"), HasSubstr("found none"));
    EXPECT_THAT(refusal("[]"), HasSubstr("measured points"));
    EXPECT_THAT(refusal(R"({"points": 3})"), HasSubstr("/points"));
    EXPECT_THAT(refusal(R"({"8.4": 17})"), HasSubstr("/8.4: expected [x, y, z]"));
    EXPECT_THAT(refusal(R"({"8.4": [1, 2]})"), HasSubstr("/8.4"));
    EXPECT_THAT(refusal(R"({"points": {"8.4": [1, "2", 3]}})"), HasSubstr("/points/8.4"));
    EXPECT_THAT(refusal(R"({"8.4": [null, null, null]})"), HasSubstr("/8.4"));
    EXPECT_THAT(refusal(R"({"8.4": [1, 2, 1e300]})"), HasSubstr("/8.4"));
    EXPECT_THAT(refusal(R"({"8.4": [1, 2, 3], "8.4": [1, 2, 3]})"), HasSubstr("8.4"));
}

TEST(MeasuredPoints, SurvivesEveryPrefixAndEveryChangedByte) {
    hostile::sweep(parse_measured_points, R"({"points": {"8.4": [1, 2.5, -3], "2.1": [null, 4, 5]}})",
                   [](const std::vector<MeasuredPoint>& points) { return !points.empty(); });
}

}  // namespace
}  // namespace mien
