// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/io/obj.hpp"

#include <gtest/gtest.h>

#include "io/hostile.hpp"
#include "io/text.hpp"

namespace mien {
namespace {

using testing::HasSubstr;

Mesh parse(std::string_view text) {
    return parse_obj(hostile::Copy(text).bytes());
}

std::string refusal(std::string_view text) {
    return hostile::refusal(parse_obj, text);
}

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(Obj, refuses_what_breaks_its_promise_and_names_the_line) {
    EXPECT_THAT(refusal(square + "f 1 2 5\n"), HasSubstr("obj line 5: expected a vertex index from 1 to 4, found 5"));
    EXPECT_THAT(refusal(square + "f 0 1 2\n"),
                HasSubstr("obj line 5: expected a vertex index from 1, or back from -1 to -4, found '0'"));
    EXPECT_THAT(refusal(square + "f -5 1 2\n"), HasSubstr("found '-5'"));
    EXPECT_THAT(refusal(square + "f 1 2 99999999999999999999\n"), HasSubstr("obj line 5"));
    EXPECT_THAT(refusal(square + "f 1/1 2/1 3/1\n"), HasSubstr("texture coordinate index"));
    EXPECT_THAT(refusal(square + "f 1//2 2//1 3//1\nvn 0 0 1\n"), HasSubstr("normal index"));
    EXPECT_THAT(refusal(square + "f 1.5 2 3\n"), HasSubstr("found '1.5'"));
    EXPECT_THAT(refusal("v 0 nan 0\n"), HasSubstr("obj line 1: expected a finite y of a vertex, found 'nan'"));
    EXPECT_THAT(refusal("v 0 0 1e39\n"), HasSubstr("finite z"));
    EXPECT_THAT(refusal("v 1,5 0 0\n"), HasSubstr("found '1,5'"));
    EXPECT_THAT(refusal("v 0 0\n"), HasSubstr("found nothing"));
    EXPECT_THAT(refusal("vt inf 0\n"), HasSubstr("finite u"));
    EXPECT_THAT(refusal(square), HasSubstr("expected faces, found none"));
    EXPECT_THAT(refusal(""), HasSubstr("expected faces"));
    EXPECT_THAT(refusal(std::string("v 0 0 0\0", 8)), HasSubstr("obj byte 7"));
}

TEST(Obj, keeps_quads_and_larger_polygons) {
    const Mesh mesh = parse(square + "v .5 2 0\nf 1 2 3 4\nf 1 2 3 5 4\nf 1 2 3\n");
    EXPECT_EQ(mesh.positions[2], (Vec3f{1, 1, 0}));
    EXPECT_EQ(mesh.face_starts, (std::vector<std::uint32_t>{0, 4, 9, 12}));
    EXPECT_EQ(mesh.face_vertices[7], 4U);
    EXPECT_TRUE(mesh.corner_uvs.empty());
}

TEST(Obj, every_slash_form_and_negative_indices_name_the_same_corners) {
    const std::string lists = square + "vt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\n";
    for (const char* face :
         {"f 1 2 3", "f 1/1 2/2 3/3", "f 1//1 2//1 3//1", "f 1/1/1 2/2/1 3/3/1", "f -4 -3 -2",
          "f -4/-3/-1 -3/-2/-1 -2/-1/-1", "f 1 2/2 3//1", "f 1 \\\n 2 \\\r\n3", "\tf  1 2\t3 # a triangle"})
        EXPECT_EQ(parse(lists + face + "\n").face_vertices, (std::vector<std::uint32_t>{0, 1, 2})) << face;
}

TEST(Obj, faces_may_name_vertices_that_come_later) {
    EXPECT_EQ(parse("f 1 2 3\n" + square).face_vertices, (std::vector<std::uint32_t>{0, 1, 2}));
}

TEST(Obj, texture_v_runs_down_as_in_gltf_and_missing_ones_are_zero) {
    const Mesh mesh = parse(square + "vt 0.25 0.75\nf 1/1 2 3/1\n");
    EXPECT_EQ(mesh.corner_uvs, (std::vector<Vec2f>{{0.25F, 0.25F}, {0, 0}, {0.25F, 0.25F}}));
}

TEST(Obj, runs_of_one_name_are_parts_and_their_vertices_reach_from_lowest_to_highest) {
    const Mesh mesh =
        parse(square + "o head\nf 2 3 4\ng teeth\nf 1 2 3\nf 1 2 4\ng empty\ng head\nusemtl x\nf 1 3 4\n");
    ASSERT_EQ(mesh.parts.size(), 3U);
    EXPECT_EQ(mesh.parts[0].name, "head");
    EXPECT_EQ(mesh.parts[0].first_vertex, 1U);
    EXPECT_EQ(mesh.parts[0].vertex_count, 3U);
    EXPECT_EQ(mesh.parts[1].first_face, 1U);
    EXPECT_EQ(mesh.parts[1].face_count, 2U);
    EXPECT_EQ(mesh.parts[1].mesh, 1U);
    EXPECT_EQ(mesh.parts[2].name, "head");
    EXPECT_EQ(mesh.parts[2].mesh, 0U);
    EXPECT_EQ(mesh.parts[2].primitive, 1U);
}

TEST(Obj, a_name_without_faces_does_not_split_a_part) {
    const Mesh mesh = parse(square + "g a\nf 1 2 3\ng b\ng a\nf 2 3 4\n");
    ASSERT_EQ(mesh.parts.size(), 1U);
    EXPECT_EQ(mesh.parts[0].face_count, 2U);
}

TEST(Obj, passes_over_what_has_no_surface) {
    const Mesh mesh = parse(square + "mtllib ../../etc/passwd\ns off\nl 1 2\np 1\nf 1 2\nf\nf 1 2 3\ncstype bezier\n");
    EXPECT_EQ(face_count(mesh), 1U);
    EXPECT_EQ(face_count(parse("o Object\nf\n")), 0U);
    EXPECT_EQ(parse("v 0 0 0 1\nv 1 0 0 0.5 0.5 0.5\nv 0 1 0\nf 1 2 3\n").positions[1], (Vec3f{1, 0, 0}));
}

TEST(Obj, tiny_numbers_and_crlf_read) {
    EXPECT_EQ(parse("v 1e-320 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3\r\n").positions[0].x, 0);
}

TEST(Obj, one_line_of_sixty_thousand_corners_is_one_face) {
    std::string text = square + "f";
    for (int i = 0; i < 60000; ++i) text += " 1";
    EXPECT_EQ(face(parse(text), 0).size(), 60000U);
}

TEST(Obj, survives_every_prefix_and_every_changed_byte) {
    const std::string text = square + "vt 0 .5\nvn 0 0 1\ng a\nf 1/1/1 2/1 3//1 \\\n 4\no b\nf -4 -3 -2\n";
    ASSERT_TRUE(hostile::keeps_promise(parse(text)));
    hostile::sweep(parse_obj, text, [](const Mesh& mesh) { return hostile::keeps_promise(mesh); });
}

}  // namespace
}  // namespace mien
