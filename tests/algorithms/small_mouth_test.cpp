// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The muzzle of a monkey and the jaw of a person: a mouth a quarter as wide as the performer's opens without tearing.

#include "algorithms/small_mouth.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <iostream>

#include "algorithms/generic_face.hpp"
#include "retarget_faces.hpp"

#include "mien/algorithms/head.hpp"
#include "mien/algorithms/tracks.hpp"
#include "mien/io/read.hpp"
#include "mien/take.hpp"

namespace mien {
namespace {

constexpr const char* ids[] = {"2.1", "2.11", "2.12", "3.7", "3.8", "3.11", "3.12", "4.1", "4.2", "8.1",
                               "8.2", "8.3",  "8.4",  "8.7", "8.8", "9.1",  "9.2",  "9.3", "9.15"};

bool is_mouth(std::string_view id) {
    return id.starts_with("2.") || id.starts_with("8.");
}

// A face of ordinary proportions, its mouth and chin drawn together to a point below the nose.
Face muzzle(double width) {
    const Vec3 middle = 0.5 * (*generic_position("8.3") + *generic_position("8.4"));
    Face face;
    for (const char* id : ids) {
        const Vec3 p = *generic_position(id);
        face.points.push_back({id, 0, is_mouth(id) ? middle + width * (p - middle) : p, {}, 0});
    }
    return face;
}

// A jaw that opens: the chin sinks, the lower lip goes with it, the brows rise.
Take opening_jaw() {
    Take take;
    take.times = {0, 1};
    for (const FeaturePoint& point : muzzle(1).points) {
        take.points.push_back(point.id);
        take.samples.push_back(point.position);
    }
    for (std::size_t i = 0; i < take.points.size(); ++i) {
        const std::string& id = take.points[i];
        const bool sinks = id.starts_with("2.") || id == "8.2" || id == "8.7" || id == "8.8";
        const double way = sinks ? -0.5 : id.starts_with("4.") ? 0.1 : 0;
        take.samples.push_back(take.samples[i] + Vec3{0, way, 0});
    }
    return take;
}

Vec3 way(const Take& take, const char* id) {
    const std::size_t c = *find_column(take, id);
    return row(take, 1)[c] - row(take, 0)[c];
}

Take performed(double width, RetargetMethod method = RetargetMethod::local_affine) {
    const Take take = opening_jaw();
    RetargetOptions options;
    options.method = method;
    options.contact = false;
    return retarget(fit_retarget(take, muzzle(width), options), take);
}

TEST(SmallMouth, MovesInFullDownToFourFifthsOfTheWidthAndInProportionBelow) {
    EXPECT_EQ(mouth_share(2, 1), 1);
    EXPECT_EQ(mouth_share(0.8, 1), 1);
    EXPECT_DOUBLE_EQ(mouth_share(0.4, 1), 0.5);
    EXPECT_DOUBLE_EQ(mouth_share(0.2, 0.5), 0.5);
    EXPECT_EQ(mouth_share(0.2, 0), 1);  // nothing to go by
}

TEST(SmallMouth, OpensByWhatItsOwnWidthBears) {
    const double usual = length(way(performed(1), "8.2"));
    EXPECT_NEAR(usual, 0.5, 1e-9);  // a face onto itself
    for (const double width : {0.2, 0.3, 0.5})
        EXPECT_LE(length(way(performed(width), "8.2")), width / 0.8 * usual) << width;
}

TEST(SmallMouth, ANarrowerMouthNeverOpensFurther) {
    double last = 0;
    for (int i = 1; i <= 20; ++i) {
        const double here = length(way(performed(0.05 * i), "8.2"));
        EXPECT_GT(here, last) << i;
        EXPECT_LT(here, last + 0.1) << i;  // and at the threshold it does not jump
        last = here;
    }
}

TEST(SmallMouth, LeavesBrowsAlone) {
    const Take take = opening_jaw();
    Retarget map = fit_retarget(take, muzzle(1));
    const Retarget before = map;
    map.target_neutral[*find_column(take, "8.3")] = map.target_neutral[*find_column(take, "8.4")] + Vec3{0.1, 0, 0};
    fit_small_mouth(map, {});
    for (std::size_t i = 0; i < map.points.size(); ++i) {
        const bool same = map.local[i][0].x == before.local[i][0].x;
        EXPECT_EQ(same, map.points[i].starts_with("3.") || map.points[i].starts_with("4.")) << map.points[i];
    }
}

TEST(SmallMouth, AMapWithoutCornersOfTheMouthStaysAsItIs) {
    const Take take = opening_jaw();
    Retarget map = fit_retarget(take, muzzle(0.3));
    for (std::string& id : map.points)
        if (id == "8.3") id = "8.5";
    const Retarget before = map;
    fit_small_mouth(map, {});
    for (std::size_t i = 0; i < map.points.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(map.local[i][k].y, before.local[i][k].y);
}

TEST(SmallMouth, ActsInItsOwnWidthInTheUnitsOfMpeg4Too) {
    // The distance from the nose stays as it is, and with it MNS.
    const double usual = length(way(performed(1, RetargetMethod::fapu), "8.2"));
    for (const double width : {0.2, 0.3, 0.5})
        EXPECT_LE(length(way(performed(width, RetargetMethod::fapu), "8.2")), 1.0001 * width / 0.8 * usual) << width;
}

// The lower lip of a monkey lies a tenth of an eye distance above the chin, a performer's a third.
TEST(SmallMouth, OnAMonkeyThePerformersLowerLipNeverPassesTheChin) {
    const std::filesystem::path data = faces::folder(), take_file = data / "markers-41/jaw.trc";
    if (!std::filesystem::exists(take_file)) GTEST_SKIP() << take_file << " is not there";
    const faces::Points monkey = faces::from_glb("suzanne/suzi.glb", "suzanne/points.json");
    const auto markers = nlohmann::json::parse(faces::contents("markers-41/markers-to-fdp.json")).at("markers");
    std::vector<Rename> names;
    for (const auto& [marker, id] : markers.items())
        if (id.is_string()) names.push_back({marker, id});
    const Take take = remove_head_motion(rename_points(read_take(take_file), names));
    const Take out = faces::performed(take, monkey);
    const std::size_t lip = *find_column(out, "8.2"), chin = *find_column(out, "2.1"), top = *find_column(out, "8.1");
    double nearest = 1, tallest = 0;
    const double mouth = distance(monkey.at("8.3"), monkey.at("8.4"));
    for (std::size_t r = 0; r < row_count(out); ++r) {
        nearest = std::min(nearest, row(out, r)[lip].y - row(out, r)[chin].y);
        tallest = std::max(tallest, row(out, r)[top].y - row(out, r)[lip].y);
    }
    std::cout << fmt::format("lip above the chin by {:.3f}, mouth open by {:.2f} of its width\n",
                             nearest / faces::eyes(monkey), tallest / mouth);
    EXPECT_GT(nearest, 0.02 * faces::eyes(monkey));
    EXPECT_LT(tallest, 1.5 * mouth);
}

}  // namespace
}  // namespace mien
