// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include <cmath>
#include <gmock/gmock.h>
#include <numbers>

#include "refusal.hpp"

#include "mien/algorithms/deform.hpp"

namespace mien {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

FapFrame frame_of(int fap, std::int32_t value) {
    FapFrame frame;
    frame.mask.set(fap_index(fap));
    frame.value[fap_index(fap)] = value;
    return frame;
}

std::vector<Vec3f> played(const Fat& fat, const std::vector<Vec3f>& rest, const FapFrame& frame) {
    std::vector<Vec3f> positions(rest.size());
    deform(fat, rest, frame, positions);
    return positions;
}

// The example that is told of the standard: FAP 6, four borders, vertices 50 and 51.
Fat worked_example() {
    FaceDefMesh mesh{{-1000, 0, 500, 1000},
                     {50, 51},
                     {{1, 0, 0}, {0.9F, 0, 0}, {1.5F, 0, 4}, {0.8F, 0, 0}, {0.7F, 0, 0}, {2, 0, 0}}};
    return {{}, {{6, 0, {mesh}, {}}}};
}

Vec3f offset_of(const Fat& fat, std::size_t vertex, std::int32_t value) {
    return played(fat, std::vector<Vec3f>(52), frame_of(6, value))[vertex];
}

TEST(DeformFat, MovesTheVerticesOfTheWorkedExample) {
    EXPECT_EQ(offset_of(worked_example(), 50, 600), (Vec3f{600, 0, 400}));
    EXPECT_EQ(offset_of(worked_example(), 51, 600), (Vec3f{550, 0, 0}));
    EXPECT_EQ(offset_of(worked_example(), 49, 600), Vec3f{});
}

TEST(DeformFat, GoesOnBeyondTheOutermostBorders) {
    EXPECT_EQ(offset_of(worked_example(), 50, 1200), (Vec3f{450 + 1050, 0, 2800}));
    EXPECT_EQ(offset_of(worked_example(), 50, -3000), (Vec3f{-3000, 0, 0}));
}

TEST(DeformFat, TakesSignedStepsBelowZero) {
    EXPECT_EQ(offset_of(worked_example(), 50, -100), (Vec3f{-100, 0, 0}));
    EXPECT_EQ(offset_of(worked_example(), 51, -500), (Vec3f{-400, 0, 0}));
}

TEST(DeformFat, WithOneVectorOnBothSidesOfZeroIsLinear) {
    const Fat fat{{}, {{6, 0, {{{-7, 0, 7}, {50}, {{1, 2, 4}, {1, 2, 4}}}}, {}}}};
    for (const int f : {-2000, -7, -3, 0, 1, 7, 8, 4096})
        EXPECT_EQ(offset_of(fat, 50, f), static_cast<float>(f) * (Vec3f{1, 2, 4}));
}

TEST(DeformFat, ExtendsTheOnlyIntervalsToBothSides) {
    const Fat above{{}, {{6, 0, {{{0, 10}, {50}, {{1, 0, 0}}}}, {}}}};
    const Fat below{{}, {{6, 0, {{{-10, 0}, {50}, {{1, 0, 0}}}}, {}}}};
    for (const int f : {-20, -5, 5, 20}) {
        EXPECT_EQ(offset_of(above, 50, f), (Vec3f{static_cast<float>(f), 0, 0}));
        EXPECT_EQ(offset_of(below, 50, f), (Vec3f{static_cast<float>(f), 0, 0}));
    }
}

TEST(DeformFat, WalksWholeIntervalsDownwards) {
    const Fat fat{{}, {{6, 0, {{{-300, -200, -100, 0}, {50}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}}, {}}}};
    EXPECT_EQ(offset_of(fat, 50, -250), (Vec3f{-50, -100, -100}));
    EXPECT_EQ(offset_of(fat, 50, 50), (Vec3f{0, 0, 50}));
}

TEST(DeformFat, AddsTheOffsetsOfAllParametersOnTheNeutralHead) {
    Fat fat = worked_example();
    fat.tables.push_back({7, 0, {{{0, 10}, {50}, {{0, 2, 0}}}}, {}});
    FapFrame frame = frame_of(6, 600);
    frame.mask.set(fap_index(7));
    frame.value[fap_index(7)] = 5;
    std::vector<Vec3f> rest(52);
    rest[50] = {1, 2, 3};
    EXPECT_EQ(played(fat, rest, frame)[50], (Vec3f{601, 12, 403}));
}

TEST(DeformFat, LeavesAHeadAtRestExactlyAlone) {
    const std::vector<Vec3f> rest(52, {0.1F, -0.7F, 3e-9F});
    EXPECT_EQ(played(worked_example(), rest, {}), rest);
    FapFrame not_sent = frame_of(6, 600);
    not_sent.mask.reset();
    EXPECT_EQ(played(worked_example(), rest, not_sent), rest);
}

Fat high_levels() {
    const auto table = [](int fap, int select, Vec3f d) {
        return FaceDefTables{fap, select, {{{0, 63}, {0}, {d}}}, {}};
    };
    return {{}, {table(1, 1, {1, 0, 0}), table(1, 4, {0, 1, 0}), table(2, 1, {0, 0, 1}), table(2, 6, {0, 0, 100})}};
}

TEST(DeformFat, BlendsTheTwoVisemesOfAFrame) {
    FapFrame frame;
    frame.mask.set(fap_index(1));
    frame.viseme = {1, 4, 40, false};
    EXPECT_THAT(played(high_levels(), {{}}, frame), ElementsAre(Vec3f{40, 23, 0}));
    frame.viseme = {4, 4, 40, false};
    EXPECT_THAT(played(high_levels(), {{}}, frame), ElementsAre(Vec3f{0, 63, 0}));
    frame.viseme = {2, 0, 40, false};  // no table: nothing moves
    EXPECT_THAT(played(high_levels(), {{}}, frame), ElementsAre(Vec3f{}));
}

TEST(DeformFat, AddsTheTwoExpressionsOfAFrame) {
    FapFrame frame;
    frame.mask.set(fap_index(2));
    frame.expression = {1, 63, 6, 2, false, false};
    EXPECT_THAT(played(high_levels(), {{}}, frame), ElementsAre(Vec3f{0, 0, 263}));
}

MATCHER_P(Near, expected, "") {
    return distance(arg, expected) < 1e-5F;
}

constexpr double right_angle = std::numbers::pi / 2;

FaceDefTables turning(int fap, std::uint32_t node, Vec3 axis) {
    return {fap, 0, {}, {{node, TransformField::rotation, axis, right_angle, {}, {}}}};
}

TEST(DeformFat, TurnsANodeAboutItsCentreAndNothingElse) {
    const Fat fat{{{"eye", {0}, {1, 0, 0}}}, {turning(23, 0, {0, 1, 0})}};
    EXPECT_THAT(played(fat, {{1, 0, 1}, {1, 0, 1}}, frame_of(23, 1)),
                ElementsAre(Near(Vec3f{2, 0, 0}), Vec3f{1, 0, 1}));
}

TEST(DeformFat, ScalesAndShiftsANode) {
    Fat fat{{{"pupil", {0}, {1, 0, 0}}}, {}};
    fat.tables.push_back({29,
                          0,
                          {},
                          {{0, TransformField::scale, {0, 0, 1}, 0, {}, {0.5, 0, 0}},
                           {0, TransformField::translation, {0, 0, 1}, 0, {0, 0, 0.25}, {}}}});
    EXPECT_THAT(played(fat, {{3, 1, 1}}, frame_of(29, 2)), ElementsAre(Near(Vec3f{5, 1, 1.5F})));
}

// Ry Rx Rz, whatever the order of the parameters in the table.
TEST(DeformFat, TurnsTheHeadByRollThenPitchThenYaw) {
    const Fat fat{{{"head", {0}, {}}},
                  {turning(48, 0, {1, 0, 0}), turning(49, 0, {0, 1, 0}), turning(50, 0, {0, 0, 1})}};
    FapFrame frame;
    for (const int fap : {48, 49, 50}) {
        frame.mask.set(fap_index(fap));
        frame.value[fap_index(fap)] = 1;
    }
    EXPECT_THAT(played(fat, {{1, 0, 0}}, frame), ElementsAre(Near(Vec3f{1, 0, 0})));  // x -> y -> z -> x
    EXPECT_THAT(played(fat, {{0, 1, 0}}, frame), ElementsAre(Near(Vec3f{0, 0, 1})));  // y -> -x -> -x -> z
}

TEST(DeformFat, TurnsAnEyeInTheHeadThatTurns) {
    const Fat fat{{{"eye", {0}, {1, 0, 0}}, {"head", {0, 1}, {}}},
                  {turning(23, 0, {0, 1, 0}), turning(49, 1, {0, 1, 0})}};
    FapFrame frame = frame_of(23, 1);
    frame.mask.set(fap_index(49));
    frame.value[fap_index(49)] = 1;
    EXPECT_THAT(played(fat, {{1, 0, 1}, {0, 0, 1}}, frame), ElementsAre(Near(Vec3f{0, 0, -2}), Near(Vec3f{1, 0, 0})));
}

TEST(DeformFat, TransformsWhatTheMeshTablesHaveMoved) {
    Fat fat{{{"head", {0}, {}}}, {turning(49, 0, {0, 1, 0})}};
    fat.tables[0].meshes.push_back({{0, 1}, {0}, {{0, 0, 2}}});
    EXPECT_THAT(played(fat, {{}}, frame_of(49, 1)), ElementsAre(Near(Vec3f{2, 0, 0})));
}

TEST(DeformFatStream, HasARowPerFrameAtItsTime) {
    Mesh mesh;
    mesh.positions.resize(52);
    FapStream stream;
    stream.rate = 4;
    for (const std::uint32_t number : {0U, 1U, 3U}) {
        stream.frames.push_back(frame_of(6, 100 * static_cast<int>(number)));
        stream.frames.back().number = number;
    }
    const MeshSequence sequence = deform(worked_example(), mesh, stream);
    EXPECT_THAT(sequence.times, ElementsAre(0, 0.25, 0.75));
    std::vector<Vec3f> positions(52);
    sequence.positions(2, positions);
    EXPECT_EQ(positions[50], (Vec3f{270, 0, 0}));
}

TEST(DeformFatStream, RefusesAHeadThatTheTableDoesNotFit) {
    Mesh mesh;
    mesh.positions.resize(51);
    EXPECT_THAT(refusal([&] { static_cast<void>(deform(worked_example(), mesh, {})); }),
                HasSubstr("below 51, found 51"));
}

}  // namespace
}  // namespace mien
