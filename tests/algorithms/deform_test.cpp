// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/deform.hpp"

#include <array>
#include <gmock/gmock.h>
#include <memory>

#include "shapes.hpp"

#include "mien/error.hpp"

namespace mien {
namespace {

using testing::ElementsAre;

// Points "a" and "b" at the ends of a row of three vertices; the middle one takes half of a along x, a quarter of b
// along y, and nothing along z. A fourth vertex follows nobody.
Rig small_rig() {
    Rig rig;
    rig.rest = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {9, 9, 9}};
    rig.points = {{"a", 0, {0, 0, 0}, {}, 0}, {"b", 2, {2, 0, 0}, {}, 0}};
    rig.row_starts = {0, 1, 3, 4, 4};
    rig.row_points = {0, 0, 1, 1};
    rig.weights = {{1, 1, 1}, {0.5F, 0, 0}, {0, 0.25F, 0}, {1, 1, 1}};
    return rig;
}

Mesh mesh_of(const Rig& rig) {
    Mesh mesh;
    mesh.positions = rig.rest;
    return mesh;
}

// An eyeball of four vertices round (0, 0, 5), aimed by the point on its pupil at (0, 0, 6).
Rig eye_rig() {
    Rig rig;
    rig.rest = {{0, 0, 6}, {1, 0, 5}, {0, 1, 5}, {0, 0, 4}};
    rig.points = {{"3.5", 0, {0, 0, 6}, {}, 0}};
    rig.row_starts = {0, 0, 0, 0, 0};
    rig.eyeballs = {{"eye", {0, 1, 2, 3}, {0, 0, 5}, 0}};
    return rig;
}

Take take_of(std::string point, std::vector<double> times, std::vector<Vec3> samples) {
    return {{std::move(point)}, std::move(times), std::move(samples), {}, "", false, 0};
}

std::vector<Vec3f> deformed(const Rig& rig, std::span<const Vec3f> displacements) {
    std::vector<Vec3f> positions(vertex_count(rig));
    deform(rig, displacements, positions);
    return positions;
}

TEST(DeformTake, RefusesAMeshThatTheRigWasNotMadeFor) {
    Mesh mesh = mesh_of(small_rig());
    mesh.positions.pop_back();
    const Take take = take_of("a", {0}, {{0, 0, 0}});
    EXPECT_THAT([&] { static_cast<void>(deform(small_rig(), mesh, take)); },
                testing::ThrowsMessage<Error>(testing::HasSubstr("4 vertices, found 3")));
}

TEST(DeformTake, RefusesATakeThatDrivesNothing) {
    const Take take = take_of("c", {0}, {{0, 0, 0}});
    EXPECT_THROW(static_cast<void>(deform(small_rig(), mesh_of(small_rig()), take)), Error);
}

TEST(Deform, LeavesAHeadAtRestExactlyAlone) {
    const Rig rig = eye_rig();
    EXPECT_EQ(deformed(rig, std::array{Vec3f{}}), rig.rest);
    EXPECT_EQ(deformed(small_rig(), std::array{Vec3f{}, Vec3f{}}), small_rig().rest);
}

TEST(Deform, MovesEveryVertexByItsRowAlongEachAxis) {
    const auto positions = deformed(small_rig(), std::array{Vec3f{4, 4, 4}, Vec3f{8, 8, 8}});
    EXPECT_THAT(positions, ElementsAre(Vec3f{4, 4, 4}, Vec3f{3, 2, 0}, Vec3f{10, 8, 8}, Vec3f{9, 9, 9}));
}

TEST(Deform, TurnsAnEyeballSoThatItsPupilFacesThePoint) {
    // The point is taken from straight ahead to the left: a quarter turn about y carries (1, 0, 0) to (0, 0, -1).
    const auto positions = deformed(eye_rig(), std::array{Vec3f{1, 0, -1}});
    const std::array expected{Vec3f{1, 0, 5}, Vec3f{0, 0, 4}, Vec3f{0, 1, 5}, Vec3f{-1, 0, 5}};
    for (std::size_t v = 0; v < 4; ++v) EXPECT_LT(distance(positions[v], expected[v]), 1e-6F) << v;
}

TEST(Deform, KeepsAnEyeballRigidHoweverFarItsPointGoes) {
    const Rig rig = eye_rig();
    const auto positions = deformed(rig, std::array{Vec3f{30, 20, -2}});
    for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t b = 0; b < a; ++b)
            EXPECT_NEAR(distance(positions[a], positions[b]), distance(rig.rest[a], rig.rest[b]), 1e-5F);
}

TEST(DeformTake, GivesOneRowPerTimeInAnyOrder) {
    // Absolute positions: b rests at (2, 0, 0). Row 1 lost it, so it stays at neutral there.
    const Take take = take_of("b", {0, 0.5, 2}, {{2, 0, 0}, lost_sample, {2, 3, 0}});
    const MeshSequence sequence = deform(small_rig(), mesh_of(small_rig()), take);
    EXPECT_THAT(sequence.times, ElementsAre(0, 0.5, 2));
    std::vector<Vec3f> positions(4);
    sequence.positions(2, positions);
    EXPECT_EQ(positions[2], (Vec3f{2, 3, 0}));
    EXPECT_EQ(positions[1], (Vec3f{1, 0.75F, 0}));
    for (const std::size_t still : {1U, 0U}) {
        sequence.positions(still, positions);
        EXPECT_EQ(positions, small_rig().rest);
    }
}

TEST(DeformTake, IgnoresTheHeadPosesOfTheTake) {
    Take take = take_of("a", {0}, {{1, 0, 0}});
    take.head = {Pose{{0, 1, 0, 0}, {100, 0, 0}}};
    std::vector<Vec3f> positions(4);
    deform(small_rig(), mesh_of(small_rig()), take).positions(0, positions);
    EXPECT_EQ(positions[0], (Vec3f{1, 0, 0}));
}

TEST(DeformTake, OutlivesWhatItWasMadeFrom) {
    auto rig = std::make_unique<Rig>(small_rig());
    auto take = std::make_unique<Take>(take_of("a", {0}, {{1, 0, 0}}));
    const MeshSequence sequence = deform(*rig, mesh_of(*rig), *take);
    rig.reset();
    take.reset();
    std::vector<Vec3f> positions(4);
    sequence.positions(0, positions);
    EXPECT_EQ(positions[0], (Vec3f{1, 0, 0}));
}

}  // namespace
}  // namespace mien
