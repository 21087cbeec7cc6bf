// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/bake_fat.hpp"

#include <cmath>
#include <filesystem>
#include <gmock/gmock.h>
#include <iostream>

#include "refusal.hpp"

#include "mien/algorithms/deform.hpp"
#include "mien/algorithms/fapu.hpp"
#include "mien/algorithms/play_faps.hpp"
#include "mien/algorithms/resolve_faps.hpp"
#include "mien/algorithms/rig_biharmonic.hpp"
#include "mien/io/read.hpp"

namespace mien {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// A chin and a brow with a vertex between them that takes half of the one and a quarter of the other, and an eyeball of
// three vertices round (10, 5, 0) that its pupil aims.
struct Small {
    Rig rig;
    Mesh mesh;
    Fapu fapu;
};

Small small() {
    Small s;
    s.rig.rest = {{0, 0, 0}, {0, 8, 0}, {0, 4, 0}, {10, 5, 2}, {12, 5, 0}, {10, 7, 0}};
    s.rig.points = {{"2.1", 0, {0, 0, 0}, {}, 0}, {"4.3", 1, {0, 8, 0}, {}, 0}, {"3.5", 3, {10, 5, 2}, {}, 0}};
    s.rig.row_starts = {0, 1, 2, 4, 4, 4, 4};
    s.rig.row_points = {0, 1, 0, 1};
    s.rig.weights = {{1, 1, 1}, {1, 1, 1}, {0.5F, 0.5F, 0.5F}, {0, 0.25F, 0}};
    s.rig.eyeballs = {{"left eye", {3, 4, 5}, {10, 5, 0}, 2}};
    s.mesh.positions = s.rig.rest;
    s.fapu.irisd = s.fapu.es = s.fapu.ens = s.fapu.mns = s.fapu.mw = 1024;
    s.fapu.es = 2048;
    s.fapu.points = s.rig.points;
    s.fapu.left_eye = {10, 5, 0};
    s.fapu.neck = {0, 0, -3};
    return s;
}

BakedFat baked(const Small& s, const BakeFatOptions& options = {}) {
    return bake_fat(s.rig, s.mesh, s.fapu, options);
}

const FaceDefTables* table_of(const Fat& fat, int fap) {
    for (const FaceDefTables& table : fat.tables)
        if (table.fap == fap) return &table;
    return nullptr;
}

FapFrame frame_of(std::initializer_list<std::pair<int, std::int32_t>> values) {
    FapFrame frame;
    for (const auto& [fap, value] : values) {
        frame.mask.set(fap_index(fap));
        frame.value[fap_index(fap)] = value;
    }
    return frame;
}

TEST(BakeFat, GivesEveryVertexItsShareOfTheParametersWay) {
    const Small s = small();
    const Fat fat = baked(s).fat;
    const FaceDefTables* jaw = table_of(fat, 3);
    ASSERT_NE(jaw, nullptr);
    ASSERT_EQ(jaw->meshes.size(), 1U);
    EXPECT_THAT(jaw->meshes[0].vertices, ElementsAre(0, 2));
    EXPECT_THAT(jaw->meshes[0].displacements,
                ElementsAre(Vec3f{0, -1, 0}, Vec3f{0, -1, 0}, Vec3f{0, -0.5F, 0}, Vec3f{0, -0.5F, 0}));
    const FaceDefTables* brow = table_of(fat, 33);
    ASSERT_NE(brow, nullptr);
    EXPECT_THAT(brow->meshes.at(0).vertices, ElementsAre(1, 2));
    EXPECT_EQ(brow->meshes[0].displacements[2], (Vec3f{0, 0.25F, 0}));
    EXPECT_EQ(table_of(fat, 4), nullptr);
    EXPECT_NO_THROW(check_fat(fat, 6));
}

TEST(BakeFat, OfALinearRigHasTwoIntervalsAndNoError) {
    const BakedFat result = baked(small());
    EXPECT_EQ(table_of(result.fat, 3)->meshes[0].borders.size(), 3U);
    EXPECT_LT(result.alone.max, 1e-3);
}

TEST(BakeFat, TurnsEyeballsAndTheHeadAsNodes) {
    const Small s = small();
    const Fat fat = baked(s).fat;
    ASSERT_EQ(fat.nodes.size(), 2U);
    EXPECT_EQ(fat.nodes[0].name, "left eye");
    EXPECT_EQ(fat.nodes[1].vertices.size(), 6U);
    EXPECT_EQ(fat.nodes[1].centre, (Vec3{0, 0, -3}));
    EXPECT_TRUE(table_of(fat, 23)->meshes.empty());
    EXPECT_EQ(table_of(fat, 24), nullptr);
    std::vector<Vec3f> positions(6);
    deform(fat, s.rig.rest, frame_of({{23, 157080}}), positions);  // a quarter turn to the left
    EXPECT_LT(distance(positions[3], Vec3f{12, 5, 0}), 1e-3F);
    EXPECT_EQ(positions[2], s.rig.rest[2]);
    BakeFatOptions options;
    options.head = false;
    EXPECT_EQ(table_of(baked(s, options).fat, 49), nullptr);
}

TEST(BakeFat, LeavesOutWhatIsNotSent) {
    BakeFatOptions options;
    for (int fap = 31; fap <= 38; ++fap) options.sent.reset(fap_index(fap));  // no brow
    EXPECT_EQ(table_of(baked(small(), options).fat, 33), nullptr);
}

TEST(BakeFat, RefusesTheMeshOfAnotherRig) {
    Small s = small();
    s.mesh.positions.pop_back();
    EXPECT_THAT(refusal([&] { static_cast<void>(baked(s)); }), HasSubstr("with 6 vertices, found 5"));
}

TEST(FatError, IsTheDistanceToWhatIsPlayed) {
    const Small s = small();
    const Fat fat = baked(s).fat;
    FapStream stream;
    stream.frames = {frame_of({{3, 100}}), frame_of({{3, 0}})};
    MeshSequence truth = deform(fat, s.mesh, stream);
    EXPECT_EQ(fat_error(fat, stream, truth).max, 0);
    const auto exact = truth.positions;
    truth.positions = [exact](std::size_t row, std::span<Vec3f> positions) {
        exact(row, positions);
        if (row == 1) positions[4].x += 3;
    };
    EXPECT_NEAR(fat_error(fat, stream, truth).max, 3, 1e-6);
    EXPECT_NEAR(fat_error(fat, stream, truth).mean, 3 / std::sqrt(12), 1e-6);
    stream.frames.pop_back();
    EXPECT_THAT(refusal([&] { static_cast<void>(fat_error(fat, stream, truth)); }), HasSubstr("1 frames, found 2"));
}

// ---- shapes

MorphTarget shape(std::string name, std::vector<std::uint32_t> vertices, std::vector<Vec3f> deltas) {
    return {std::move(name), std::move(vertices), std::move(deltas)};
}

TEST(FatOfShapes, GivesAShapeBackThatItsOwnPointsShow) {
    const Small s = small();
    FatOfShapesOptions options;
    options.ridge = 1e-9;
    // The chin goes down by 100; what is between follows by 70, and to the side.
    const std::vector shapes{shape("jawOpen", {0, 2}, {{0, -100, 0}, {20, -70, 0}})};
    const BakedFat bent = fat_of_shapes(baked(s).fat, s.mesh, s.fapu, s.rig.points, shapes, options);
    EXPECT_LT(bent.alone.max, 1e-2);
    std::vector<Vec3f> positions(6);
    deform(bent.fat, s.rig.rest, frame_of({{3, 100}}), positions);
    EXPECT_LT(distance(positions[2], Vec3f{20, -66, 0}), 1e-2F);
    EXPECT_LT(distance(positions[0], Vec3f{0, -100, 0}), 1e-2F);
}

TEST(FatOfShapes, LeavesTheOtherSideOfZeroAndOtherParametersAsTheyWere) {
    const Small s = small();
    const std::vector shapes{shape("jawOpen", {0, 2}, {{0, -100, 0}, {20, -70, 0}})};
    const Fat before = baked(s).fat, after = fat_of_shapes(before, s.mesh, s.fapu, s.rig.points, shapes).fat;
    for (const auto& frame : {frame_of({{3, -100}}), frame_of({{33, 50}}), frame_of({{23, 5000}})}) {
        std::vector<Vec3f> a(6), b(6);
        deform(before, s.rig.rest, frame, a);
        deform(after, s.rig.rest, frame, b);
        EXPECT_EQ(a, b);
    }
}

TEST(FatOfShapes, MakesTablesOfVisemesAndExpressions) {
    const Small s = small();
    const std::vector shapes{shape("viseme_aa", {2}, {{0, -63, 0}}), shape("happy", {1}, {{6.3F, 0, 0}}),
                             shape("a scar", {1}, {{1, 0, 0}})};
    const Fat fat = fat_of_shapes(baked(s).fat, s.mesh, s.fapu, s.rig.points, shapes).fat;
    EXPECT_NO_THROW(check_fat(fat, 6));
    FapFrame frame = frame_of({{1, 0}, {2, 0}});
    frame.viseme = {10, 0, 63, false};
    frame.expression = {1, 63, 0, 0, false, false};
    std::vector<Vec3f> positions(6);
    deform(fat, s.rig.rest, frame, positions);
    EXPECT_LT(distance(positions[2], Vec3f{0, -59, 0}), 1e-4F);
    EXPECT_LT(distance(positions[1], Vec3f{6.3F, 8, 0}), 1e-4F);
}

TEST(FatOfShapes, RefusesShapesOfNoKnownNameOrOfAnotherHead) {
    const Small s = small();
    const auto refused = [&](MorphTarget one) {
        const std::vector shapes{std::move(one)};
        return refusal([&] { static_cast<void>(fat_of_shapes({}, s.mesh, s.fapu, s.rig.points, shapes)); });
    };
    EXPECT_THAT(refused(shape("a scar", {0}, {{1, 0, 0}})), HasSubstr("by the names of ARKit"));
    EXPECT_THAT(refused(shape("jawOpen", {6}, {{1, 0, 0}})), HasSubstr("jawOpen: expected vertices below 6"));
}

// ---- morph targets

Vec3f played(const Mesh& mesh, const MorphTrack& track, std::size_t row, std::uint32_t vertex) {
    Vec3f p = mesh.positions[vertex];
    for (std::size_t t = 0; t < track.targets.size(); ++t)
        for (std::size_t i = 0; i < track.targets[t].vertices.size(); ++i)
            if (track.targets[t].vertices[i] == vertex)
                p += track.weights[row * track.targets.size() + t] * track.targets[t].deltas[i];
    return p;
}

TEST(FatMorphs, SayExactlyWhatTheTableSays) {
    const Small s = small();
    Fat fat = baked(s).fat;
    fat.tables.front().meshes.front() = {
        {-200, 0, 50, 100}, {0, 2}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}}};
    FapStream stream;
    for (const int value : {-500, -100, 0, 20, 70, 300})
        stream.frames.push_back(frame_of({{3, value}, {33, value}, {23, 100 * value}, {25, -70 * value}}));
    const MorphTrack track = fat_morphs(fat, s.mesh, stream);
    const MeshSequence sequence = deform(fat, s.mesh, stream);
    std::vector<Vec3f> expected(6);
    for (std::size_t r = 0; r < stream.frames.size(); ++r) {
        sequence.positions(r, expected);
        for (std::uint32_t v = 0; v < 6; ++v)
            EXPECT_LT(distance(played(s.mesh, track, r, v), expected[v]), 2e-4F) << r << " " << v;
    }
    EXPECT_LT(track.max_error, 2e-4);
    EXPECT_TRUE(track.head.empty());
}

TEST(FatMorphs, AreNamedByTheirParametersAndTheirSidesOfZero) {
    const Small s = small();
    Fat fat = baked(s).fat;
    fat.tables.front().meshes.front() = {
        {-200, 0, 50, 100}, {0, 2}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}}};
    const MorphTrack track = fat_morphs(fat, s.mesh, {});
    std::vector<std::string> names;
    for (const MorphTarget& target : track.targets) names.push_back(target.name);
    EXPECT_THAT(names, testing::IsSupersetOf({"open_jaw_below", "open_jaw_50", "open_jaw_100", "raise_l_m_eyebrow"}));
    EXPECT_TRUE(track.times.empty());
    EXPECT_TRUE(track.weights.empty());
}

TEST(FatMorphs, LeaveTheTurnOfTheHeadToTheTrack) {
    const Small s = small();
    FapStream stream;
    stream.frames = {frame_of({{49, 0}}), frame_of({{49, 50000}, {50, 20000}})};
    const MorphTrack track = fat_morphs(baked(s).fat, s.mesh, stream);
    ASSERT_EQ(track.head.size(), 2U);
    EXPECT_EQ(track.head[0], Pose{});
    const MeshSequence sequence = deform(baked(s).fat, s.mesh, stream);
    std::vector<Vec3f> expected(6);
    sequence.positions(1, expected);
    for (std::size_t v = 0; v < 6; ++v)
        EXPECT_LT(distance(to_float(apply(track.head[1], to_double(s.rig.rest[v]))), expected[v]), 1e-5F);
}

// ---- real heads

// Speech and emotions, and eyes that look about.
FapStream speech() {
    FapStream stream;
    for (std::uint32_t i = 0; i < 40; ++i) {
        FapFrame frame = frame_of({{1, 0}, {2, 0}, {23, 0}, {24, 0}, {25, 0}, {26, 0}, {19, 0}, {20, 0}});
        frame.number = i;
        frame.viseme = {static_cast<std::uint8_t>(1 + i % 14), static_cast<std::uint8_t>(1 + (i + 3) % 14),
                        static_cast<std::uint8_t>(5 * i % 64), false};
        frame.expression = {
            static_cast<std::uint8_t>(1 + i / 7 % 6), static_cast<std::uint8_t>(3 * i % 50), 0, 0, false, false};
        frame.value[fap_index(23)] = frame.value[fap_index(24)] = static_cast<int>(i) * 800 - 16000;
        frame.value[fap_index(25)] = frame.value[fap_index(26)] = 10000 - static_cast<int>(i) * 500;
        frame.value[fap_index(19)] = frame.value[fap_index(20)] = static_cast<int>(i * 97 % 1000);
        stream.frames.push_back(frame);
    }
    return resolve_faps(stream);
}

void plays_like_its_rig(const Face& face, double most_mean, double most) {
    const Rig rig = rig_biharmonic(face);
    const Fapu fapu = measure_fapu(face);
    const FapStream stream = speech();
    BakeFatOptions options;
    options.sent = stream.frames.front().mask;
    for (const FapFrame& frame : stream.frames) options.sent |= frame.mask;
    const BakedFat result = bake_fat(rig, face.mesh, fapu, options);
    EXPECT_NO_THROW(check_fat(result.fat, vertex_count(face.mesh)));
    // A jaw goes straight; lids slide over an eye, which takes borders.
    EXPECT_EQ(table_of(result.fat, 3)->meshes.at(0).borders.size(), 3U);
    EXPECT_GT(table_of(result.fat, 19)->meshes.at(0).borders.size(), 3U);
    const FatError together = fat_error(result.fat, stream, deform(rig, face.mesh, play_faps(face, stream, fapu)));
    const double eyes = eye_distance(face.points);
    std::cout << "in eye distances: alone mean " << result.alone.mean / eyes << " most " << result.alone.max / eyes
              << ", together mean " << together.mean / eyes << " most " << together.max / eyes << "\n";
    // Eyeballs: a rig turns them by the shortest way to the pupil's new place, a table about the axes of the standard.
    EXPECT_LT(result.alone.max / eyes, 0.03);
    EXPECT_LT(result.alone.mean / eyes, 1e-3);
    EXPECT_LT(together.mean / eyes, most_mean);
    EXPECT_LT(together.max / eyes, most);
}

TEST(BakeFat, PlaysTheSampleHeadLikeItsRig) {
    const std::filesystem::path samples = std::filesystem::path(MIEN_SOURCE) / "samples";
    plays_like_its_rig(read_face(samples / "head.glb", samples / "head.points.json"), 1e-3, 0.02);
}

TEST(BakeFat, PlaysARealHeadLikeItsRig) {
    const std::filesystem::path folder = std::filesystem::path(MIEN_SHARED) / "data/mh-caucasian";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "the head is not there";
    plays_like_its_rig(read_face(folder / "mh-caucasian-female.glb", folder / "points-glb.json"), 1e-3, 0.02);
}

}  // namespace
}  // namespace mien
