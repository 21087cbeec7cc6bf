// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Scenes of files that are put together here: where every vertex is at every time is asked of another player
// (tests/io/gltf_player.hpp); all else is read off the file. tests/io/gltf_material_test.cpp has materials and
// pictures.

#include "mien/io/scene.hpp"

#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iterator>

#include "io/gltf_player.hpp"
#include "io/gltf_text.hpp"
#include "io/hostile.hpp"
#include "io/moving_document.hpp"
#include "io/scene_text.hpp"
#include "shapes.hpp"

#include "mien/io/obj.hpp"
#include "mien/io/read.hpp"

namespace mien {
namespace {

using namespace gltf_text;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

// Where a surface is, by what include/mien/scene.hpp says.
std::vector<Vec3> positions(const Scene& scene, const Surface& surface, const ScenePose& pose) {
    std::vector<Vec3> points;
    for (const Vec3f& p : surface.positions) points.push_back(to_double(p));
    for (std::size_t m = 0; m < surface.morphs.size(); ++m)
        for (std::size_t i = 0; i < surface.morphs[m].vertices.size(); ++i)
            points[surface.morphs[m].vertices[i]] +=
                double{pose.morph_weights[surface.node][m]} * to_double(surface.morphs[m].deltas[i]);
    if (!surface.skin) {
        for (Vec3& p : points) p = moved(pose.worlds[surface.node], p);
        return points;
    }
    const std::vector<Affine> maps = joint_maps(scene, scene.skins[*surface.skin], pose);
    for (std::size_t v = 0; v < points.size(); ++v) {
        Vec3 sum;
        for (std::size_t k = v * surface.influences; k < (v + 1) * surface.influences; ++k)
            sum += double{surface.weights[k]} * moved(maps[surface.joints[k]], points[v]);
        points[v] = sum;
    }
    return points;
}

// The scene is where the other player says, at rest, at times on and between keys and outside of them.
void expect_played(std::span<const std::byte> bytes, double tolerance, int steps) {
    const Scene scene = scene_in(bytes);
    ASSERT_TRUE(hostile::keeps_promise(scene));
    const played::Player player(bytes);
    const std::vector<played::Player::Shown> shown = player.shown();
    ASSERT_EQ(scene.surfaces.size(), shown.size());
    EXPECT_DOUBLE_EQ(duration(scene), player.duration());
    for (int step = -1; step <= steps + 1; ++step) {
        const double time = player.duration() * step / steps;
        const auto expected = player.positions(shown, time);
        const ScenePose pose = pose_at(scene, time);
        for (std::size_t s = 0; s < shown.size(); ++s) {
            EXPECT_EQ(scene.surfaces[s].mesh, shown[s].number);
            EXPECT_EQ(scene.surfaces[s].primitive, shown[s].primitive);
            const std::vector<Vec3> found = positions(scene, scene.surfaces[s], pose);
            ASSERT_EQ(found.size(), expected[s].size());
            for (std::size_t v = 0; v < found.size(); ++v)
                ASSERT_LT(distance(found[v], expected[s][v]), tolerance)
                    << "surface " << s << " vertex " << v << " at " << time;
        }
    }
}

TEST(IoScene, is_where_another_player_says_at_every_time) {
    expect_played(format_glb(everything()), 2e-6, 37);
}

TEST(IoScene, rests_where_the_file_rests) {
    GltfDocument document = everything();
    const Scene moving = scene_in(document);
    document.json.erase("animations");
    const std::vector<std::byte> still = format_glb(document);
    expect_played(still, 2e-6, 1);
    EXPECT_EQ(rest_pose(moving).worlds, rest_pose(scene_in(still)).worlds);
    EXPECT_EQ(rest_pose(moving).morph_weights, pose_at(scene_in(still), 1).morph_weights);
    EXPECT_NE(rest_pose(moving).worlds, pose_at(moving, 0).worlds);
}

TEST(IoScene, the_same_bytes_are_the_same_scene) {
    const GltfDocument document = everything();
    const Scene a = scene_in(document), b = scene_in(document);
    EXPECT_EQ(pose_at(a, 0.7).worlds, pose_at(b, 0.7).worlds);
    EXPECT_EQ(a.surfaces[4].weights, b.surfaces[4].weights);
}

TEST(IoScene, a_mesh_on_two_nodes_is_two_meshes_the_second_behind_all_of_the_file) {
    const Scene scene = scene_in(everything());
    ASSERT_EQ(scene.surfaces.size(), 5U);
    for (const std::size_t first : {0U, 1U}) {
        EXPECT_EQ(scene.surfaces[first].positions, scene.surfaces[first + 3].positions);
        EXPECT_EQ(scene.surfaces[first].primitive, scene.surfaces[first + 3].primitive);
        EXPECT_NE(scene.surfaces[first].node, scene.surfaces[first + 3].node);
        EXPECT_EQ(scene.surfaces[first + 3].mesh, 2U);
    }
    EXPECT_EQ(scene.surfaces[0].name, "face");
    EXPECT_EQ(scene.surfaces[3].name, "face_2");
    EXPECT_EQ(scene.surfaces[0].morphs[1].name, "frown");
    EXPECT_THAT(scene.surfaces[1].morphs[1].vertices, ElementsAre(1, 3));
    EXPECT_THAT(scene.nodes[scene.surfaces[0].node].morph_weights, ElementsAre(0.5F, -0.25F));
    EXPECT_THAT(scene.nodes[scene.surfaces[3].node].morph_weights, ElementsAre(0, 1));
}

// A rig counts the vertices as read_mesh does, meshes that nothing shows included.
TEST(IoScene, every_vertex_knows_its_number_in_the_mesh_of_the_file) {
    GltfDocument document = everything();
    document.json["nodes"][4].erase("mesh");
    document.json["nodes"][4].erase("skin");
    json& primitive = add_mesh(document, pattern(9, 20));
    primitive["mode"] = 0;
    add_mesh(document, pattern(9, 21));
    document.json["nodes"].push_back({{"mesh", 2}});
    document.json["nodes"].push_back({{"mesh", 3}});
    document.json["scenes"][0]["nodes"] = {3, 8, 9};
    document.json.erase("animations");
    const Scene scene = scene_in(document);
    const Mesh mesh = read(document);
    ASSERT_EQ(scene.surfaces.size(), 5U);
    EXPECT_THAT(scene.surfaces[2].mesh_vertices, ElementsAre(20, 21, 22));
    const ScenePose pose = rest_pose(scene);
    for (const Surface& surface : scene.surfaces) {
        for (const Part& part : mesh.parts)
            if (part.mesh == surface.mesh && part.primitive == surface.primitive) {
                EXPECT_EQ(surface.mesh_vertices.front(), part.first_vertex);
                EXPECT_EQ(surface.mesh_vertices.size(), part.vertex_count);
            }
        Surface plain = surface;
        plain.morphs.clear();
        const std::vector<Vec3> there = positions(scene, plain, pose);
        for (std::size_t v = 0; v < there.size(); ++v)
            EXPECT_LT(distance(there[v], to_double(mesh.positions[surface.mesh_vertices[v]])), 1e-6);
    }
    EXPECT_THAT(scene.left_out,
                ElementsAre("mesh 1: the scene does not show it", "mesh 2, primitive 0: points and lines"));
}

TEST(IoScene, strips_and_fans_are_triangles) {
    const auto corners = [](int mode) {
        GltfDocument document = square({0, 1, 2, 3}, mode);
        add_node(document, {{"mesh", 0}});
        return scene_in(document).surfaces.at(0).triangles;
    };
    EXPECT_THAT(corners(5), ElementsAre(0, 1, 2, 1, 3, 2));
    EXPECT_THAT(corners(6), ElementsAre(0, 1, 2, 0, 2, 3));
    EXPECT_THAT(corners(4), ElementsAre(0, 1, 2));
}

// The world map mirrors; whoever draws turns the triangles, since nodes may move.
TEST(IoScene, triangles_stay_as_they_are_in_the_space_of_a_mirrored_node) {
    GltfDocument document = triangle();
    add_node(document, {{"mesh", 0}, {"scale", {-1, 1, 1}}});
    const Scene scene = scene_in(document);
    EXPECT_THAT(scene.surfaces.at(0).triangles, ElementsAre(0, 1, 2));
    EXPECT_LT(determinant(rest_pose(scene).worlds[0]), 0);
}

TEST(IoScene, a_rotation_that_the_file_holds_in_few_digits_has_length_one) {
    GltfDocument document = triangle();
    add_node(document, {{"mesh", 0}, {"rotation", {0, 3, 0, 4}}});
    EXPECT_EQ(scene_in(document).nodes.at(0).rotation, (Quaternion{0, 0.6, 0, 0.8}));
    EXPECT_NEAR(length(read(document).positions.at(1)), 1, 1e-6);
}

TEST(IoScene, normals_have_length_one) {
    GltfDocument document = triangle();
    document.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] =
        add_vec3(document, {0, 3, 4, 0, 0, 0, -2, 0, 0});
    add_node(document, {{"mesh", 0}});
    EXPECT_THAT(scene_in(document).surfaces.at(0).normals,
                ElementsAre(Vec3f{0, 0.6F, 0.8F}, Vec3f{0, 0, 1}, Vec3f{-1, 0, 0}));
}

GltfDocument skinned_triangle(const std::vector<float>& weights) {
    GltfDocument document = triangle();
    json& attributes = document.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] =
        add_accessor(document, std::vector<std::uint8_t>{1, 0, 1, 0, 0, 1, 0, 0, 1, 1, 0, 0}, "VEC4", 5121, 4);
    attributes["WEIGHTS_0"] = add_accessor(document, weights, "VEC4", 5126, 4);
    add_node(document, {{"mesh", 0}, {"skin", 0}});
    add_node(document, {{"translation", {1, 0, 0}}});
    add_node(document, {{"translation", {0, 0, 1}}});
    document.json["skins"].push_back({{"joints", {1, 2}}});
    return document;
}

TEST(IoScene, weights_of_a_vertex_add_up_to_one_and_one_without_any_hangs_on_its_first_joint) {
    const Scene scene = scene_in(skinned_triangle({1, 2, 1, 0, -1, 0.5F, 0, 0, 0, 0, 0, 0}));
    const Surface& surface = scene.surfaces.at(0);
    EXPECT_EQ(surface.influences, 4U);
    EXPECT_THAT(surface.weights, ElementsAre(0.25F, 0.5F, 0.25F, 0, 0, 1, 0, 0, 1, 0, 0, 0));
    EXPECT_EQ(surface.joints[8], 1);
    EXPECT_TRUE(hostile::keeps_promise(scene));
}

TEST(IoScene, a_primitive_without_joints_goes_with_its_node_though_that_has_a_skin) {
    GltfDocument document = triangle();
    add_node(document, {{"mesh", 0}, {"skin", 0}, {"translation", {7, 0, 0}}});
    document.json["skins"].push_back({{"joints", {0}}});
    expect_played(format_glb([&] {
                      document.json["scenes"].push_back({{"nodes", {0}}});
                      return document;
                  }()),
                  1e-6, 1);
    EXPECT_FALSE(scene_in(document).surfaces.at(0).skin);
}

TEST(IoScene, what_is_wrong_with_a_skin_is_said_with_its_place) {
    GltfDocument document = skinned_triangle(std::vector<float>(12, 0.25F));
    document.json["skins"][0]["joints"] = {1};
    EXPECT_THAT(refusal(document),
                HasSubstr("/meshes/0/primitives/0/attributes/JOINTS_0: expected one of the 1 joints"));
    document.json["skins"][0]["joints"] = std::vector<int>(70000, 1);
    EXPECT_THAT(refusal(document), HasSubstr("/skins/0/joints: expected at most 65536"));
    document.json["skins"][0]["joints"] = {1, 9};
    EXPECT_THAT(refusal(document), HasSubstr("/skins/0/joints/1"));
}

GltfDocument animated(const char* path, const char* between, std::size_t components, std::size_t numbers) {
    GltfDocument document = triangle();
    add_node(document, {{"mesh", 0}});
    const std::size_t input = scalars(document, {0, 1});
    const char* type = components == 1 ? "SCALAR" : components == 3 ? "VEC3" : "VEC4";
    add_channel(document, 0, path, between, input, add_accessor(document, pattern(numbers, 1), type, 5126, components));
    return document;
}

TEST(IoScene, what_is_wrong_with_an_animation_is_said_with_its_place) {
    EXPECT_THAT(refusal(animated("translation", "LINEAR", 3, 9)),
                HasSubstr("/animations/0/samplers/0/output: expected 6 numbers for 2 times, found 9"));
    EXPECT_THAT(refusal(animated("translation", "CUBICSPLINE", 3, 6)), HasSubstr("expected 18 numbers"));
    EXPECT_THAT(refusal(animated("rotation", "LINEAR", 3, 6)), HasSubstr("/animations/0/samplers/0/output"));
    EXPECT_THAT(
        refusal(animated("scale", "BEZIER", 3, 6)),
        HasSubstr("/animations/0/samplers/0/interpolation: expected LINEAR, STEP or CUBICSPLINE, found 'BEZIER'"));
    GltfDocument document = animated("scale", "LINEAR", 3, 6);
    document.json["animations"][0]["samplers"][0]["input"] = scalars(document, {1, 0});
    EXPECT_THAT(refusal(document),
                HasSubstr("/animations/0/samplers/0/input: expected ascending times, found 0 after 1"));
}

TEST(IoScene, channels_that_cannot_be_played_are_named_and_the_others_play) {
    GltfDocument document = animated("weights", "LINEAR", 1, 2);
    const std::size_t input = scalars(document, {0, 1}), output = add_vec3(document, pattern(6, 1));
    document.json["nodes"].push_back({{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}});
    add_channel(document, 1, "scale", "LINEAR", input, output);
    add_channel(document, 0, "pointer", "LINEAR", input, output);
    add_channel(document, 0, "scale", "LINEAR", input, output);
    add_channel(document, 0, "translation", "LINEAR", input, output);
    document.json["animations"][0]["channels"][4]["target"].erase("node");
    document.json["animations"].push_back({{"name", "walk"}, {"channels", json::array()}});
    const Scene scene = scene_in(document);
    ASSERT_EQ(scene.channels.size(), 1U);
    EXPECT_EQ(scene.channels[0].property, Channel::Property::scale);
    EXPECT_THAT(
        scene.left_out,
        ElementsAre("channel 0 of the animation: it moves morph targets that its node does not have",
                    "channel 1 of the animation: it moves a part of a node that has a matrix",
                    "channel 2 of the animation: it moves 'pointer'", "channel 4 of the animation: it has no node",
                    "animation 1 'walk': the first is the one that plays"));
}

TEST(IoScene, weights_at_rest_are_as_many_as_targets) {
    GltfDocument document = everything();
    document.json["nodes"][7]["weights"] = {1, 2, 3};
    EXPECT_THAT(refusal(document), HasSubstr("/nodes/7/weights: expected 2 numbers"));
    document.json["nodes"][7].erase("weights");
    document.json["meshes"][0]["weights"] = "all";
    EXPECT_THAT(refusal(document), HasSubstr("/meshes/0/weights: expected 2 numbers"));
    document.json["meshes"][0].erase("weights");
    EXPECT_THAT(scene_in(document).nodes[scene_in(document).surfaces[0].node].morph_weights, ElementsAre(0, 0));
}

TEST(IoScene, what_else_a_file_has_is_named) {
    GltfDocument document = everything();
    document.json["extensionsUsed"] = {"KHR_lights_punctual", "KHR_mesh_quantization"};
    document.json["cameras"].push_back({{"type", "perspective"}});
    json& primitives = document.json["meshes"][0]["primitives"];
    primitives[1]["attributes"]["COLOR_0"] = add_accessor(document, std::vector<float>(16), "VEC4", 5126, 4);
    primitives[1]["targets"][0]["NORMAL"] = primitives[1]["targets"][0]["POSITION"];
    EXPECT_THAT(scene_in(document).left_out,
                UnorderedElementsAre("mesh 0 'face', primitive 1: colours of vertices",
                                     "mesh 2 'face_2', primitive 1: colours of vertices",
                                     "mesh 2 'face_2', primitive 1: normals of morph targets",
                                     "mesh 0 'face', primitive 1: normals of morph targets", "cameras of the file: 1",
                                     "extension 'KHR_lights_punctual'"));
    EXPECT_THAT(scene_in(everything()).left_out, IsEmpty());
}

// A few bytes of text may not ask for memory without bound.
TEST(IoScene, what_is_read_is_bounded_by_the_bytes_of_the_file) {
    GltfDocument many = empty();
    many.json["accessors"].push_back({{"type", "VEC3"}, {"componentType", 5126}, {"count", 100000}});
    many.json["meshes"].push_back({{"primitives", json::array({{{"attributes", {{"POSITION", 0}}}}})}});
    for (int i = 0; i < 1000; ++i) add_node(many, {{"mesh", 0}});
    EXPECT_THAT(refusal(many), HasSubstr("more vertices"));
    GltfDocument targets = triangle();
    targets.json["meshes"][0]["primitives"][0]["targets"] = json(std::vector<json>(10000, json::object()));
    for (int i = 0; i < 1000; ++i) add_node(targets, {{"mesh", 0}});
    EXPECT_THAT(refusal(targets), HasSubstr("more bytes of JSON in meshes shown again"));
    targets.json["scenes"].push_back({{"nodes", json::array()}});
    EXPECT_THAT(refusal(targets), HasSubstr("more morph targets")) << "weights of nodes that show nothing";
    GltfDocument sets = skinned_triangle(std::vector<float>(12, 0.25F));
    json& primitive = sets.json["meshes"][0]["primitives"][0];
    sets.json["accessors"].push_back({{"type", "VEC3"}, {"componentType", 5126}, {"count", 100000}});
    sets.json["accessors"].push_back({{"type", "VEC4"}, {"componentType", 5121}, {"count", 100000}});
    primitive["attributes"] = {{"POSITION", 3}};
    for (int s = 0; s < 100; ++s)
        for (const char* name : {"JOINTS", "WEIGHTS"}) primitive["attributes"][fmt::format("{}_{}", name, s)] = 4;
    EXPECT_THAT(refusal(sets), HasSubstr("more joints of vertices"));
    GltfDocument keys = triangle();
    keys.json["accessors"].push_back({{"type", "SCALAR"}, {"componentType", 5126}, {"count", 100000}});
    keys.json["accessors"].push_back({{"type", "VEC3"}, {"componentType", 5126}, {"count", 100000}});
    add_node(keys, {{"mesh", 0}});
    for (int c = 0; c < 100; ++c) add_channel(keys, 0, "scale", "STEP", 1, 2);
    EXPECT_THAT(refusal(keys), HasSubstr("more numbers of animations"));
    GltfDocument binds = triangle();
    binds.json["accessors"].push_back({{"type", "MAT4"}, {"componentType", 5126}, {"count", 60000}});
    add_node(binds, {{"mesh", 0}});
    for (int s = 0; s < 100; ++s) binds.json["skins"].push_back({{"joints", {0}}, {"inverseBindMatrices", 1}});
    EXPECT_THAT(refusal(binds), HasSubstr("more numbers of skins"));
}

TEST(IoScene, every_prefix_and_every_changed_byte_is_refused_or_keeps_the_promise) {
    const auto parse = [](std::span<const std::byte> bytes) { return scene_in(bytes); };
    const auto promise = [](const Scene& scene) { return hostile::keeps_promise(scene); };
    hostile::sweep(parse, glb_text(everything()), promise);
}

TEST(IoScene, a_mesh_without_a_document_is_a_surface_per_part_in_a_plain_material) {
    const std::string text =
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0.5 0.5\n"
        "g square\nf 1/1 2/2 3/3 4/4\ng flap\nf 1/1 2/2 5/3\ng back\nf 2/4 1/4 5/4\nf 3/4 2/2 5/4\n";
    const Scene scene = scene_of(parse_obj(as_bytes(text)));
    ASSERT_TRUE(hostile::keeps_promise(scene));
    ASSERT_EQ(scene.surfaces.size(), 3U);
    EXPECT_EQ(scene.surfaces[0].name, "square");
    EXPECT_THAT(scene.surfaces[0].triangles, ElementsAre(0, 1, 2, 0, 2, 3));
    EXPECT_THAT(scene.surfaces[1].mesh_vertices, ElementsAre(0, 1, 4));
    // Vertex 1 has two texture coordinates on the back, so it is there twice.
    EXPECT_THAT(scene.surfaces[2].mesh_vertices, ElementsAre(0, 1, 1, 2, 4));
    EXPECT_EQ(scene.surfaces[2].positions[2], (Vec3f{1, 0, 0}));
    EXPECT_EQ(scene.materials.size(), 1U);
    EXPECT_EQ(rest_pose(scene).worlds, std::vector<Affine>{Affine{}});
}

TEST(IoScene, faces_outside_of_all_parts_are_a_surface_too) {
    Mesh mesh = shapes::grid(3, 3);
    mesh.parts.push_back({"part", 0, 0, 0, 4, 1, 2});
    const Scene scene = scene_of(mesh);
    ASSERT_EQ(scene.surfaces.size(), 2U);
    std::size_t corners = 0;
    for (const Surface& surface : scene.surfaces) corners += surface.triangles.size();
    EXPECT_EQ(scene.surfaces[0].name, "part");
    EXPECT_EQ(corners, 6 * face_count(mesh)) << "two triangles a square";
    mesh.parts.clear();
    EXPECT_EQ(scene_of(mesh).surfaces.size(), 1U);
    EXPECT_THAT(scene_of(Mesh{}).surfaces, IsEmpty());
}

TEST(IoScene, a_flat_mesh_has_one_normal_and_its_morphs_move_every_copy_of_a_vertex) {
    Mesh mesh = shapes::grid(2, 2);
    mesh.corner_uvs.clear();
    for (std::size_t c = 0; c < mesh.face_vertices.size(); ++c) mesh.corner_uvs.push_back({static_cast<float>(c), 0});
    const std::uint32_t shared = 4;  // of all four squares
    mesh.morph_targets.push_back({"up", {shared}, {{0, 0, 2}}});
    const Scene scene = scene_of(mesh);
    ASSERT_TRUE(hostile::keeps_promise(scene));
    const Surface& surface = scene.surfaces.at(0);
    for (const Vec3f& normal : surface.normals) EXPECT_EQ(std::abs(normal.z), 1);
    std::size_t copies = 0;
    for (const std::uint32_t v : surface.mesh_vertices) copies += v == shared ? 1 : 0;
    EXPECT_EQ(copies, 4U);
    EXPECT_EQ(surface.morphs.at(0).vertices.size(), copies);
    for (const std::uint32_t v : surface.morphs[0].vertices) EXPECT_EQ(surface.mesh_vertices[v], shared);
}

TEST(IoScene, a_mesh_with_a_document_is_what_that_shows) {
    const GltfDocument document = everything();
    const Scene scene = scene_of(read(document));
    EXPECT_EQ(scene.surfaces.size(), 5U);
    EXPECT_EQ(pose_at(scene, 1).worlds, pose_at(scene_in(document), 1).worlds);
}

// What mien wrote plays as what it is made of; real heads are beside the project.
class OtherHeads : public testing::TestWithParam<const char*> {};

TEST_P(OtherHeads, are_where_another_player_says) {
    const std::filesystem::path path = std::filesystem::path(MIEN_SHARED) / "data" / GetParam();
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
    std::ifstream file(path, std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(file)), {});
    expect_played(as_bytes(text), 1e-5, 1);
    const Mesh mesh = read_mesh(path);
    for (const Surface& surface : read_scene(path).surfaces)
        for (const Part& part : mesh.parts)
            if (part.mesh == surface.mesh && part.primitive == surface.primitive) {
                EXPECT_EQ(surface.mesh_vertices.front(), part.first_vertex);
                EXPECT_EQ(surface.mesh_vertices.size(), part.vertex_count);
                EXPECT_EQ(surface.triangles.size(), 3 * std::size_t{part.face_count});
            }
}

INSTANTIATE_TEST_SUITE_P(Shared, OtherHeads,
                         testing::Values("ict/ict_face.glb", "mh-caucasian/mh-caucasian-male.glb",
                                         "mh-caucasian/mh-caucasian-female.glb"));

}  // namespace
}  // namespace mien
