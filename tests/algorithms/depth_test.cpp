// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/depth.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <iostream>

#include "retarget_faces.hpp"

namespace mien {
namespace {

using faces::Frames;
using faces::Points;

Points drawn_face() {
    return {{"3.7", {7.2, 0.1, 0}},   {"3.11", {2.8, -0.1, 0}},  {"3.12", {-7.2, 0.1, 0}}, {"3.8", {-2.8, -0.1, 0}},
            {"8.3", {4.1, -10.8, 0}}, {"8.4", {-4.1, -10.8, 0}}, {"2.1", {0, -17.4, 0}},   {"2.3", {0, -10.8, 0}},
            {"8.2", {0, -12.2, 0}},   {"9.3", {0, -4.7, 0}},     {"4.1", {2, 4.2, 0}},     {"4.2", {-2, 4.2, 0}}};
}

Take picture_of(const Points& rest, const Frames& frames) {
    Take take = faces::take_of(rest, frames);
    for (Vec3& p : take.samples) p.z = 0;
    take.planar = true;
    return take;
}

// A jaw that drops and smiles a little.
Frames speaking() {
    Points open{{"2.1", {0, -3, 0}}, {"2.3", {0, -2.4, 0}}, {"8.2", {0, -2.4, 0}}, {"8.3", {0.4, 0.2, 0}}};
    return {open, {}};
}

double depth(const Take& take, std::size_t r, const char* id) {
    return row(take, r)[*find_column(take, id)].z - row(take, 0)[*find_column(take, id)].z;
}

TEST(WithDepth, a_jaw_that_drops_goes_back_and_rest_is_rest) {
    const Take out = with_depth(picture_of(drawn_face(), speaking()));
    EXPECT_FALSE(out.planar);
    EXPECT_LT(depth(out, 1, "2.1"), -0.5);
    EXPECT_LT(depth(out, 1, "2.3"), -0.3);
    EXPECT_NEAR(depth(out, 1, "4.1"), 0, 0.1);
    for (const std::string& id : out.points) EXPECT_EQ(depth(out, 2, id.c_str()), 0);
}

TEST(WithDepth, the_neutral_is_as_deep_as_an_ordinary_face) {
    const Take out = with_depth(picture_of(drawn_face(), {}));
    const auto z = [&](const char* id) { return row(out, 0)[*find_column(out, id)].z; };
    EXPECT_GT(z("9.3"), z("2.3"));
    EXPECT_GT(z("2.3"), z("8.3"));
    EXPECT_GT(z("8.3"), z("3.7"));
}

TEST(WithDepth, x_and_y_stay_as_they_were_seen) {
    const Take take = picture_of(drawn_face(), speaking());
    const Take out = with_depth(take);
    for (std::size_t i = 0; i < take.samples.size(); ++i) {
        EXPECT_EQ(out.samples[i].x, take.samples[i].x);
        EXPECT_EQ(out.samples[i].y, take.samples[i].y);
    }
}

TEST(WithDepth, a_picture_moved_scaled_turned_or_upside_down_has_the_same_depth) {
    const Take take = picture_of(drawn_face(), speaking());
    const Take before = with_depth(take);
    const auto changed = [&](double unit, const std::function<Vec3(const Vec3&)>& change) {
        Take other = take;
        for (Vec3& p : other.samples) p = change(p);
        const Take out = with_depth(other);
        for (std::size_t i = 0; i < out.samples.size(); ++i)
            EXPECT_NEAR(out.samples[i].z, unit * before.samples[i].z, 1e-9 * unit);
    };
    changed(1, [](const Vec3& p) { return p + Vec3{300, -200, 0}; });
    changed(20, [](const Vec3& p) { return 20.0 * p; });
    changed(1, [](const Vec3& p) { return rotate({0, 0, 0.1, std::sqrt(0.99)}, p); });
    changed(1, [](const Vec3& p) { return Vec3{p.x, 240 - p.y, 0}; });
}

TEST(WithDepth, a_picture_with_y_down_comes_out_with_y_up) {
    Take take = picture_of(drawn_face(), speaking());
    for (Vec3& p : take.samples) p.y = -p.y;
    const Take out = with_depth(take);
    EXPECT_GT(row(out, 0)[*find_column(out, "4.1")].y, row(out, 0)[*find_column(out, "2.1")].y);
}

TEST(WithDepth, lost_samples_stay_lost_and_hardly_change_the_others) {
    Take take = picture_of(drawn_face(), speaking());
    const Take before = with_depth(take);
    row(take, 1)[*find_column(take, "8.4")] = lost_sample;
    const Take out = with_depth(take);
    EXPECT_FALSE(is_finite(row(out, 1)[*find_column(out, "8.4")]));
    EXPECT_NEAR(depth(out, 1, "2.1"), depth(before, 1, "2.1"), 0.2);
}

TEST(WithDepth, takes_that_have_depth_or_no_known_points_come_back_as_they_are) {
    Take solid = picture_of(drawn_face(), speaking());
    solid.planar = false;
    EXPECT_EQ(with_depth(solid).samples, solid.samples);
    Take unknown = picture_of({{"a", {1, 2, 0}}, {"b", {3, 4, 0}}, {"c", {8, 8, 0}}}, {});
    EXPECT_EQ(with_depth(unknown).samples, unknown.samples);
    EXPECT_TRUE(with_depth(unknown).planar);
}

// Relative error of the motion in space, of depth alone, when x and y are right.
TEST(WithDepth, comes_nearer_to_the_truth_than_no_depth) {
    if (!std::filesystem::exists(faces::folder() / "ict"))
        GTEST_SKIP() << faces::folder() / "ict"
                     << " is not there";
    struct Row {
        const char* name;
        Frames frames;
        std::array<double, 3> limits;
    };
    const Points person = faces::person('a');
    std::map<std::string, Points> others = faces::shapes();
    for (const auto& [name, motion] : faces::open_shapes()) others.erase(name);
    for (const Row& test : {Row{"shapes it does not know", faces::single(others), {0.47, 0.45, 0.41}},
                            Row{"mixes of all shapes", faces::mixes(faces::shapes()), {0.40, 0.38, 0.38}},
                            Row{"slate 164", faces::recording("ns-slate164.csv", 10), {0.27, 0.28, 0.29}},
                            Row{"jm", faces::recording("jm-slate3.csv", 4), {0.23, 0.23, 0.23}}}) {
        std::string line = fmt::format("{:26} no depth, estimated:", test.name);
        for (std::size_t s = 0; s < 3; ++s) {
            constexpr const char* sets[] = {"all_skin", "vicon27", "dutreve21"};
            const Points rest = faces::with_ids(person, faces::point_set(sets[s]));
            const Take truth = faces::take_of(rest, test.frames), flat = picture_of(rest, test.frames);
            const double none = faces::relative_error(flat, truth),
                         found = faces::relative_error(with_depth(flat), truth);
            line += fmt::format("  {:.3f} {:.3f}", none, found);
            EXPECT_LE(found, test.limits[s]) << line;
        }
        std::cout << line << "\n";
    }
}

}  // namespace
}  // namespace mien
