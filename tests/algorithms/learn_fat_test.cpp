// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/learn_fat.hpp"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>

#include "animated_face.hpp"
#include "refusal.hpp"

#include "mien/algorithms/deform.hpp"
#include "mien/algorithms/replay_error.hpp"

namespace mien {
namespace {

using testing::HasSubstr;

struct Head {
    Face face = animated::head();
    Fapu fapu = measure_fapu(face);
};

// Learns from the head moved by a stream, with the parameters that moved it.
LearntFat learn(
    const Head& head, const FapStream& stream, Reading reading = Reading::remedied,
    const animated::Bend& bend = [](int, double value) { return value; }) {
    const MeshSequence sequence = animated::play(head.face, head.fapu, stream, {}, bend);
    return learn_fat(animated::still(head.face, sequence), head.fapu, stream, reading);
}

// Where one parameter alone takes the vertices, by the table and in truth.
std::vector<Vec3> played(const Head& head, const Fat& fat, int fap, std::int32_t value) {
    FapFrame frame;
    frame.mask.set();
    frame.value[fap_index(fap)] = value;
    std::vector<Vec3f> positions(vertex_count(head.face.mesh));
    deform(fat, head.face.mesh.positions, frame, positions);
    std::vector<Vec3> moves;
    for (std::size_t v = 0; v < positions.size(); ++v)
        moves.push_back(to_double(positions[v]) - to_double(head.face.mesh.positions[v]));
    return moves;
}

struct Comparison {
    double error = 0;    // RMS off / RMS true
    double outside = 0;  // largest motion where the truth has none, as a share of the peak
};

Comparison compare(const Head& head, const Fat& fat, int fap, std::int32_t value) {
    double off = 0, all = 0, peak = 0, outside = 0;
    const std::vector<Vec3> moves = played(head, fat, fap, value);
    for (std::uint32_t v = 0; v < moves.size(); ++v) {
        const Vec3 truth = static_cast<double>(value) * animated::field(head.face, head.fapu, fap, v);
        off += dot(moves[v] - truth, moves[v] - truth);
        all += dot(truth, truth);
        peak = std::max(peak, length(truth));
        if (length(truth) == 0) outside = std::max(outside, length(moves[v]));
    }
    return {std::sqrt(off / all), outside / peak};
}

const LearntParameter& about(const LearntFat& learnt, int fap) {
    return *std::find_if(learnt.parameters.begin(), learnt.parameters.end(),
                         [&](const LearntParameter& p) { return p.fap == fap; });
}

TEST(LearnFat, ParametersThatActAloneGiveTheirFields) {
    const Head head;
    const LearntFat learnt = learn(head, animated::one_by_one());
    for (const int fap : animated::moving_faps()) {
        const Comparison found = compare(head, learnt.fat, fap, 200);
        EXPECT_LT(found.error, 0.05) << fap_info(fap).name;
        EXPECT_LT(found.outside, 0.01) << fap_info(fap).name;
        EXPECT_EQ(about(learnt, fap).alone, about(learnt, fap).active);
        EXPECT_GT(about(learnt, fap).confidence, 0.99);
        EXPECT_EQ(about(learnt, fap).intervals, 1U);
    }
}

TEST(LearnFat, ParametersThatAlwaysActTogetherAreTakenApart) {
    const Head head;
    const LearntFat learnt = learn(head, animated::all_at_once());
    for (const int fap : animated::moving_faps()) {
        const Comparison found = compare(head, learnt.fat, fap, 200);
        EXPECT_LT(found.error, 0.05) << fap_info(fap).name;
        EXPECT_LT(found.outside, 0.01) << fap_info(fap).name;
        EXPECT_EQ(about(learnt, fap).alone, 0U);
    }
}

TEST(LearnFat, AVertexThatHardlyMovesWithAParameterDoesNotDependOnIt) {
    const Head head;
    const FapStream stream = animated::all_at_once();
    constexpr double eyes = 64, largest = 250;
    for (const FaceDefTables& table : learn(head, stream).fat.tables)
        for (const FaceDefMesh& mesh : table.meshes)
            for (const Vec3f& step : mesh.displacements)
                EXPECT_GT(largest * length(to_double(step)), 4e-4 * eyes) << fap_info(table.fap).name;
}

TEST(LearnFat, ParametersThatAreNeverApartShareByNearnessAndAreSaidToBeUnsure) {
    const Head head;
    FapStream stream = animated::all_at_once();
    for (FapFrame& frame : stream.frames) {
        for (const int fap : animated::moving_faps()) frame.value[fap_index(fap)] = 0;
        const auto value = static_cast<std::int32_t>(std::lround(200 * std::sin(0.1 * frame.number)));
        frame.value[fap_index(53)] = frame.value[fap_index(54)] = value;  // both corners of the mouth
    }
    const LearntFat learnt = learn(head, stream);
    EXPECT_LT(about(learnt, 53).confidence, 1e-3);
    for (const int fap : {53, 54}) {
        const std::vector<Vec3> moves = played(head, learnt.fat, fap, 200);
        for (std::uint32_t v = 0; v < moves.size(); ++v) {
            const bool here = (head.face.mesh.positions[v].x > 0) == (fap == 53);
            const Vec3 truth = here ? 200.0 * animated::field(head.face, head.fapu, fap, v) : Vec3{};
            EXPECT_LT(distance(moves[v], truth), 0.1 * 200 * head.fapu.mw / 1024) << fap << " at " << v;
        }
    }
}

TEST(LearnFat, AParameterThatBendsAtRestIsBentThere) {
    const Head head;
    const auto half_below = [](int fap, double value) { return fap == 31 && value < 0 ? 0.25 * value : value; };
    const LearntFat learnt = learn(head, animated::all_at_once(), Reading::remedied, half_below);
    EXPECT_GT(about(learnt, 31).intervals, 1U);
    EXPECT_EQ(about(learnt, 53).intervals, 1U);
    EXPECT_LT(compare(head, learnt.fat, 31, 200).error, 0.05);
    const std::vector<Vec3> up = played(head, learnt.fat, 31, 200), down = played(head, learnt.fat, 31, -200);
    const std::uint32_t brow = head.face.points[*find_point(head.face.points, "4.1")].vertex;
    EXPECT_LT(distance(down[brow], -0.25 * up[brow]), 0.02 * length(up[brow]));
}

// Half of a single unit is no border.
TEST(LearnFat, AParameterThatHardlyGoesBelowRestHasBordersThatAscend) {
    const Head head;
    FapStream stream = animated::all_at_once();
    for (FapFrame& frame : stream.frames) {
        std::int32_t& brow = frame.value[fap_index(31)];
        brow = std::max(brow, -1);
    }
    const auto faster_above = [](int fap, double value) { return fap == 31 && value > 125 ? 3 * value - 250 : value; };
    const LearntFat learnt = learn(head, stream, Reading::remedied, faster_above);
    EXPECT_EQ(about(learnt, 31).intervals, 3U);
    EXPECT_NO_THROW(deform(learnt.fat, head.face.mesh, stream));
}

TEST(LearnFat, EyeballsAndTheHeadTurnAsParts) {
    const Head head;
    const FapStream stream = animated::all_at_once(60);
    const std::vector<Pose> poses = animated::poses(60);
    const UprightSequence found = upright(animated::play(head.face, head.fapu, stream, poses), head.face.points);
    const FapStream faps_found = extract_faps(found, head.fapu);
    const LearntFat learnt = learn_fat(found, head.fapu, faps_found);
    ASSERT_EQ(learnt.fat.nodes.size(), 3U);
    EXPECT_EQ(learnt.fat.nodes.back().name, "head");
    EXPECT_EQ(learnt.fat.nodes.back().vertices.size(), vertex_count(head.face.mesh));
    const MeshSequence replay = deform(learnt.fat, head.face.mesh, faps_found);
    std::vector<Vec3f> is(vertex_count(head.face.mesh));
    const std::vector<Vec3> shifts = head_translations(found, head.fapu);
    std::vector<Vec3f> was = is;
    for (const std::size_t r : {7U, 33U, 59U}) {
        replay.positions(r, is);
        animated::play(head.face, head.fapu, stream, poses).positions(r, was);
        for (std::size_t v = 0; v < is.size(); ++v)
            EXPECT_LT(distance(to_double(is[v]) + shifts[r], to_double(was[v])), 0.15) << "vertex " << v;
    }
}

// Teeth of their own behind the mouth, that hang on the jaw: they turn about a hinge as the chin goes down.
TEST(LearnFat, TeethThatHangOnTheJawTurnAboutItsHinge) {
    Head head;
    constexpr double radians_per_unit = -0.0006;  // positive opens, the chin turns backwards and down
    const Vec3 hinge{0, -20, -70};
    const auto first = static_cast<std::uint32_t>(vertex_count(head.face.mesh));
    Mesh teeth = shapes::grid(6, 2, 4);
    shapes::append(head.face.mesh, teeth, {-12, -80, -25});
    const FapStream stream = animated::all_at_once();
    Head skin;
    MeshSequence sequence = animated::play(skin.face, skin.fapu, stream);
    sequence.mesh = head.face.mesh;
    sequence.positions = [&, positions = sequence.positions](std::size_t row, std::span<Vec3f> filled) {
        positions(row, filled.first(first));
        const double open = stream.frames[row].value[fap_index(3)];
        for (std::size_t v = first; v < filled.size(); ++v)
            filled[v] = to_float(hinge + rotate(animated::turn({1, 0, 0}, -radians_per_unit * open),
                                                to_double(head.face.mesh.positions[v]) - hinge));
    };
    const LearntFat learnt = learn_fat(animated::still(head.face, sequence), head.fapu, stream);
    const auto node = std::find_if(learnt.fat.nodes.begin(), learnt.fat.nodes.end(),
                                   [&](const FatNode& n) { return n.vertices.front() == first; });
    ASSERT_NE(node, learnt.fat.nodes.end());
    EXPECT_EQ(node->vertices.size(), vertex_count(teeth));
    EXPECT_NEAR(node->centre.y, hinge.y, 0.1);
    EXPECT_NEAR(node->centre.z, hinge.z, 0.1);
    const MeshSequence replay = deform(learnt.fat, head.face.mesh, stream);
    std::vector<Vec3f> is(vertex_count(head.face.mesh)), was = is;
    for (const std::size_t r : {11U, 77U, 140U}) {
        replay.positions(r, is);
        sequence.positions(r, was);
        for (std::size_t v = first; v < is.size(); ++v) EXPECT_LT(distance(is[v], was[v]), 0.02F);
    }
}

TEST(LearnFat, AHeadThatOnlyTurnsHasATableOfItsTurnsAlone) {
    const Head head;
    FapStream rest = animated::all_at_once(20);
    for (FapFrame& frame : rest.frames) frame.value.fill(0);
    const UprightSequence found =
        upright(animated::play(head.face, head.fapu, rest, animated::poses(20)), head.face.points);
    for (const Reading reading : {Reading::remedied, Reading::paper}) {
        const LearntFat learnt = learn_fat(found, head.fapu, rest, reading);
        ASSERT_EQ(learnt.fat.nodes.empty(), false);
        EXPECT_EQ(learnt.fat.nodes.back().name, "head");
        for (const FaceDefTables& table : learnt.fat.tables) {
            EXPECT_TRUE(table.meshes.empty());
            EXPECT_FALSE(table.transforms.empty());
        }
        EXPECT_TRUE(learnt.parameters.empty());
    }
}

// A parameter that is sent while nothing moves, and a head that moves without any.
TEST(LearnFat, AnAnimationAndAStreamThatHaveNothingToDoWithEachOtherGiveAnEmptyTable) {
    const Head head;
    const FapStream stream = animated::all_at_once(20);
    FapStream rest = stream;
    for (FapFrame& frame : rest.frames) frame.value.fill(0);
    const LearntFat still =
        learn_fat(animated::still(head.face, animated::play(head.face, head.fapu, rest)), head.fapu, stream);
    const LearntFat silent =
        learn_fat(animated::still(head.face, animated::play(head.face, head.fapu, stream)), head.fapu, rest);
    for (const LearntFat* learnt : {&still, &silent})
        for (const FaceDefTables& table : learnt->fat.tables) EXPECT_TRUE(table.meshes.empty());
    const std::uint32_t brow = head.face.points[*find_point(head.face.points, "4.1")].vertex;
    EXPECT_DOUBLE_EQ(silent.beyond[brow], silent.motion[brow]) << "nothing of it can be said";
    EXPECT_GT(silent.motion[brow], 0);
}

TEST(LearnFat, WhatNoParameterFollowsIsNamed) {
    const Head head;
    const FapStream stream = animated::all_at_once();
    MeshSequence sequence = animated::play(head.face, head.fapu, stream);
    const std::uint32_t loose = animated::vertex_at(0, 40);
    sequence.positions = [positions = sequence.positions, loose](std::size_t row, std::span<Vec3f> filled) {
        positions(row, filled);
        filled[loose].z += row % 2 == 0 ? 1.0F : -1.0F;  // a pulse that nothing else has
    };
    const LearntFat learnt = learn_fat(animated::still(head.face, sequence), head.fapu, stream);
    EXPECT_NEAR(learnt.motion[loose], 1, 1e-3);
    EXPECT_GT(learnt.beyond[loose], 0.9);
    const std::uint32_t brow = head.face.points[*find_point(head.face.points, "4.1")].vertex;
    EXPECT_LT(learnt.beyond[brow], 0.02 * learnt.motion[brow]);
}

TEST(LearnFat, AsWrittenParametersThatActAloneGiveTheirFields) {
    const Head head;
    const LearntFat learnt = learn(head, animated::one_by_one(), Reading::paper);
    for (const int fap : animated::moving_faps())
        for (const std::int32_t value : {300, -120}) {
            const Comparison found = compare(head, learnt.fat, fap, value);
            EXPECT_LT(found.error, 1e-3) << fap_info(fap).name;
            EXPECT_EQ(found.outside, 0) << fap_info(fap).name;
        }
}

TEST(LearnFat, AsWrittenBothWaysFromRestAreKeptApart) {
    const Head head;
    const auto half_below = [](int, double value) { return value < 0 ? 0.5 * value : value; };
    const LearntFat learnt = learn(head, animated::one_by_one(), Reading::paper, half_below);
    for (const int fap : animated::moving_faps()) {
        const std::vector<Vec3> up = played(head, learnt.fat, fap, 100), down = played(head, learnt.fat, fap, -100);
        const std::uint32_t v = head.face.points[*find_point(head.face.points, fap_info(fap).point)].vertex;
        EXPECT_LT(distance(down[v], -0.5 * up[v]), 1e-3 * length(up[v])) << fap_info(fap).name;
    }
}

TEST(LearnFat, AsWrittenAVertexDependsOnEveryParameterThatIsNeverActiveWithoutIt) {
    const Head head;
    const LearntFat learnt = learn(head, animated::all_at_once(40), Reading::paper);
    // Both corners of the mouth move in every frame, but no vertex between them does: growth keeps them apart.
    const auto depends = [&](int fap, const char* point) {
        const std::uint32_t vertex = head.face.points[*find_point(head.face.points, point)].vertex;
        for (const FaceDefTables& table : learnt.fat.tables)
            for (const FaceDefMesh& mesh : table.meshes)
                if (table.fap == fap && std::binary_search(mesh.vertices.begin(), mesh.vertices.end(), vertex))
                    return true;
        return false;
    };
    EXPECT_TRUE(depends(53, "8.3"));
    EXPECT_FALSE(depends(53, "8.4"));
    EXPECT_FALSE(depends(53, "2.1"));
}

TEST(LearnFat, AStreamWithoutFramesIsRefused) {
    const Head head;
    EXPECT_THAT(refusal([&] {
                    const FapStream one = animated::one_by_one();
                    const MeshSequence sequence = animated::play(head.face, head.fapu, one);
                    learn_fat(animated::still(head.face, sequence), head.fapu, FapStream{});
                }),
                HasSubstr("found none"));
}

}  // namespace
}  // namespace mien
