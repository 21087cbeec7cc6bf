// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Written GLB files played by an independent player: every vertex is where the skin, the joints' poses and the head's
// pose say, or where the morph targets' weights say.

#include <array>
#include <cmath>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iterator>
#include <map>
#include <numbers>
#include <set>

#include "io/gltf_builder.hpp"
#include "io/gltf_player.hpp"
#include "shapes.hpp"

#include "mien/error.hpp"
#include "mien/io/gltf.hpp"

namespace mien {
namespace {

using played::json;
using played::Player;

constexpr double rounding = 2e-6;  // some units in the last place of a float near 3

// A dome with a ball over it as an eyeball; points "a" (free), "b" (held along y and z), "c" (driven by nobody) and
// "3.5" on the ball's pole, which aims it. Weights are arbitrary, so that a mixed-up index cannot go unseen.
struct Performer {
    Mesh mesh;
    Rig rig;
    Skin skin;
    Take take;
};

void weigh_vertex(Performer& p, std::uint32_t v, bool in_eye) {
    const auto joints = static_cast<std::uint16_t>(joint_count(p.rig));
    float total = 0;
    std::vector<float> weights;
    for (std::uint32_t k = 0; k < p.skin.influences; ++k) {
        p.skin.joints.push_back(static_cast<std::uint16_t>(in_eye ? joints - 1 : (v + 3 * k) % (joints - 1U)));
        weights.push_back(in_eye ? (k == 0 ? 1.0F : 0.0F) : 1.0F / static_cast<float>(1 + (v * 7 + k * 5) % 11));
        total += weights.back();
    }
    if (in_eye)
        for (std::uint32_t k = 1; k < p.skin.influences; ++k) p.skin.joints[v * p.skin.influences + k] = 0;
    for (const float w : weights) p.skin.weights.push_back(w / total);
}

Performer performer(std::uint32_t influences = 4) {
    Performer p;
    p.mesh = shapes::mask().mesh;
    const auto skin_vertices = static_cast<std::uint32_t>(vertex_count(p.mesh));
    shapes::append(p.mesh, shapes::ball({0, 0, 0}, 0.25F), {0.5F, 0.25F, 1});
    p.rig.method = "by hand";
    for (const auto& [id, vertex] : std::map<std::string, std::uint32_t>{{"a", 30}, {"b", 200}, {"c", 310}})
        p.rig.points.push_back(shapes::point_at(p.mesh, id, vertex));
    p.rig.points[1].moves = {true, false, false};
    p.rig.points.push_back(shapes::point_at(p.mesh, "3.5", skin_vertices));
    p.rig.rest = p.mesh.positions;
    p.rig.eyeballs = {{"left eye", {}, {0.5, 0.25, 1}, 3}};
    p.skin.influences = influences;
    for (std::uint32_t v = 0; v < vertex_count(p.mesh); ++v) {
        p.rig.row_starts.push_back(static_cast<std::uint32_t>(p.rig.row_points.size()));
        weigh_vertex(p, v, v >= skin_vertices);
        if (v >= skin_vertices) p.rig.eyeballs[0].vertices.push_back(v);
        if (v >= skin_vertices) continue;
        p.rig.row_points.push_back(static_cast<std::uint16_t>(v % 3));
        p.rig.weights.push_back({0.5F, 0.25F, -0.125F});
    }
    p.rig.row_starts.push_back(static_cast<std::uint32_t>(p.rig.row_points.size()));
    return p;
}

// Uneven times; "a" moves and is lost once, "b" moves, "3.5" wanders over the ball.
Take moves_of(const Rig& rig) {
    Take take{{"b", "3.5", "nobody", "a"}, {0.5, 0.75, 1.5, 1.625}, {}, {}, "", false};
    const auto rest = [&](std::size_t i) { return rig.points[i].position; };
    for (std::size_t r = 0; r < 4; ++r) {
        const auto t = static_cast<double>(r);
        take.samples.push_back(rest(1) + Vec3{0.1 * t, 0.2, 0.3});
        take.samples.push_back(rest(3) + Vec3{0.05 * t, -0.1 * t, -0.02});
        take.samples.push_back({9, 9, 9});
        take.samples.push_back(r == 2 ? lost_sample : rest(0) + Vec3{0.01, -0.2 * t, 0.1 * t * t});
    }
    return take;
}

Performer moving(std::uint32_t influences = 4) {
    Performer p = performer(influences);
    p.take = moves_of(p.rig);
    return p;
}

std::vector<Pose> poses_in_row(const Performer& p, std::size_t r) {
    std::vector<Vec3f> moved(p.rig.points.size());
    displacements(p.rig, bind_take(p.rig, p.take), row(p.take, r), moved);
    std::vector<Pose> poses(joint_count(p.rig));
    joint_poses(p.rig, moved, poses);
    return poses;
}

// The skin as its header defines it.
Vec3 skinned(const Performer& p, std::uint32_t v, const std::vector<Pose>& poses) {
    Vec3 sum;
    for (std::size_t k = v * p.skin.influences; k < (v + 1) * std::size_t{p.skin.influences}; ++k) {
        const std::size_t joint = p.skin.joints[k];
        const Vec3 origin = joint_origin(p.rig, joint);
        sum += double{p.skin.weights[k]} * (origin + apply(poses[joint], to_double(p.mesh.positions[v]) - origin));
    }
    return sum;
}

// The vertex of the head behind each vertex of the file, by the place where it rests.
std::vector<std::uint32_t> sources(const Player& player, const Mesh& mesh) {
    std::map<std::array<float, 3>, std::uint32_t> known;
    for (std::uint32_t v = 0; v < vertex_count(mesh); ++v)
        known[{mesh.positions[v].x, mesh.positions[v].y, mesh.positions[v].z}] = v;
    std::vector<std::uint32_t> result;
    for (const json& node : player.root().at("nodes")) {
        if (!node.contains("mesh")) continue;
        for (const json& primitive : player.root().at("meshes").at(node["mesh"].get<std::size_t>()).at("primitives"))
            for (const auto& p : player.accessor(primitive.at("attributes").at("POSITION")))
                result.push_back(
                    known.at({static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])}));
    }
    return result;
}

double largest_distance(const std::vector<Vec3>& found, const std::vector<std::uint32_t>& source,
                        const std::function<Vec3(std::uint32_t)>& expected) {
    EXPECT_EQ(found.size(), source.size());
    double largest = 0;
    for (std::size_t i = 0; i < found.size(); ++i) largest = std::max(largest, distance(found[i], expected(source[i])));
    return largest;
}

std::set<std::string> animated(const Player& player, const std::string& path) {
    std::set<std::string> names;
    for (const json& animation : player.root().value("animations", json::array()))
        for (const json& channel : animation.at("channels")) {
            const json& node = player.root().at("nodes").at(channel.at("target").at("node").get<std::size_t>());
            if (channel.at("target").at("path") == path) names.insert(node.value("name", ""));
        }
    return names;
}

class PlayedJoints : public testing::TestWithParam<std::uint32_t> {};

TEST_P(PlayedJoints, carry_every_vertex_where_skin_and_poses_say_in_every_row) {
    const Performer p = moving(GetParam());
    const Player player(format_glb(p.mesh, p.rig, p.skin, p.take));
    const std::vector<std::uint32_t> source = sources(player, p.mesh);
    EXPECT_EQ(std::set<std::uint32_t>(source.begin(), source.end()).size(), vertex_count(p.mesh));
    const double start = player.duration() - (p.take.times.back() - p.take.times.front());
    for (std::size_t r = 0; r < row_count(p.take); ++r) {
        const std::vector<Pose> poses = poses_in_row(p, r);
        const double time = start + p.take.times[r] - p.take.times.front();
        EXPECT_LE(
            largest_distance(player.positions(time), source, [&](std::uint32_t v) { return skinned(p, v, poses); }),
            rounding)
            << "row " << r;
    }
}

INSTANTIATE_TEST_SUITE_P(Influences, PlayedJoints, testing::Values(4U, 8U));

TEST(PlayedJoints, rest_where_the_head_rests_without_a_take) {
    const Performer p = performer();
    const Player player(format_glb(p.mesh, p.rig, p.skin, Take{}));
    EXPECT_FALSE(player.root().contains("animations"));
    EXPECT_LE(largest_distance(player.positions(0), sources(player, p.mesh),
                               [&](std::uint32_t v) { return to_double(p.mesh.positions[v]); }),
              rounding);
}

TEST(PlayedJoints, have_a_track_only_if_they_move) {
    const Performer p = moving();
    const Player player(format_glb(p.mesh, p.rig, p.skin, p.take));
    EXPECT_THAT(animated(player, "translation"), testing::IsSupersetOf({"a", "b"}));
    EXPECT_FALSE(animated(player, "translation").contains("c"));
    EXPECT_EQ(animated(player, "rotation"), std::set<std::string>{"left eye"});
}

TEST(PlayedJoints, turn_and_shift_with_the_head_unless_told_not_to) {
    Performer p = moving();
    const double half = std::numbers::pi / 12;
    for (std::size_t r = 0; r < row_count(p.take); ++r)
        p.take.head.push_back({{0, std::sin(half * static_cast<double>(r)), 0, std::cos(half * static_cast<double>(r))},
                               {0.25, static_cast<double>(r), -1}});
    const Player player(format_glb(p.mesh, p.rig, p.skin, p.take));
    const Player still(format_glb(p.mesh, p.rig, p.skin, p.take, {.head_motion = false}));
    const std::vector<Pose> poses = poses_in_row(p, 3);
    const auto source = sources(player, p.mesh);
    EXPECT_LE(largest_distance(player.positions(player.duration()), source,
                               [&](std::uint32_t v) { return apply(p.take.head[3], skinned(p, v, poses)); }),
              2 * rounding);
    EXPECT_LE(largest_distance(still.positions(still.duration()), source,
                               [&](std::uint32_t v) { return skinned(p, v, poses); }),
              rounding);
}

TEST(PlayedJoints, are_the_same_bytes_each_time) {
    const Performer p = moving();
    EXPECT_EQ(format_glb(p.mesh, p.rig, p.skin, p.take), format_glb(p.mesh, p.rig, p.skin, p.take));
}

// Texture coordinates with a seam along a column of the dome: the file has its vertices twice, the head once.
TEST(PlayedJoints, hold_both_sides_of_a_texture_seam_together) {
    Performer p = moving();
    for (std::size_t f = 0; f < face_count(p.mesh); ++f)
        for (const std::uint32_t v : face(p.mesh, f))
            p.mesh.corner_uvs.push_back({p.mesh.positions[v].x / 4 + (f % 24 < 12 ? 0.0F : 0.5F), 0.5F});
    const Player player(format_glb(p.mesh, p.rig, p.skin, p.take));
    const auto source = sources(player, p.mesh);
    EXPECT_GT(source.size(), vertex_count(p.mesh));
    const std::vector<Pose> poses = poses_in_row(p, 3);
    EXPECT_LE(largest_distance(player.positions(player.duration()), source,
                               [&](std::uint32_t v) { return skinned(p, v, poses); }),
              rounding);
}

MorphTrack two_targets(const Mesh& mesh) {
    MorphTrack track;
    track.targets.push_back({"few", {1, 5, 8}, {{1, 0, 0}, {0, 2, 0}, {0.5F, 0, -1}}});
    track.targets.push_back({"all", {}, {}});
    for (std::uint32_t v = 0; v < vertex_count(mesh); ++v) {
        track.targets[1].vertices.push_back(v);
        track.targets[1].deltas.push_back({0, 0.25F * static_cast<float>(v % 5), 1});
    }
    track.times = {0, 0.5, 2};
    track.weights = {0, 1, 0.5F, -0.25F, 1.5F, 0};
    return track;
}

Vec3 morphed(const Mesh& mesh, const MorphTrack& track, std::uint32_t v, std::size_t row) {
    Vec3 sum = to_double(mesh.positions[v]);
    for (std::size_t t = 0; t < track.targets.size(); ++t)
        for (std::size_t i = 0; i < track.targets[t].vertices.size(); ++i)
            if (track.targets[t].vertices[i] == v)
                sum += double{track.weights[row * track.targets.size() + t]} * to_double(track.targets[t].deltas[i]);
    return sum;
}

TEST(PlayedMorphs, carry_every_vertex_by_the_weighted_sum_of_targets) {
    const Mesh mesh = shapes::mask().mesh;
    const MorphTrack track = two_targets(mesh);
    const Player player(format_glb(mesh, track));
    const auto source = sources(player, mesh);
    for (std::size_t r = 0; r < track.times.size(); ++r)
        EXPECT_LE(largest_distance(player.positions(track.times[r]), source,
                                   [&](std::uint32_t v) { return morphed(mesh, track, v, r); }),
                  rounding)
            << "row " << r;
    EXPECT_LE(distance(player.positions(0.25)[5],
                       0.5 * (morphed(mesh, track, source[5], 0) + morphed(mesh, track, source[5], 1))),
              rounding);
    EXPECT_EQ(format_glb(mesh, track), format_glb(mesh, track));
}

TEST(PlayedMorphs, have_their_names_and_a_small_file_where_few_vertices_move) {
    const Mesh mesh = shapes::grid(60, 60);
    MorphTrack track = two_targets(mesh);
    const std::size_t both = format_glb(mesh, track).size();
    track.targets.pop_back();
    track.weights = {0, 1, 0.5F};
    const Player player(format_glb(mesh, track));
    EXPECT_EQ(player.root()["meshes"][0]["extras"]["targetNames"], json::array({"few"}));
    EXPECT_LT(format_glb(mesh, track).size() + vertex_count(mesh) * 12, both + 1000);
}

TEST(PlayedMorphs, a_target_that_names_a_vertex_and_leaves_it_still_is_there_by_name) {
    const Mesh mesh = shapes::mask().mesh;
    MorphTrack track;
    track.targets = {{"still", {3}, {Vec3f{}}}, {"nothing", {}, {}}, {"up", {4}, {Vec3f{0, 1, 0}}}};
    const Player player(format_glb(mesh, track));
    EXPECT_EQ(player.root()["meshes"][0]["extras"]["targetNames"], json::array({"still", "up"}));
    EXPECT_EQ(player.root().count("animations"), 0U);
}

TEST(PlayedMorphs, go_with_the_head) {
    const Mesh mesh = shapes::mask().mesh;
    MorphTrack track = two_targets(mesh);
    const Quaternion turn{0, std::sin(0.3), 0, std::cos(0.3)};
    track.head = {{}, {turn, {1, 2, 3}}, {{0, 0, std::sin(-0.1), std::cos(0.1)}, {0, 0, 1}}};
    const Player player(format_glb(mesh, track));
    for (std::size_t r = 0; r < track.times.size(); ++r)
        EXPECT_LE(largest_distance(player.positions(track.times[r]), sources(player, mesh),
                                   [&](std::uint32_t v) { return apply(track.head[r], morphed(mesh, track, v, r)); }),
                  2 * rounding)
            << "row " << r;
    track.head.pop_back();
    EXPECT_THROW(static_cast<void>(format_glb(mesh, track)), Error);
}

// The dome and the ball as two meshes: a target moves only the ball.
TEST(PlayedMorphs, leave_other_meshes_still) {
    Mesh mesh = shapes::mask().mesh;
    const auto dome = static_cast<std::uint32_t>(vertex_count(mesh));
    const auto dome_faces = static_cast<std::uint32_t>(face_count(mesh));
    shapes::append(mesh, shapes::ball({}, 0.25F), {0.5F, 0.25F, 1});
    const auto all = static_cast<std::uint32_t>(vertex_count(mesh));
    mesh.parts = {
        {"dome", 0, 0, 0, dome, 0, dome_faces},
        {"ball", 1, 0, dome, all - dome, dome_faces, static_cast<std::uint32_t>(face_count(mesh)) - dome_faces}};
    MorphTrack track;
    track.targets = {{"up", {dome, all - 1}, {{0, 1, 0}, {0, 2, 0}}}};
    track.times = {0, 1};
    track.weights = {0, 0.75F};
    const Player player(format_glb(mesh, track));
    EXPECT_LE(largest_distance(player.positions(1), sources(player, mesh),
                               [&](std::uint32_t v) { return morphed(mesh, track, v, 1); }),
              rounding);
}

// A document whose only mesh has two primitives, three and four vertices, and hangs under nodes that move, turn,
// stretch and mirror it; a camera hangs on the same node.
Mesh two_primitives_in_a_tree() {
    GltfDocument document;
    const auto primitive = [&](const std::vector<Vec3f>& points, const std::vector<std::uint32_t>& triangles) {
        json attributes;
        attributes["POSITION"] = append_vectors(document, points, BufferTarget::vertices, Bounds::given);
        attributes["NORMAL"] =
            append_vectors(document, std::vector<Vec3f>(points.size(), {0, 0, 1}), BufferTarget::vertices);
        const std::size_t indices = append_indices(document, triangles);
        return json{{"attributes", attributes}, {"indices", indices}, {"material", 0}};
    };
    json primitives = json::array();
    primitives.push_back(primitive({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 1, 2}));
    primitives.push_back(primitive({{2, 0, 0.5F}, {3, 0, 0}, {3, 1, 0}, {2, 1, 1}}, {0, 1, 2, 0, 2, 3}));
    document.json["asset"]["version"] = "2.0";
    document.json["meshes"] = {{{"name", "pair"}, {"primitives", primitives}}};
    document.json["materials"] = {{{"name", "blue"}}};
    document.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
    document.json["nodes"] = {
        {{"translation", {5, 6, 7}}, {"children", {1}}},
        {{"mesh", 0}, {"camera", 0}, {"rotation", {0, 0, std::sqrt(0.5), std::sqrt(0.5)}}, {"scale", {2, -3, 0.5}}}};
    document.json["scenes"] = {{{"nodes", {0}}}};
    return parse_gltf(format_glb(document), nullptr);
}

TEST(PlayedSource, leaves_its_tree_and_stands_where_it_stood) {
    const Mesh mesh = two_primitives_in_a_tree();
    ASSERT_EQ(vertex_count(mesh), 7U);
    EXPECT_LE(distance(to_double(mesh.positions[2]), {5 + 3, 6, 7}), rounding);  // y times -3, turned to +x
    const Player player(format_glb(mesh, MorphTrack{}));
    const std::vector<Vec3> shown = player.positions(0);
    for (std::size_t v = 0; v < 7; ++v) EXPECT_LE(distance(shown.at(v), to_double(mesh.positions[v])), rounding);
    EXPECT_EQ(player.root()["nodes"][1]["camera"], 0);
    EXPECT_EQ(player.root()["meshes"][0]["primitives"][1]["material"], 0);
    EXPECT_EQ(player.root()["materials"][0]["name"], "blue");
}

// Mirrored by its scale, the first triangle's normal still looks to +z and its corners still go round it.
TEST(PlayedSource, keeps_the_outside_of_a_mirrored_mesh_outside) {
    const Mesh mesh = two_primitives_in_a_tree();
    const Player player(format_glb(mesh, MorphTrack{}));
    const json& primitive = player.root().at("meshes")[0].at("primitives")[0];
    const auto points = player.accessor(primitive.at("attributes").at("POSITION"));
    const auto corners = player.accessor(primitive.at("indices"));
    const auto at = [&](std::size_t corner) {
        const auto& p = points.at(static_cast<std::size_t>(corners.at(corner)[0]));
        return Vec3{p[0], p[1], p[2]};
    };
    const auto normal = player.accessor(primitive.at("attributes").at("NORMAL"))[0];
    const Vec3 winding = cross(at(1) - at(0), at(2) - at(0));
    EXPECT_NEAR(normal[2], 1, rounding);
    EXPECT_GT(winding.z, 0);
}

TEST(PlayedSource, performs_by_targets_on_all_primitives_of_a_mesh) {
    const Mesh mesh = two_primitives_in_a_tree();
    MorphTrack track;
    track.targets = {{"second only", {3, 6}, {{0, 1, 0}, {0, 0, -1}}}, {"first only", {1}, {{1, 1, 1}}}};
    track.times = {1, 2};
    track.weights = {0, 0, 0.5F, 2};
    const Player player(format_glb(mesh, track));
    for (const json& primitive : player.root().at("meshes")[0].at("primitives"))
        EXPECT_EQ(primitive.at("targets").size(), 2U);
    const std::vector<Vec3> shown = player.positions(player.duration());
    for (std::uint32_t v = 0; v < 7; ++v) EXPECT_LE(distance(shown.at(v), morphed(mesh, track, v, 1)), rounding);
}

TEST(PlayedSource, performs_by_joints_in_scene_space) {
    const Mesh mesh = two_primitives_in_a_tree();
    Performer p{mesh, {}, {}, {}};
    p.rig.rest = mesh.positions;
    p.rig.points = {shapes::point_at(mesh, "a", 1), shapes::point_at(mesh, "b", 4)};
    p.rig.row_starts.assign(8, 0);
    for (std::uint32_t v = 0; v < 7; ++v) weigh_vertex(p, v, false);
    p.take = {{"a"}, {0, 1}, {p.rig.points[0].position, p.rig.points[0].position + Vec3{1, 2, 3}}, {}, "", false};
    const Player player(format_glb(mesh, p.rig, p.skin, p.take));
    const std::vector<Vec3> shown = player.positions(1);
    for (std::uint32_t v = 0; v < 7; ++v) EXPECT_LE(distance(shown.at(v), skinned(p, v, poses_in_row(p, 1))), rounding);
}

// What was written is read back as the same head, and written again as the same bytes.
TEST(PlayedSource, is_read_back_as_it_was_written) {
    const Mesh mesh = two_primitives_in_a_tree();
    const Mesh once = parse_gltf(format_glb(mesh, MorphTrack{}), nullptr);
    EXPECT_EQ(once.positions, mesh.positions);
    EXPECT_EQ(once.face_starts, mesh.face_starts);
    const Performer p = moving();
    const Mesh skinned_head = parse_gltf(format_glb(p.mesh, p.rig, p.skin, p.take), nullptr);
    EXPECT_EQ(skinned_head.positions, p.mesh.positions);
}

}  // namespace
}  // namespace mien
