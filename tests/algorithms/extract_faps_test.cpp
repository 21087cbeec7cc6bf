// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/extract_faps.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "animated_face.hpp"

namespace mien {
namespace {

struct Moving {
    Face face = animated::head();
    Fapu fapu = measure_fapu(face);
    FapStream stream = animated::all_at_once(50);
    MeshSequence sequence = animated::play(face, fapu, stream);
};

std::int32_t value(const FapStream& stream, std::size_t frame, int fap) {
    return stream.frames[frame].value[fap_index(fap)];
}

TEST(ExtractFaps, TheParametersThatMovedAHeadAreThoseThatAreFound) {
    const Moving moving;
    const FapStream found = extract_faps(upright(moving.sequence, moving.face.points), moving.fapu);
    ASSERT_EQ(found.frames.size(), moving.stream.frames.size());
    EXPECT_EQ(found.rate, moving.stream.rate);
    for (std::size_t r = 0; r < found.frames.size(); ++r)
        for (const int fap : animated::moving_faps())
            EXPECT_NEAR(value(found, r, fap), value(moving.stream, r, fap), 1) << fap_info(fap).name;
}

TEST(ExtractFaps, AVertexThatWentOneUnitAlongTheAxisHasMovedByOneThousandAndTwentyFour) {
    const Moving moving;
    MeshSequence sequence{moving.face.mesh, {0, 0.04}, {}};
    const FeaturePoint& corner = moving.face.points[*find_point(moving.face.points, "8.3")];
    sequence.positions = [&](std::size_t row, std::span<Vec3f> positions) {
        std::copy(moving.face.mesh.positions.begin(), moving.face.mesh.positions.end(), positions.begin());
        if (row == 1) positions[corner.vertex] += to_float({moving.fapu.mw, -0.5 * moving.fapu.mns, 0});
    };
    const FapStream found = extract_faps(animated::still(moving.face, sequence), moving.fapu);
    EXPECT_EQ(value(found, 1, 53), 1024);  // stretch_l_cornerlip_o, of the mouth's width
    EXPECT_EQ(value(found, 1, 59), -512);  // raise_l_cornerlip_o, of the way from nose to mouth
    EXPECT_EQ(value(found, 1, 54), 0);
    EXPECT_FALSE(found.frames[1].mask[fap_index(19 + 46)]) << "a head without ears sends nothing of ears";
}

TEST(ExtractFaps, EyeballsOfTheirOwnTellHowTheyTurnWithoutAPupil) {
    const Moving moving;
    const UprightSequence found = upright(moving.sequence, moving.face.points);
    const std::vector<MovingEyeball> eyeballs = moving_eyeballs(found);
    ASSERT_EQ(eyeballs.size(), 2U);
    for (const MovingEyeball& eyeball : eyeballs) {
        EXPECT_EQ(eyeball.pupil, eyeball.centre.x > 0 ? "3.5" : "3.6");
        EXPECT_EQ(eyeball.name, eyeball.centre.x > 0 ? "left eye" : "right eye");
        EXPECT_NEAR(std::abs(eyeball.centre.x), animated::eye_x, 1e-3);
        EXPECT_NEAR(eyeball.centre.z, -20, 1e-3);
    }
    const FapStream stream = extract_faps(found, moving.fapu);
    for (std::size_t r = 0; r < stream.frames.size(); ++r)
        for (const int fap : {23, 24, 25, 26})
            EXPECT_NEAR(value(stream, r, fap), value(moving.stream, r, fap), 3) << fap_info(fap).name;
}

TEST(ExtractFaps, TheHeadsMotionIsTurnsAndAWayOfItsCentre) {
    const Moving moving;
    std::vector<Pose> poses(moving.stream.frames.size());
    poses[3] = {animated::turn({0, 1, 0}, 0.25), {}};  // to its left, about the origin
    poses[4] = {{}, {5, 6, 7}};
    const UprightSequence found =
        upright(animated::play(moving.face, moving.fapu, moving.stream, poses), moving.face.points);
    const FapStream stream = extract_faps(found, moving.fapu);
    EXPECT_NEAR(value(stream, 3, 49), 25000, 3);
    EXPECT_NEAR(value(stream, 3, 48), 0, 3);
    EXPECT_NEAR(value(stream, 4, 49), 0, 3);
    const std::vector<Vec3> shifts = head_translations(found, moving.fapu);
    EXPECT_LT(distance(shifts[4], {5, 6, 7}), 1e-3);
    EXPECT_LT(distance(shifts[3], apply(poses[3], moving.fapu.neck) - moving.fapu.neck), 1e-3);
    EXPECT_LT(length(shifts[0]), 1e-3);
}

TEST(ExtractFaps, AnotherRateTakesTheNearestRows) {
    const Moving moving;
    const FapStream all = extract_faps(upright(moving.sequence, moving.face.points), moving.fapu);
    const FapStream some = extract_faps(upright(moving.sequence, moving.face.points), moving.fapu, {5});
    ASSERT_EQ(some.frames.size(), 11U);
    EXPECT_EQ(some.rate, 5);
    EXPECT_EQ(value(some, 3, 31), value(all, 15, 31));
}

}  // namespace
}  // namespace mien
