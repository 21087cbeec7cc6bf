// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "io/gltf_instances.hpp"

#include <gmock/gmock.h>

#include "io/gltf_text.hpp"
#include "io/hostile.hpp"

namespace mien {
namespace {

using namespace gltf_text;
using testing::ElementsAre;
using testing::HasSubstr;

// An eye that is shown left and, mirrored, right, and a head behind it in the file.
GltfDocument two_eyes() {
    GltfDocument document = triangle();
    add_mesh(document, {0, 0, 9, 1, 0, 9, 0, 1, 9});
    document.json["meshes"][0]["name"] = "eye";
    add_node(document, {{"mesh", 0}, {"translation", {5, 0, 0}}});
    add_node(document, {{"mesh", 1}});
    add_node(document, {{"mesh", 0}, {"translation", {-5, 0, 0}}, {"scale", {-1, 1, 1}}});
    return document;
}

TEST(Instances, a_mesh_stands_at_every_node_that_shows_it) {
    const Mesh mesh = read(two_eyes());
    EXPECT_THAT(mesh.positions,
                ElementsAre(Vec3f{5, 0, 0}, Vec3f{6, 0, 0}, Vec3f{5, 1, 0}, Vec3f{0, 0, 9}, Vec3f{1, 0, 9},
                            Vec3f{0, 1, 9}, Vec3f{-5, 0, 0}, Vec3f{-6, 0, 0}, Vec3f{-5, 1, 0}));
    EXPECT_THAT(mesh.face_vertices, ElementsAre(0, 1, 2, 3, 4, 5, 6, 8, 7)) << "mirrored, the front stays in front";
}

TEST(Instances, copies_stand_behind_the_meshes_of_the_file_under_names_of_their_own) {
    const Mesh mesh = read(two_eyes());
    ASSERT_EQ(mesh.parts.size(), 3U);
    EXPECT_EQ(mesh.parts[0].name, "eye");
    EXPECT_EQ(mesh.parts[1].mesh, 1U);
    EXPECT_EQ(mesh.parts[2].name, "eye_2");
    EXPECT_EQ(mesh.parts[2].mesh, 2U);
    EXPECT_EQ(mesh.parts[2].first_vertex, 6U);
}

TEST(Instances, what_is_written_shows_every_copy_and_reads_back_equal) {
    const Mesh mesh = read(two_eyes());
    EXPECT_EQ(parse(mesh.gltf).positions, mesh.positions);
    EXPECT_EQ(parse(format_glb(mesh, MorphTrack{})).positions, mesh.positions);
}

TEST(Instances, a_shape_moves_every_copy_in_its_own_direction) {
    GltfDocument document = two_eyes();
    const std::size_t delta = add_vec3(document, {0, 0, 0, 1, 0, 0, 0, 0, 0});
    document.json["meshes"][0]["primitives"][0]["targets"] = json::array({{{"POSITION", delta}}});
    const Mesh mesh = read(document);
    ASSERT_EQ(mesh.morph_targets.size(), 1U);
    EXPECT_THAT(mesh.morph_targets[0].vertices, ElementsAre(1, 7));
    EXPECT_THAT(mesh.morph_targets[0].deltas, ElementsAre(Vec3f{1, 0, 0}, Vec3f{-1, 0, 0}));
}

TEST(Instances, copies_share_their_numbers) {
    GltfDocument document = triangle();
    for (int i = 0; i < 3; ++i) add_node(document, {{"mesh", 0}});
    const GltfDocument read_back = parse_glb(read(document).gltf);
    EXPECT_EQ(read_back.json["meshes"].size(), 3U);
    EXPECT_EQ(read_back.json["accessors"].size(), 1U);
    EXPECT_EQ(read_back.binary.size(), 36U);
}

TEST(Instances, nodes_that_the_scene_does_not_show_make_no_copy) {
    GltfDocument document = two_eyes();
    document.json["scenes"] = json::array({{{"nodes", {0, 1}}}});
    EXPECT_EQ(vertex_count(read(document)), 6U);
}

TEST(Instances, a_small_file_cannot_ask_for_large_copies) {
    GltfDocument document = triangle();
    document.json["meshes"][0]["extras"]["text"] = std::string(1000000, 'x');
    for (int i = 0; i < 100; ++i) add_node(document, {{"mesh", 0}});
    EXPECT_THAT(hostile::refusal(parse, glb_text(document)), HasSubstr("/mesh: expected at most"));
}

}  // namespace
}  // namespace mien
