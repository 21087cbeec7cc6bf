// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The file is played by tests/io/gltf_player.hpp and has to show what skin weights and joint poses say.

#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <numeric>

#include "io/gltf_player.hpp"
#include "shapes.hpp"

#include "mien/error.hpp"
#include "mien/io/gltf.hpp"

namespace mien {
namespace {

using nlohmann::json;

struct Head {
    Mesh mesh;
    Rig rig;
    Skin skin;
};

// A sheet with feature points and an eyeball; weights are arbitrary, since any weights must come through.
Head head(std::uint32_t points = 3, std::uint32_t influences = 4) {
    Head made;
    made.mesh = shapes::grid(6, 5, 0.01F);
    const auto skin_vertices = static_cast<std::uint32_t>(vertex_count(made.mesh));
    shapes::append(made.mesh, shapes::ball({0.03F, 0.02F, 0.05F}, 0.012F, 6, 8));
    Rig& rig = made.rig;
    rig.rest = made.mesh.positions;
    for (std::uint32_t i = 0; i < points; ++i)
        rig.points.push_back(shapes::point_at(made.mesh, fmt::format("9.{}", i), i % skin_vertices));
    rig.points.push_back({"3.5", 0, {0.03, 0.02, 0.062}, {}, 0});
    rig.row_starts.assign(vertex_count(made.mesh) + 1, 0);
    rig.eyeballs.push_back({"left eye", {}, {0.03, 0.02, 0.05}, points});
    made.skin.influences = influences;
    for (std::uint32_t v = 0; v < vertex_count(made.mesh); ++v) {
        std::vector<double> weights;
        for (std::uint32_t k = 0; k < influences; ++k) weights.push_back(1.0 / (1 + (v * 7 + k * k) % 11));
        if (v < skin_vertices)
            weights[influences - 1] = 0;
        else
            weights = {1}, weights.resize(influences);
        const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
        for (std::uint32_t k = 0; k < influences; ++k) {
            const std::size_t joint = v < skin_vertices ? (v + k) % (points + 2) : points + 2;
            made.skin.joints.push_back(static_cast<std::uint16_t>(weights[k] > 0 ? joint : 0));
            made.skin.weights.push_back(static_cast<float>(weights[k] / sum));
        }
    }
    return made;
}

// Three rows from second `start` on in which every point but the second moves and one sample is lost.
Take performance(const Rig& rig, double start = 0) {
    Take take;
    for (const FeaturePoint& point : rig.points) take.points.push_back(point.id);
    for (std::size_t r = 0; r < 3; ++r) {
        take.times.push_back(start + 0.04 * static_cast<double>(r));
        for (std::size_t i = 0; i < rig.points.size(); ++i) {
            const double s = i == 1 ? 0 : static_cast<double>(r) * (1 + static_cast<double>(i % 5));
            take.samples.push_back(rig.points[i].position + Vec3{0.001 * s, -0.0007 * s, 0.0004 * s * s});
        }
    }
    row(take, 2)[0] = lost_sample;
    return take;
}

std::vector<Pose> poses_at(const Head& head, const Take& take, std::size_t r) {
    std::vector<Vec3f> moved(head.rig.points.size());
    displacements(head.rig, bind_take(head.rig, take), row(take, r), moved);
    std::vector<Pose> poses(joint_count(head.rig));
    joint_poses(head.rig, moved, poses);
    return poses;
}

Vec3 expected(const Head& head, const std::vector<Pose>& poses, std::size_t v) {
    Vec3 sum;
    for (std::size_t k = v * head.skin.influences; k < (v + 1) * head.skin.influences; ++k) {
        const Vec3 origin = joint_origin(head.rig, head.skin.joints[k]);
        const Vec3 p = to_double(head.mesh.positions[v]);
        sum += static_cast<double>(head.skin.weights[k]) * (origin + apply(poses[head.skin.joints[k]], p - origin));
    }
    return sum;
}

GltfDocument written(const Head& head, const Take& take, const GltfOptions& options = {}) {
    const std::vector<std::byte> bytes = format_glb(head.mesh, head.rig, head.skin, take, options);
    if (const char* folder = std::getenv("MIEN_KEEP_GLB")) {
        static int number = 0;
        std::ofstream file(fmt::format("{}/joints{}.glb", folder, number++), std::ios::binary);
        file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    }
    return parse_glb(bytes);
}

void expect_played(const Head& head, const Take& take, const GltfDocument& document) {
    const played::Player player(document);
    const json& animation = document.json["animations"][0];
    const std::vector<double> times = played::numbers(document, animation["samplers"][0]["input"]);
    ASSERT_EQ(times.size(), row_count(take));
    for (std::size_t r = 0; r < row_count(take); ++r) {
        const std::vector<Vec3> played = player.positions(times[r]);
        const std::vector<Pose> poses = poses_at(head, take, r);
        ASSERT_EQ(played.size(), vertex_count(head.mesh));
        for (std::size_t v = 0; v < played.size(); ++v) {
            const Vec3 still = expected(head, poses, v);
            const Vec3 there = take.head.empty() ? still : apply(take.head[r], still);
            ASSERT_LT(distance(played[v], there), 5e-8) << "row " << r << " vertex " << v;
        }
    }
}

TEST(Joints, a_skin_of_another_head_is_refused) {
    const Head good = head();
    Head bad = good;
    bad.skin.joints.pop_back();
    EXPECT_THROW(written(bad, {}), Error);
    bad = good;
    bad.skin.joints[5] = 99;
    EXPECT_THROW(written(bad, {}), Error);
    bad = good;
    bad.skin.influences = 3;
    EXPECT_THROW(written(bad, {}), Error);
    bad = good;
    bad.mesh.positions.push_back({});
    add_face(bad.mesh, std::array{0U, 1U, static_cast<std::uint32_t>(bad.mesh.positions.size() - 1)});
    EXPECT_THROW(written(bad, {}), Error);
}

TEST(Joints, the_file_plays_what_weights_and_poses_say) {
    const Head made = head();
    const Take take = performance(made.rig);
    ASSERT_NE(poses_at(made, take, 1).back().rotation, Quaternion{});
    expect_played(made, take, written(made, take));
}

TEST(Joints, more_than_four_influences_and_more_than_256_joints_come_through) {
    const Head made = head(300, 8);
    const Take take = performance(made.rig);
    const GltfDocument document = written(made, take);
    const json& attributes = document.json["meshes"][0]["primitives"][0]["attributes"];
    EXPECT_EQ(document.json["accessors"][attributes["JOINTS_1"].get<std::size_t>()]["componentType"], 5123);
    expect_played(made, take, document);
    const GltfDocument few = written(head(), {});
    const json& narrow = few.json["meshes"][0]["primitives"][0]["attributes"]["JOINTS_0"];
    EXPECT_EQ(few.json["accessors"][narrow.get<std::size_t>()]["componentType"], 5121);
}

TEST(Joints, weights_of_a_vertex_sum_to_one_and_idle_slots_name_joint_zero) {
    Head made = head();
    for (std::size_t k = 0; k < 4; ++k) {
        made.skin.weights[k] = 0;
        made.skin.weights[4 + k] *= 0.9F;
    }
    const GltfDocument document = written(made, {});
    const json& attributes = document.json["meshes"][0]["primitives"][0]["attributes"];
    const std::vector<double> weights = played::numbers(document, attributes["WEIGHTS_0"]);
    const std::vector<double> joints = played::numbers(document, attributes["JOINTS_0"]);
    for (std::size_t v = 0; v < weights.size() / 4; ++v)
        EXPECT_NEAR(std::accumulate(&weights[4 * v], &weights[4 * v] + 4, 0.0), 1, 2e-7);
    for (std::size_t slot = 0; slot < weights.size(); ++slot)
        if (weights[slot] == 0) {
            EXPECT_EQ(joints[slot], 0);
        }
    EXPECT_EQ(joints[0], static_cast<double>(made.rig.points.size())) << "a vertex without weights stands still";
    EXPECT_EQ(weights[0], 1);
}

TEST(Joints, nodes_have_the_names_of_the_points_and_meshes_are_roots_without_a_transform) {
    const Head made = head();
    const GltfDocument document = written(made, {});
    std::vector<std::string> names;
    for (const json& joint : document.json["skins"][0]["joints"])
        names.push_back(document.json["nodes"][joint.get<std::size_t>()]["name"]);
    EXPECT_THAT(names, testing::ElementsAre("9.0", "9.1", "9.2", "3.5", "still", "left eye"));
    for (std::size_t n = 0; n < document.json["nodes"].size(); ++n) {
        const json& node = document.json["nodes"][n];
        if (!node.contains("mesh")) continue;
        EXPECT_EQ(node.value("skin", -1), 0);
        EXPECT_FALSE(node.contains("translation") || node.contains("rotation") || node.contains("matrix"));
        EXPECT_THAT(document.json["scenes"][0]["nodes"], testing::Contains(json(n)));
    }
}

TEST(Joints, only_what_moves_has_a_track_and_all_share_their_times) {
    const Head made = head();
    const GltfDocument document = written(made, performance(made.rig, 12.5));
    const json& animation = document.json["animations"].at(0);
    EXPECT_EQ(animation["name"], "take");
    EXPECT_EQ(animation["channels"].size(), 4U) << "three of four points and the eyeball";
    for (const json& sampler : animation["samplers"]) EXPECT_EQ(sampler["input"], animation["samplers"][0]["input"]);
    const std::vector<double> times = played::numbers(document, animation["samplers"][0]["input"]);
    EXPECT_THAT(times, testing::ElementsAre(0, double{0.04F}, double{0.08F}));
    const json& accessor = document.json["accessors"][animation["samplers"][0]["input"].get<std::size_t>()];
    EXPECT_EQ(accessor["min"][0], 0);
    EXPECT_EQ(accessor["max"][0].get<float>(), 0.08F);
}

TEST(Joints, a_take_without_rows_or_without_motion_writes_no_animation) {
    const Head made = head();
    EXPECT_FALSE(written(made, {}).json.contains("animations"));
    Take still = performance(made.rig);
    for (Vec3& sample : still.samples) sample = lost_sample;
    EXPECT_FALSE(written(made, still).json.contains("animations"));
}

TEST(Joints, rows_whose_times_a_float_cannot_tell_apart_are_one_key) {
    const Head made = head();
    Take take = performance(made.rig);
    take.times = {0, 1000, 1000.00000001};
    const GltfDocument document = written(made, take);
    const json& input = document.json["animations"][0]["samplers"][0]["input"];
    EXPECT_THAT(played::numbers(document, input), testing::ElementsAre(0, 1000));
}

TEST(Joints, the_head_moves_with_the_root_unless_it_is_asked_not_to) {
    const Head made = head();
    Take take = performance(made.rig);
    for (std::size_t r = 0; r < 3; ++r) {
        const double angle = 1.4 * static_cast<double>(r) + 0.3;
        // The second key comes with the opposite sign: the same turn.
        const double sign = r == 1 ? -1 : 1;
        take.head.push_back({{0, sign * std::sin(angle / 2), 0, sign * std::cos(angle / 2)}, {0.1, 0.02, -0.3}});
    }
    const GltfDocument document = written(made, take);
    expect_played(made, take, document);
    const auto root = document.json["skins"][0]["skeleton"].get<std::size_t>();
    EXPECT_EQ(document.json["nodes"][root]["name"], "mien");
    for (const json& channel : document.json["animations"][0]["channels"]) {
        if (channel["target"]["node"] != root || channel["target"]["path"] != "rotation") continue;
        const json& sampler = document.json["animations"][0]["samplers"][channel["sampler"].get<std::size_t>()];
        const std::vector<double> q = played::numbers(document, sampler["output"]);
        for (std::size_t i = 4; i < q.size(); i += 4)
            EXPECT_GT(std::inner_product(&q[i], &q[i] + 4, &q[i - 4], 0.0), 0);
    }
    const GltfDocument at_rest = written(made, take, {false});
    take.head.clear();
    expect_played(made, take, at_rest);
}

TEST(Joints, the_same_head_gives_the_same_bytes) {
    const Head made = head();
    const Take take = performance(made.rig);
    EXPECT_EQ(format_glb(made.mesh, made.rig, made.skin, take), format_glb(made.mesh, made.rig, made.skin, take));
}

}  // namespace
}  // namespace mien
