// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/io/fbx.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numbers>

#include "io/fbx_text.hpp"
#include "io/gltf_text.hpp"
#include "io/hostile.hpp"
#include "io/text.hpp"
#include "refusal.hpp"

#include "mien/io/sequence.hpp"

namespace mien {
namespace {

using fbx_text::fbx;
using fbx_text::Square;
using gltf_text::no_file;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::byte> converted(const std::string& text) {
    return convert_fbx(as_bytes(text));
}

Mesh mesh_in(const Square& square) {
    return parse_gltf(converted(fbx(square)), no_file);
}

class Fbx : public testing::Test {
protected:
    void SetUp() override {
        const std::string refused = refusal([] { converted(""); });
        if (refused.find("without Assimp") != std::string::npos) GTEST_SKIP() << "this build reads no FBX";
    }
};

TEST_F(Fbx, corners_of_faces_are_joined_and_sizes_are_metres) {
    const Mesh mesh = mesh_in({});
    EXPECT_THAT(mesh.positions, ElementsAre(Vec3f{0, 0, 0}, Vec3f{1, 0, 0}, Vec3f{1, 1, 0}, Vec3f{0, 1, 0}));
    EXPECT_EQ(face_count(mesh), 2U);
    EXPECT_EQ(mesh.unit, "m");
    ASSERT_EQ(mesh.morph_targets.size(), 1U);
    EXPECT_EQ(mesh.morph_targets[0].name, "lift");
    EXPECT_THAT(mesh.morph_targets[0].vertices, ElementsAre(2));
    EXPECT_THAT(mesh.morph_targets[0].deltas, ElementsAre(Vec3f{0, 0, 0.5F}));
}

TEST_F(Fbx, a_mesh_of_two_materials_is_one_mesh_of_two_parts) {
    Square square;
    square.materials = true;
    square.skinned = true;
    const std::vector<std::byte> glb = converted(fbx(square));
    const Mesh mesh = parse_gltf(glb, no_file);
    ASSERT_EQ(mesh.parts.size(), 2U);
    for (std::uint32_t p = 0; p < 2; ++p) {
        EXPECT_EQ(mesh.parts[p].name, "face");
        EXPECT_EQ(mesh.parts[p].mesh, 0U);
        EXPECT_EQ(mesh.parts[p].primitive, p);
        EXPECT_EQ(mesh.parts[p].vertex_count, 3U);
    }
    ASSERT_EQ(mesh.morph_targets.size(), 1U);
    EXPECT_EQ(mesh.morph_targets[0].vertices.size(), 2U);
    SequenceOptions options;
    options.rate = 1;
    const MeshSequence sequence = parse_gltf_sequence(glb, no_file, options);
    std::vector<Vec3f> p(6);
    sequence.positions(2, p);
    const Vec3 of_bone{0, 2, 0.5}, of_node{3, 0, 0};
    for (const std::size_t v : {2U, 4U}) EXPECT_LT(distance(to_double(p[v]), of_bone), 1e-6) << v;
    for (const std::size_t v : {0U, 3U}) EXPECT_LT(distance(to_double(p[v]), of_node), 1e-6) << v;
}

TEST_F(Fbx, the_axes_and_the_unit_of_the_file_are_followed) {
    Square square;
    square.unit = 100;
    EXPECT_EQ(mesh_in(square).positions[2], (Vec3f{100, 100, 0}));
    square.unit = 1;
    square.axes = "2, 1, 1, -1, 0, 1";
    EXPECT_EQ(mesh_in(square).positions[2], (Vec3f{1, 0, -1}));
    square.axes = "1, 1, 1, 1, 1, 1";
    EXPECT_EQ(mesh_in(square).positions[2], (Vec3f{1, 1, 0}));
}

TEST_F(Fbx, shapes_nodes_and_bones_move_as_their_curves_say) {
    Square square;
    square.skinned = true;
    SequenceOptions options;
    options.rate = 10;
    const MeshSequence sequence = parse_gltf_sequence(converted(fbx(square)), no_file, options);
    ASSERT_EQ(sequence.times.size(), 21U);
    std::vector<Vec3f> p(4);
    for (std::size_t row = 0; row < sequence.times.size(); ++row) {
        sequence.positions(row, p);
        const double t = static_cast<double>(row) / 20, turned = t * std::numbers::pi / 2;
        EXPECT_LT(distance(to_double(p[0]), Vec3{3 * t, 0, 0}), 1e-6) << row;
        EXPECT_LT(distance(to_double(p[1]), Vec3{1 + 3 * t, 0, 0}), 1e-6) << row;
        EXPECT_LT(distance(to_double(p[2]), Vec3{std::cos(turned), 1 + std::sin(turned), 0.5 * t}), 1e-6) << row;
        EXPECT_LT(distance(to_double(p[3]), Vec3{0, 1, 0}), 1e-6) << row;
    }
}

TEST_F(Fbx, animations_are_told_by_what_they_move) {
    Square square;
    square.skinned = true;
    const std::vector<Animation> animations = parse_gltf_animations(converted(fbx(square)), no_file);
    ASSERT_EQ(animations.size(), 1U);
    EXPECT_EQ(animations[0].name, "talk");
    EXPECT_DOUBLE_EQ(animations[0].seconds, 2);
    EXPECT_THAT(animations[0].morphs, ElementsAre("lift"));
    EXPECT_THAT(animations[0].nodes, testing::UnorderedElementsAre("head", "bone"));
    EXPECT_THAT(animations[0].skins, ElementsAre("face"));
    square.animated = false;
    EXPECT_EQ(refusal([&] { parse_gltf_sequence(converted(fbx(square)), no_file); }),
              "expected an animation, found none");
}

TEST_F(Fbx, what_cannot_be_read_is_refused_with_its_place) {
    EXPECT_THAT(refusal([] { converted("Objects: { Vertices: *3 { a: 1,2"); }),
                HasSubstr("fbx: Assimp cannot read it: "));
    EXPECT_THAT(refusal([] { converted(""); }), HasSubstr("fbx: "));
    EXPECT_THAT(refusal([] { converted("no FBX at all"); }), HasSubstr("fbx: Assimp cannot read it: "));
    Square square;
    square.vertices = "0,0,0,1e39,0,0,100,100,0,0,100,0";
    EXPECT_THAT(refusal([&] { mesh_in(square); }), HasSubstr("expected finite positions"));
}

TEST_F(Fbx, files_that_are_cut_anywhere_are_refused_or_read_whole) {
    Square square;
    square.skinned = true;
    const std::string text = fbx(square);
    constexpr std::size_t step = 37;
    for (std::size_t size = 0; size < text.size(); size += step) {
        const auto result = hostile::attempt(convert_fbx, text.substr(0, size));
        EXPECT_TRUE(!result || hostile::keeps_promise(parse_gltf(*result, no_file))) << size;
    }
}

TEST_F(Fbx, indices_that_lead_nowhere_do_no_harm) {
    Square square;
    square.skinned = true;
    for (const char* corners : {"0,1,2,-99", "0,99,2,-4", "-1,-2,-3,-4", "0,1,2,2147483647"}) {
        square.corners = corners;
        const auto result = hostile::attempt(convert_fbx, fbx(square));
        EXPECT_TRUE(!result || hostile::keeps_promise(parse_gltf(*result, no_file))) << corners;
    }
    square.corners = Square{}.corners;
    square.clusters = "2,99";
    const auto result = hostile::attempt(convert_fbx, fbx(square));
    EXPECT_TRUE(!result || hostile::keeps_promise(parse_gltf(*result, no_file)));
}

TEST_F(Fbx, the_same_bytes_give_the_same_document) {
    Square square;
    square.skinned = true;
    EXPECT_EQ(converted(fbx(square)), converted(fbx(square)));
}

}  // namespace
}  // namespace mien
