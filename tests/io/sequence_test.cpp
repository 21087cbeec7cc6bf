// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Rows of animated files: against formulas, against another player (tests/io/gltf_player.hpp), and against what deform
// gave before it was written.

#include "mien/io/sequence.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numbers>

#include "arkit_head.hpp"
#include "io/gltf_player.hpp"
#include "io/hostile.hpp"
#include "io/moving_document.hpp"
#include "refusal.hpp"
#include "shapes.hpp"

#include "mien/algorithms/bake_morphs.hpp"
#include "mien/algorithms/deform.hpp"
#include "mien/algorithms/rig_surface_distance.hpp"
#include "mien/algorithms/skin.hpp"
#include "mien/io/scene.hpp"

namespace mien {
namespace {

using namespace gltf_text;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

MeshSequence sequence_in(const GltfDocument& document, const SequenceOptions& options = {}) {
    return parse_gltf_sequence(format_glb(document), no_file, options);
}

std::vector<Animation> animations_in(const GltfDocument& document) {
    return parse_gltf_animations(format_glb(document), no_file);
}

std::vector<Vec3f> row_of(const MeshSequence& sequence, std::size_t row) {
    std::vector<Vec3f> positions(vertex_count(sequence.mesh), Vec3f{99, 99, 99});
    sequence.positions(row, positions);
    return positions;
}

SequenceOptions at_rate(double rate) {
    SequenceOptions options;
    options.rate = rate;
    return options;
}

SequenceOptions called(const std::string& animation) {
    SequenceOptions options;
    options.animation = animation;
    return options;
}

// A triangle whose one target lifts vertex 2 by 1, on a node.
GltfDocument lifted_triangle() {
    GltfDocument document = triangle();
    json& primitive = document.json["meshes"][0]["primitives"][0];
    primitive["targets"].push_back({{"POSITION", add_vec3(document, {0, 0, 0, 0, 0, 0, 0, 0, 1})}});
    document.json["meshes"][0]["extras"]["targetNames"] = {"lift"};
    add_node(document, {{"mesh", 0}, {"name", "head"}});
    document.json["scenes"] = json::array({{{"nodes", {0}}}});
    return document;
}

// How high vertex 2 is in each row of keys at 0 and 2 s, rows half a second apart.
std::vector<float> heights(const char* between, const std::vector<float>& values) {
    GltfDocument document = lifted_triangle();
    const std::size_t times = scalars(document, {0, 2});
    add_channel(document, 0, "weights", between, times, scalars(document, values));
    const MeshSequence sequence = sequence_in(document, at_rate(2));
    EXPECT_THAT(sequence.times, ElementsAre(0, 0.5, 1, 1.5, 2));
    std::vector<float> result;
    for (std::size_t row = 0; row < sequence.times.size(); ++row) {
        const std::vector<Vec3f> positions = row_of(sequence, row);
        EXPECT_EQ(positions[1], (Vec3f{1, 0, 0}));
        result.push_back(positions[2].z);
    }
    return result;
}

TEST(Sequence, weights_step_go_straight_or_along_a_cubic) {
    EXPECT_THAT(heights("STEP", {0.25F, 1}), ElementsAre(0.25F, 0.25F, 0.25F, 0.25F, 1));
    EXPECT_THAT(heights("LINEAR", {0, 1}), ElementsAre(0, 0.25F, 0.5F, 0.75F, 1));
    // Appendix C.5 by hand: v = 0 and 1, tangent out of the first key 0.5 a second, into the second 0, 2 s apart.
    const auto cubic = [](float t) { return (3 * t * t - 2 * t * t * t) + 2 * 0.5F * (t * t * t - 2 * t * t + t); };
    const std::vector<float> found = heights("CUBICSPLINE", {9, 0, 0.5F, 0, 1, 9});
    for (std::size_t row = 0; row < 5; ++row) EXPECT_NEAR(found[row], cubic(0.25F * static_cast<float>(row)), 1e-6);
}

TEST(Sequence, a_node_turns_evenly_along_the_shorter_arc_about_its_place) {
    GltfDocument document = lifted_triangle();
    document.json["nodes"][0]["translation"] = {5, 0, 0};
    const auto half = static_cast<float>(std::sqrt(0.5));
    const std::size_t times = scalars(document, {0, 1});
    // A quarter turn about z, given as the quaternion of the long way round.
    add_channel(document, 0, "rotation", "LINEAR", times,
                add_accessor(document, std::vector<float>{0, 0, 0, 1, 0, 0, -half, -half}, "VEC4", 5126, 4));
    const MeshSequence sequence = sequence_in(document, at_rate(10));
    ASSERT_EQ(sequence.times.size(), 11U);
    for (std::size_t row = 0; row < 11; ++row) {
        const double angle = std::numbers::pi / 2 * static_cast<double>(row) / 10;
        EXPECT_LT(distance(to_double(row_of(sequence, row)[1]), Vec3{5 + std::cos(angle), std::sin(angle), 0}), 1e-6);
    }
    EXPECT_EQ(sequence.mesh.positions[1], (Vec3f{6, 0, 0}));
}

TEST(Sequence, every_vertex_is_where_another_player_says) {
    const std::vector<std::byte> bytes = format_glb(everything());
    const Mesh mesh = parse(bytes);
    const MeshSequence sequence = parse_gltf_sequence(bytes, no_file, at_rate(17));
    EXPECT_EQ(sequence.mesh.positions, mesh.positions);
    const played::Player player(bytes);
    const auto shown = player.shown();
    ASSERT_EQ(sequence.times.size(), 35U);
    for (std::size_t row = 0; row < sequence.times.size(); ++row) {
        std::vector<Vec3> expected;
        for (const std::vector<Vec3>& part : player.positions(shown, sequence.times[row]))
            expected.insert(expected.end(), part.begin(), part.end());
        const std::vector<Vec3f> found = row_of(sequence, row);
        ASSERT_EQ(found.size(), expected.size());
        for (std::size_t v = 0; v < found.size(); ++v)
            ASSERT_LT(distance(to_double(found[v]), expected[v]), 5e-6) << "row " << row << " vertex " << v;
    }
}

TEST(Sequence, the_neutral_is_the_mesh_and_rows_come_in_any_order) {
    const std::vector<std::byte> bytes = format_glb(everything());
    const MeshSequence sequence = parse_gltf_sequence(bytes, no_file);
    EXPECT_EQ(sequence.mesh.face_vertices, parse(bytes).face_vertices);
    const std::vector<Vec3f> last = row_of(sequence, sequence.times.size() - 1), first = row_of(sequence, 0);
    EXPECT_EQ(row_of(sequence, sequence.times.size() - 1), last);
    EXPECT_EQ(row_of(sequence, 0), first);
    EXPECT_NE(first, last);
}

// Keys of the triangle's lift and of its node's place.
GltfDocument keyed(const std::vector<float>& of_weights, const std::vector<float>& of_place) {
    GltfDocument document = lifted_triangle();
    const std::size_t lift = scalars(document, of_weights), place = scalars(document, of_place);
    add_channel(document, 0, "weights", "LINEAR", lift, scalars(document, pattern(of_weights.size(), 1)));
    add_channel(document, 0, "translation", "LINEAR", place, add_vec3(document, pattern(3 * of_place.size(), 2)));
    return document;
}

std::vector<float> even_keys(std::size_t count, float first, float rate) {
    std::vector<float> times;
    for (std::size_t k = 0; k < count; ++k) times.push_back(first + static_cast<float>(k) / rate);
    return times;
}

TEST(Sequence, keys_of_a_baked_animation_are_the_rows) {
    std::vector<float> keys = even_keys(25, 1, 25);
    keys[3] += 0.01F;
    const MeshSequence sequence = sequence_in(keyed(keys, {1, keys[3], keys[24]}));
    ASSERT_EQ(sequence.times.size(), 25U);
    const std::vector<float> lift = pattern(25, 1);
    for (std::size_t row = 0; row < 25; ++row) {
        EXPECT_EQ(sequence.times[row], double{keys[row]} - 1);
        const std::vector<Vec3f> p = row_of(sequence, row);
        EXPECT_NEAR(p[2].z - p[0].z, lift[row], 1e-6) << row;
    }
}

TEST(Sequence, rows_lie_evenly_where_keys_are_few_or_apart) {
    const MeshSequence few = sequence_in(keyed({0, 0.7F}, {0, 1}));
    ASSERT_EQ(few.times.size(), 31U);
    EXPECT_DOUBLE_EQ(few.times[30], 1);
    const MeshSequence apart = sequence_in(keyed(even_keys(26, 0, 25), {0.013F, 1.2F}));
    EXPECT_EQ(apart.times.size(), 31U);
    EXPECT_NEAR(apart.times[1], 0.04, 1e-8);
    EXPECT_THAT(sequence_in(keyed({3}, {3})).times, ElementsAre(0));
}

TEST(Sequence, an_animation_is_told_by_its_name_or_its_number) {
    GltfDocument document = keyed({0, 1}, {0, 1});
    document.json["animations"][0]["name"] = "walk";
    document.json["animations"].push_back(document.json["animations"][0]);
    document.json["animations"][1]["name"] = "talk";
    document.json["animations"][1]["channels"].erase(1);
    const auto end = [&](const std::string& name) {
        const MeshSequence sequence = sequence_in(document, called(name));
        return row_of(sequence, sequence.times.size() - 1);
    };
    EXPECT_EQ(end(""), end("walk"));
    EXPECT_EQ(end("0"), end("walk"));
    EXPECT_EQ(end("1"), end("talk"));
    EXPECT_NE(end("talk"), end("walk"));
    const auto refused = [&](const std::string& name) { return refusal([&] { sequence_in(document, called(name)); }); };
    EXPECT_EQ(refused("sing"), "animation 'sing': expected one of 2 (0 'walk', 1 'talk')");
    EXPECT_THAT(refused("2"), HasSubstr("expected one of 2"));
}

TEST(Sequence, what_does_not_move_is_refused) {
    EXPECT_EQ(refusal([] { sequence_in(lifted_triangle()); }), "expected an animation, found none");
    GltfDocument document = keyed({0, 1}, {0, 1});
    for (json& channel : document.json["animations"][0]["channels"]) channel["target"].erase("node");
    EXPECT_THAT(refusal([&] { sequence_in(document); }), HasSubstr("expected one that moves the head, found none"));
}

TEST(Sequence, more_rows_than_a_million_and_rates_that_are_none_are_refused) {
    const GltfDocument document = keyed({0, 1e6F}, {0, 1});
    EXPECT_THAT(refusal([&] { sequence_in(document); }), HasSubstr("at most 1000000 rows, found 30000001"));
    EXPECT_EQ(animations_in(document).at(0).rows, 30000001U);
    EXPECT_EQ(sequence_in(document, at_rate(0.5)).times.size(), 500001U);
    EXPECT_THAT(refusal([&] { sequence_in(document, at_rate(-1)); }), HasSubstr("rows per second above 0, found -1"));
    EXPECT_THAT(refusal([&] { sequence_in(document, at_rate(NAN)); }), HasSubstr("found nan"));
}

TEST(Sequence, a_row_that_runs_over_is_refused_when_it_is_asked_for) {
    GltfDocument document = lifted_triangle();
    document.json["nodes"][0]["scale"] = {1e30, 1e30, 1e30};
    const std::size_t times = scalars(document, {0, 1});
    add_channel(document, 0, "weights", "LINEAR", times, scalars(document, {0, 1e30F}));
    const MeshSequence sequence = sequence_in(document, at_rate(1));
    EXPECT_EQ(row_of(sequence, 0)[1].x, 1e30F);
    EXPECT_EQ(refusal([&] { row_of(sequence, 1); }),
              "row 1, vertex 2: expected a finite position, found one that runs over");
}

TEST(Sequence, animations_say_what_moves_when_and_at_what_rate) {
    GltfDocument document = everything();
    document.json["animations"][0]["name"] = "all";
    const std::vector<Animation> all = animations_in(document);
    ASSERT_EQ(all.size(), 1U);
    EXPECT_EQ(all[0].name, "all");
    EXPECT_DOUBLE_EQ(all[0].start, 0);
    EXPECT_DOUBLE_EQ(all[0].seconds, 2);
    EXPECT_DOUBLE_EQ(all[0].rate, 30);
    EXPECT_EQ(all[0].rows, 61U);
    EXPECT_EQ(all[0].nodes.size(), 6U);
    EXPECT_THAT(all[0].nodes, testing::Contains("root"));
    EXPECT_THAT(all[0].morphs, ElementsAre("smile", "frown"));
    EXPECT_THAT(all[0].skins, ElementsAre("mesh 1"));
    EXPECT_THAT(animations_in(lifted_triangle()), IsEmpty());
}

TEST(Sequence, a_channel_that_holds_still_moves_nothing) {
    GltfDocument document = lifted_triangle();
    const std::size_t times = scalars(document, {0, 1});
    add_channel(document, 0, "weights", "LINEAR", times, scalars(document, {0.5F, 0.5F}));
    add_channel(document, 0, "translation", "CUBICSPLINE", times, add_vec3(document, std::vector<float>(18)));
    const Animation still = animations_in(document).at(0);
    EXPECT_THAT(still.morphs, IsEmpty());
    EXPECT_THAT(still.nodes, IsEmpty());
}

// A mask that smiles and nods, as deform bakes it.
struct Performance {
    Face face = shapes::mask();
    Rig rig = rig_surface_distance(face);
    Take take;

    explicit Performance(bool nods) {
        for (const FeaturePoint& point : face.points) take.points.push_back(point.id);
        for (std::size_t r = 0; r < 40; ++r) {
            const double t = static_cast<double>(r) / 50;
            take.times.push_back(t);
            for (std::size_t i = 0; i < face.points.size(); ++i)
                take.samples.push_back(face.points[i].position +
                                       0.1 * std::sin(7 * t + static_cast<double>(i)) * Vec3{0.2, 1, 0.4});
            if (nods) take.head.push_back(arkit::head_pose(t, {0, -1, -1}, 3));
        }
    }
    // On the face, and as the head carries it.
    [[nodiscard]] MeshSequence baked() const { return deform(rig, face.mesh, take); }
    [[nodiscard]] MeshSequence carried() const { return arkit::moving_sequence(baked(), take.head); }
};

// The largest distance between two sequences of equal rows.
double apart(const MeshSequence& a, const MeshSequence& b) {
    EXPECT_THAT(a.times, testing::Pointwise(testing::DoubleNear(1e-6), b.times));
    double largest = 0;
    for (std::size_t row = 0; row < std::min(a.times.size(), b.times.size()); ++row) {
        const std::vector<Vec3f> p = row_of(a, row), q = row_of(b, row);
        EXPECT_EQ(p.size(), q.size());
        for (std::size_t v = 0; v < p.size(); ++v) largest = std::max(largest, double{distance(p[v], q[v])});
    }
    return largest;
}

TEST(Sequence, morphs_that_were_baked_read_back_within_the_error_that_was_stated) {
    const Performance performance(false);
    const MorphTrack track = bake_morphs(performance.baked());
    const MeshSequence again = parse_gltf_sequence(format_glb(performance.face.mesh, track), no_file);
    EXPECT_LE(apart(again, performance.baked()), track.max_error + 1e-6);
    EXPECT_GT(track.max_error, 0);
}

TEST(Sequence, joint_tracks_read_back_as_the_rig_says_with_the_motion_of_the_head) {
    const Performance performance(true);
    const Skin skin = make_skin(performance.rig, performance.take, {8});
    const MeshSequence again =
        parse_gltf_sequence(format_glb(performance.face.mesh, performance.rig, skin, performance.take), no_file);
    EXPECT_LE(apart(again, performance.carried()), skin.max_error + 1e-6);
    EXPECT_GT(apart(again, performance.baked()), 0.05);
}

TEST(Sequence, a_recording_on_a_real_head_reads_back_row_for_row) {
    if (!arkit::is_there()) GTEST_SKIP() << "needs the recordings and the head of the shared data";
    const arkit::AnimatedHead head = arkit::animated_head("jm-slate3", 4);
    const MeshSequence again = parse_gltf_sequence(format_glb(head.still.mesh, head.track), no_file);
    EXPECT_LT(apart(again, head.still), 1e-7);
    EXPECT_EQ(parse_gltf_animations(format_glb(head.still.mesh, head.track), no_file).at(0).rows, 82U);
}

}  // namespace
}  // namespace mien
