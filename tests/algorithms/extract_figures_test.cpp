// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Extraction from real heads, on fewer rows than bench/extract.cpp, which prints all regions and parameters.

#include "extract_figures.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <iostream>

namespace mien {
namespace {

TEST(ExtractFigures, ATalkingHeadComesBack) {
    if (!arkit::is_there()) GTEST_SKIP() << "the head is not there";
    const extracted::Talking talking = extracted::talking("jm-slate3", 8, Reading::remedied);
    const ReplayError& replay = talking.result.replay;
    std::cout << fmt::format(
        "head: {:.5f} degrees, {:.5f} eye distances; replay: mean {:.3f} % of the eye distance, "
        "error {:.3f}, beyond parameters {:.4f}\n",
        talking.pose.degrees, talking.pose.shift, 100 * replay.mean, replay.error, talking.result.beyond.back());
    EXPECT_LT(talking.pose.degrees, 0.1);
    EXPECT_LT(talking.pose.shift, 0.002);
    EXPECT_LT(replay.mean, 0.001);
    EXPECT_LT(replay.error, 0.03);
    for (const ReplayRegion& region : replay.regions) {
        EXPECT_LT(region.mean, 0.02) << region.name;
        EXPECT_LT(region.error, 0.25) << region.name;
    }
}

struct Drawn {
    Face face;
    extracted::Fields fields;
};

Drawn drawn_head() {
    const obadiah::Subject subject = obadiah::read_subject();
    return {subject.face, extracted::drawn_fields(subject.face.mesh)};
}

TEST(ExtractFigures, FieldsThatWereDrawnByHandAreLearntFromParametersThatAlwaysActTogether) {
    if (!obadiah::is_there()) GTEST_SKIP() << "the head is not there";
    const Drawn head = drawn_head();
    const FapStream stream = extracted::all_at_once(head.fields, 150);
    const extracted::Result result =
        extracted::learn(extracted::drawn(head.face, head.fields, stream), Reading::remedied, stream);
    EXPECT_LT(result.replay.error, 0.05);
    double mean = 0;
    for (const extracted::FieldError& field : extracted::field_errors(head.face, head.fields, result.learnt.fat)) {
        mean += field.error / static_cast<double>(head.fields.size());
        EXPECT_EQ(field.strangers, 0U) << fap_info(field.fap).name;
    }
    std::cout << fmt::format("replay {:.4f}, fields {:.4f}\n", result.replay.error, mean);
    EXPECT_LT(mean, 0.05);
}

TEST(ExtractFigures, ADrawnHeadComesBackFromTheParametersThatAreExtracted) {
    if (!obadiah::is_there()) GTEST_SKIP() << "the head is not there";
    const Drawn head = drawn_head();
    const extracted::Result result = extracted::learn(
        extracted::drawn(head.face, head.fields, extracted::one_by_one(head.fields)), Reading::remedied);
    std::cout << fmt::format("replay {:.4f}, beyond parameters {:.4f}\n", result.replay.error, result.beyond.back());
    EXPECT_LT(result.replay.error, 0.05);
}

}  // namespace
}  // namespace mien
