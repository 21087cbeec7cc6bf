// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/resolve_faps.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string_view>

#include "mien/error.hpp"

namespace mien {
namespace {

FapFrame frame(std::uint32_t number, std::initializer_list<std::pair<int, int>> values) {
    FapFrame frame;
    frame.number = number;
    for (const auto& [fap, value] : values) {
        frame.mask.set(fap_index(fap));
        if (fap > 2) frame.value[fap_index(fap)] = value;
    }
    return frame;
}

FapFrame with_viseme(FapFrame frame, const Viseme& viseme) {
    frame.mask.set(0);
    frame.viseme = viseme;
    return frame;
}

FapFrame with_expression(FapFrame frame, const Expression& expression) {
    frame.mask.set(1);
    frame.expression = expression;
    return frame;
}

FapStream resolved(std::initializer_list<FapFrame> frames) {
    FapStream stream;
    stream.frames = frames;
    return resolve_faps(stream);
}

int value(const FapFrame& frame, int fap) {
    EXPECT_TRUE(frame.mask[fap_index(fap)]) << fap;
    return frame.value[fap_index(fap)];
}

TEST(ResolveFaps, OneSideOfTheFaceServesForTheOther) {
    const FapFrame out = resolved({frame(0, {{31, 50}, {23, -700}, {38, 9}})}).frames.at(0);
    EXPECT_EQ(value(out, 32), 50);
    EXPECT_EQ(value(out, 24), -700);  // both eyes look the same way
    EXPECT_EQ(value(out, 37), 9);
    EXPECT_EQ(out.mask.count(), 6U);
}

TEST(ResolveFaps, AContourIsLeftToTheSkinWhereTheFaceHasThePointsOfBoth) {
    FapStream stream;
    stream.frames = {frame(0, {{53, 80}, {52, -100}})};
    // 2.3 and 8.2 are moved by 5 and 52, the corners 2.4, 8.3 by 6 and 53; here 8.4 (54) has no 2.5 (7) beside it.
    std::vector<FeaturePoint> points;
    for (const char* id : {"2.3", "8.2", "2.4", "8.3", "8.4"}) points.emplace_back().id = id;
    const FapMask carried = carried_contours(points);
    FapMask expected;
    for (const int fap : {5, 52, 6, 53, 12, 59}) expected.set(fap_index(fap));
    EXPECT_EQ(carried, expected);
    const FapFrame out = resolve_faps(stream, standard_poses(), {}, carried).frames.at(0);
    EXPECT_FALSE(out.mask[fap_index(5)]);
    EXPECT_FALSE(out.mask[fap_index(6)]);
    for (const int fap : {53, 54, 7}) EXPECT_EQ(value(out, fap), 80) << fap;
    EXPECT_EQ(value(out, 52), -100);
}

TEST(ResolveFaps, OneContourOfTheLipsServesForTheOtherAfterTheOtherSide) {
    const FapFrame out = resolved({frame(0, {{53, 80}, {5, -200}, {52, -100}})}).frames.at(0);
    for (const int fap : {6, 7, 53, 54}) EXPECT_EQ(value(out, fap), 80);
    EXPECT_EQ(value(out, 5), -200);  // what is sent stays
    EXPECT_EQ(value(out, 52), -100);
    EXPECT_EQ(out.mask.count(), 6U);
    // The other side of the same contour comes before the other contour.
    const FapFrame lips = resolved({frame(0, {{6, 1}, {54, 2}})}).frames.at(0);
    EXPECT_EQ(value(lips, 7), 1);
    EXPECT_EQ(value(lips, 53), 2);
}

TEST(ResolveFaps, WhatIsNotSentAgainHoldsUnlessItIsToBeInterpolated) {
    FapFrame interpolated = frame(2, {{31, 70}});
    interpolated.interpolated.set(3);
    const FapStream out = resolved({frame(0, {{31, 10}, {32, 20}}), frame(1, {{31, 30}}), interpolated, frame(3, {})});
    EXPECT_EQ(value(out.frames[1], 32), 20);
    EXPECT_EQ(value(out.frames[2], 32), 70);
    EXPECT_EQ(value(out.frames[3], 32), 20);
    EXPECT_EQ(value(out.frames[3], 31), 70);
}

TEST(ResolveFaps, AVisemeBlendsFromTheSecondToTheFirst) {
    const FapPoses poses = standard_poses();
    const auto jaw = [&](std::size_t viseme) { return poses.visemes[viseme].value[fap_index(3)]; };
    for (const int blend : {0, 21, 42, 63}) {
        const auto b = static_cast<std::uint8_t>(blend);
        const FapFrame out = resolved({with_viseme({}, {10, 12, b, false})}).frames.at(0);
        EXPECT_NEAR(value(out, 3), jaw(10) * blend / 63.0 + jaw(12) * (1 - blend / 63.0), 0.5);
        EXPECT_FALSE(out.mask[0]);
    }
}

TEST(ResolveFaps, TwoExpressionsAddUpAndAVisemeOnTopOfThem) {
    const FapPoses poses = standard_poses();
    const FapFrame out =
        resolved({with_viseme(with_expression({}, {1, 63, 6, 21, false, false}), {10, 0, 63, false})}).frames.at(0);
    const auto expected = [&](int fap) {
        const std::size_t i = fap_index(fap);
        return poses.expressions[1].value[i] + poses.expressions[6].value[i] / 3.0 + poses.visemes[10].value[i];
    };
    for (const int fap : {3, 5, 12, 19, 31, 41}) EXPECT_NEAR(value(out, fap), expected(fap), 0.5);
}

TEST(ResolveFaps, WhatIsSentWinsOverAViseme) {
    const FapStream out = resolved({with_viseme(frame(0, {{3, 5}}), {10, 0, 63, false}), frame(1, {})});
    EXPECT_EQ(value(out.frames[0], 3), 5);
    EXPECT_EQ(value(out.frames[0], 5), standard_poses().visemes[10].value[fap_index(5)]);
    // The viseme holds; in a frame that does not send the jaw it has it.
    EXPECT_EQ(value(out.frames[1], 3), standard_poses().visemes[10].value[fap_index(3)]);
}

TEST(ResolveFaps, AStreamMayDefineItsOwnVisemesAndExpressions) {
    const FapStream out = resolved({with_viseme(frame(0, {{3, 333}, {31, 44}}), {4, 0, 63, true}),
                                    with_viseme(frame(1, {}), {4, 0, 63, false}),
                                    with_expression(frame(2, {{33, 90}}), {3, 63, 0, 0, false, true}),
                                    with_expression(frame(3, {}), {3, 21, 0, 0, false, false})});
    EXPECT_EQ(value(out.frames[0], 3), 333);
    EXPECT_EQ(value(out.frames[1], 3), 333);
    EXPECT_EQ(value(out.frames[1], 31), 44);  // held, for a brow is no part of a viseme
    EXPECT_EQ(value(out.frames[3], 33), 30);
}

TEST(ResolveFaps, PosesCanBeReplaced) {
    FapPoses poses = standard_poses();
    poses.visemes[1] = frame(0, {{3, 999}});
    FapStream stream;
    stream.frames = {with_viseme({}, {1, 0, 63, false})};
    const FapFrame out = resolve_faps(stream, poses).frames.at(0);
    EXPECT_EQ(value(out, 3), 999);
    EXPECT_EQ(out.mask.count(), 1U);
}

TEST(ResolveFaps, AStreamThatSaysAllIsUnchanged) {
    FapStream stream;
    stream.rate = 30, stream.name = "all";
    FapFrame all = frame(4, {});
    for (std::size_t i = 2; i < fap_count; ++i) all.mask.set(i), all.value[i] = static_cast<int>(i * i) - 900;
    stream.frames = {all};
    const FapStream out = resolve_faps(stream);
    EXPECT_EQ(out.frames, stream.frames);
    EXPECT_EQ(out.rate, 30);
    EXPECT_EQ(out.name, "all");
    EXPECT_EQ(resolve_faps(out).frames, out.frames);
}

// ---- the interpolation table

// `to` is `times` of `from`.
FitLink link(int from, int to, double times = 1) {
    return {{from}, {{to, {{times, {1}, {}}}, {}}}};
}

FapStream resolved(std::initializer_list<FapFrame> frames, const FapInterpolation& fit) {
    FapStream stream;
    stream.frames = frames;
    return resolve_faps(stream, standard_poses(), fit);
}

TEST(ResolveFaps, ATableThatCopiesLeftToRightEqualsTheRuleOfTheSides) {
    FapInterpolation fit;
    FapFrame left = frame(0, {});
    for (int fap = 3; fap <= 68; ++fap) {
        const std::string_view name = fap_info(fap).name;
        if (name.find("_l_") == std::string_view::npos && name.find("_lm") == std::string_view::npos) continue;
        fit.links.push_back(link(fap, fap_info(fap).mirror));
        left.mask.set(fap_index(fap));
        left.value[fap_index(fap)] = fap * fap - 900;
    }
    ASSERT_EQ(fit.links.size(), 23U);  // as many pairs as the standard has
    EXPECT_EQ(resolved({left}, fit).frames, resolved({left}).frames);
    EXPECT_EQ(resolved({left}, fit).frames.at(0).mask.count(), 46U);
}

TEST(ResolveFaps, ATableChangesNothingInAStreamThatSaysAll) {
    FapInterpolation fit;
    FapFrame all = frame(0, {});
    for (int fap = 3; fap <= 68; ++fap) {
        all.mask.set(fap_index(fap));
        all.value[fap_index(fap)] = fap * fap - 900;
        if (fap > 3) fit.links.push_back(link(fap - 1, fap, 2));
    }
    EXPECT_THAT(resolved({all}, fit).frames, testing::ElementsAre(all));
}

TEST(ResolveFaps, ATableComesBeforeTheRulesOfSidesAndLipsWhichThenUseWhatItGave) {
    const FapFrame out = resolved({frame(0, {{3, 200}, {10, -10}, {57, 7}})}, {{link(3, 11, -0.5)}}).frames.at(0);
    EXPECT_EQ(value(out, 11), -100);  // and not -10 from the other side
    EXPECT_EQ(value(out, 10), -10);
    EXPECT_EQ(value(out, 58), 7);  // the other side of its contour
    const FapFrame lips = resolved({frame(0, {{3, 200}})}, {{link(3, 11, -0.5)}}).frames.at(0);
    for (const int fap : {10, 11, 57, 58}) EXPECT_EQ(value(lips, fap), -100);
    EXPECT_EQ(lips.mask.count(), 5U);
}

TEST(ResolveFaps, ATableNeverOverwritesWhatIsSentOrHeldOrAskedForByAViseme) {
    const FapInterpolation fit{{link(31, 3), link(31, 33), link(31, 32)}};
    const FapStream out = resolved(
        {frame(0, {{31, 5}, {32, 20}}), frame(1, {{31, 6}}), with_viseme(frame(2, {{31, 7}}), {10, 0, 63, false})},
        fit);
    EXPECT_EQ(value(out.frames[0], 32), 20);
    EXPECT_EQ(value(out.frames[1], 32), 20);
    EXPECT_EQ(value(out.frames[2], 3), standard_poses().visemes[10].value[fap_index(3)]);
    for (const int at : {0, 1, 2}) EXPECT_EQ(value(out.frames[static_cast<std::size_t>(at)], 33), 5 + at);
    // In a group that is to be interpolated the table comes before what was sent last, which does not hold.
    FapFrame interpolated = frame(1, {{31, 70}});
    interpolated.interpolated.set(3);
    EXPECT_EQ(value(resolved({frame(0, {{32, 20}}), interpolated}, fit).frames[1], 32), 70);
}

TEST(ResolveFaps, AnUnknownSourceLeavesTheTargetAlone) {
    FitLink both = link(31, 5);
    both.from.push_back(33);
    both.to[0].numerator[0].exponents = {1, 0};  // known to be needless, yet a source
    EXPECT_FALSE(resolved({frame(0, {{31, 9}})}, {{both}}).frames.at(0).mask[fap_index(5)]);
    EXPECT_EQ(value(resolved({frame(0, {{31, 9}, {33, 1}})}, {{both}}).frames.at(0), 5), 9);
    // The other side is looked at after the table.
    EXPECT_FALSE(resolved({frame(0, {{32, 9}})}, {{link(31, 5)}}).frames.at(0).mask[fap_index(5)]);
}

TEST(ResolveFaps, LinksChainWhateverTheirOrder) {
    for (const FapInterpolation& fit : {FapInterpolation{{link(3, 18, 2), link(18, 14, 3), link(14, 63, -1)}},
                                        FapInterpolation{{link(14, 63, -1), link(18, 14, 3), link(3, 18, 2)}}}) {
        const FapFrame out = resolved({frame(0, {{3, 10}})}, fit).frames.at(0);
        EXPECT_EQ(value(out, 18), 20);
        EXPECT_EQ(value(out, 14), 60);
        EXPECT_EQ(value(out, 63), -60);
    }
}

// FAP 14 from 18 first, although 18 itself comes late; from 3 where 18 stays unknown or gives nothing.
TEST(ResolveFaps, TheFirstLinkOfTheListThatCanGivesTheValue) {
    FitLink inverse = link(18, 14);
    inverse.to[0] = {14, {{100, {}, {}}}, {{1, {1}, {}}}};
    const FapInterpolation fit{{inverse, link(3, 14), link(63, 18)}};
    EXPECT_EQ(value(resolved({frame(0, {{3, 7}, {63, 4}})}, fit).frames.at(0), 14), 25);
    EXPECT_EQ(value(resolved({frame(0, {{3, 7}})}, fit).frames.at(0), 14), 7);
    EXPECT_EQ(value(resolved({frame(0, {{3, 7}, {63, 0}})}, fit).frames.at(0), 14), 7);
    EXPECT_FALSE(resolved({frame(0, {{63, 0}})}, fit).frames.at(0).mask[fap_index(14)]);
}

TEST(ResolveFaps, WhatIsResolvedWithATableIsSaidOutright) {
    const FapInterpolation fit{{link(3, 5, -0.37), link(5, 18, 0.61)}};
    const FapStream out = resolved({frame(0, {{3, 123}}), frame(4, {{3, -77}})}, fit);
    EXPECT_EQ(resolve_faps(out, standard_poses(), fit).frames, out.frames);
    EXPECT_EQ(resolve_faps(out).frames, out.frames);
}

TEST(ResolveFaps, ATableThatLeadsBackIsRefused) {
    EXPECT_THROW(resolved({frame(0, {})}, {{link(31, 32), link(32, 31)}}), Error);
}

// A pose is symmetric, its lip contours agree, and it stays within the limits of the table.
TEST(ResolveFaps, TheStandardPosesAreWhole) {
    const FapPoses poses = standard_poses();
    const auto check = [](const FapFrame& pose, bool empty) {
        EXPECT_EQ(pose.mask.none(), empty);
        for (int n = 3; n <= 68; ++n) {
            const Fap& fap = fap_info(n);
            const int here = pose.value[fap_index(n)];
            EXPECT_EQ(pose.value[fap_index(fap.mirror)], here) << fap.name;
            if (fap.partner != 0) {
                EXPECT_EQ(pose.value[fap_index(fap.partner)], here) << fap.name;
            }
            EXPECT_GE(here, fap.intra.low * fap.quant_step) << fap.name;
            EXPECT_LE(here, fap.intra.high * fap.quant_step) << fap.name;
        }
    };
    for (std::size_t v = 0; v < poses.visemes.size(); ++v) check(poses.visemes[v], v == 0);
    for (std::size_t e = 0; e < poses.expressions.size(); ++e) check(poses.expressions[e], e == 0);
    // As the standard describes them: joy draws the corners up, anger the brows down, surprise opens lids and jaw.
    EXPECT_GT(poses.expressions[1].value[fap_index(59)], 0);
    EXPECT_LT(poses.expressions[3].value[fap_index(31)], 0);
    EXPECT_LT(poses.expressions[6].value[fap_index(19)], 0);
    EXPECT_GT(poses.expressions[6].value[fap_index(3)], 0);
}

// A table that has viseme 4 and nothing else of FAPs 1 and 2.
Fat one_viseme() {
    return {{}, {{1, 4, {{{0, 63}, {0}, {{0, 0, 1}}}}, {}}}};
}

FapFrame speaking(std::uint32_t number, Viseme viseme) {
    FapFrame frame;
    frame.number = number;
    frame.mask.set(fap_index(1));
    frame.viseme = viseme;
    return frame;
}

TEST(ResolveFaps, LeavesVisemesThatATableHasToTheTable) {
    FapStream stream;
    stream.frames = {speaking(0, {4, 10, 63, false}), FapFrame{}, speaking(2, {10, 4, 63, false}),
                     speaking(3, {10, 0, 63, false})};
    stream.frames[1].number = 1;
    const FapStream result = resolve_faps(stream, one_viseme());
    ASSERT_EQ(result.frames.size(), 4U);
    for (const std::size_t held : {0U, 1U}) {
        EXPECT_TRUE(result.frames[held].mask[fap_index(1)]);
        EXPECT_EQ(result.frames[held].viseme, stream.frames[0].viseme);
        EXPECT_EQ(result.frames[held].value[fap_index(3)], 0);  // all of the blend is the table's
    }
    EXPECT_TRUE(result.frames[2].mask[fap_index(1)]);
    EXPECT_GT(result.frames[2].value[fap_index(3)], 0);  // "aa" opens the jaw by its pose
    EXPECT_FALSE(result.frames[3].mask[fap_index(1)]);
    EXPECT_EQ(result.frames[3].value[fap_index(3)], result.frames[2].value[fap_index(3)]);
}

TEST(ResolveFaps, WithATableWithoutVisemesIsWhatItIsWithoutATable) {
    FapStream stream;
    stream.frames = {speaking(0, {4, 10, 30, false}), speaking(1, {2, 10, 30, false})};
    EXPECT_EQ(resolve_faps(stream, Fat{}).frames, resolve_faps(stream).frames);
}

}  // namespace
}  // namespace mien
