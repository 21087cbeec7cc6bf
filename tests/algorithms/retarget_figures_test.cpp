// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// How far every way to retarget is from a known truth: the table of docs/methods.md.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <iostream>

#include "retarget_faces.hpp"

namespace mien {
namespace {

using faces::Frames;
using faces::Points;

struct Way {
    const char* name;
    RetargetOptions options;
};
const Way ways[] = {
    {"network as written", {RetargetMethod::rbf, Reading::paper, {}, false}},
    {"network with an affine term", {RetargetMethod::rbf, Reading::remedied, {}, false}},
    {"units of MPEG-4", {RetargetMethod::fapu, Reading::remedied, {}, false}},
    {"units of MPEG-4, contact", {RetargetMethod::fapu, Reading::remedied, {}, true}},
    {"one map per point", {RetargetMethod::local_affine, Reading::remedied, {}, false}},
    {"one map per point, contact", {}},
};

// Lids or lips that have passed through each other by more than a thousandth of the eye distance, and more than at
// rest.
bool crosses(const Take& take, std::size_t r, double eyes) {
    constexpr const char* pairs[][2] = {{"3.1", "3.3"}, {"3.2", "3.4"}, {"2.2", "2.3"}, {"2.6", "2.8"},
                                        {"2.7", "2.9"}, {"8.1", "8.2"}, {"8.5", "8.7"}, {"8.6", "8.8"}};
    for (const auto& [upper, lower] : pairs) {
        const auto u = find_column(take, upper), l = find_column(take, lower);
        if (!u || !l) continue;
        const double rest = (row(take, 0)[*u] - row(take, 0)[*l]).y;
        if ((row(take, r)[*u] - row(take, r)[*l]).y < std::min(0.0, rest) - 0.001 * eyes) return true;
    }
    return false;
}

struct Case {
    const char* name;
    Points source, target;
    Frames frames, truth;
    std::array<double, 3> contact, plain;  // limits for 73, 27 and 21 points
};

void compare(const Case& c) {
    constexpr const char* sets[] = {"all_skin", "vicon27", "dutreve21"};
    for (const Way& way : ways) {
        std::string line = fmt::format("{:28} {:22}", way.name, c.name);
        for (std::size_t s = 0; s < 3; ++s) {
            const std::vector<std::string> ids = faces::point_set(sets[s]);
            const Points source = faces::with_ids(c.source, ids);
            const Take take = faces::take_of(source, c.frames);
            const Take truth = faces::take_of(faces::with_ids(c.target, ids), c.truth);
            const RetargetOptions& options = way.options;
            const Take out = faces::performed(take, faces::with_ids(c.target, ids), options);
            const double error = faces::relative_error(out, truth);
            const double valid = faces::relative_error(
                out, truth, [&](std::size_t r) { return !crosses(take, r, faces::eyes(c.source)); });
            line += fmt::format("  {:.3f} ({:.3f})", error, valid);
            if (options.method == RetargetMethod::local_affine) {
                EXPECT_LE(error, options.contact ? c.contact[s] : c.plain[s]) << line;
            }
        }
        std::cout << line << "\n";
    }
}

class KnownTruth : public ::testing::Test {
protected:
    void SetUp() override {
        if (!std::filesystem::exists(faces::folder() / "ict"))
            GTEST_SKIP() << faces::folder() / "ict"
                         << " is not there";
    }
};

TEST_F(KnownTruth, people_of_one_model_make_the_same_expressions) {
    const Points a = faces::person('a'), b = faces::person('b');
    for (const auto& [name, frames] : {std::pair{"a > b, shapes", faces::single(faces::open_shapes())},
                                       std::pair{"a > b, mixes", faces::mixes(faces::open_shapes())},
                                       std::pair{"a > b, slate 164", faces::recording("ns-slate164.csv", 10)}})
        compare({name, a, b, frames, frames, {0.13, 0.11, 0.13}, {0.11, 0.11, 0.11}});
}

TEST_F(KnownTruth, a_cartoon_moves_as_the_warp_that_made_it) {
    const Points a = faces::person('a'), b = faces::person('b'), cartoon = faces::cartoon(b);
    for (const auto& [name, frames] : {std::pair{"cartoon, shapes", faces::single(faces::open_shapes())},
                                       std::pair{"cartoon, mixes", faces::mixes(faces::open_shapes())},
                                       std::pair{"cartoon, slate 164", faces::recording("ns-slate164.csv", 10)}}) {
        const Frames truth = faces::cartoon_motion(b, frames);
        compare(
            {(std::string("b > ") + name).c_str(), b, cartoon, frames, truth, {0.13, 0.16, 0.14}, {0.13, 0.16, 0.16}});
        compare(
            {(std::string("a > ") + name).c_str(), a, cartoon, frames, truth, {0.19, 0.18, 0.21}, {0.18, 0.18, 0.20}});
    }
}

}  // namespace
}  // namespace mien
