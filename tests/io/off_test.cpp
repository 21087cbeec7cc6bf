// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/io/off.hpp"

#include <gtest/gtest.h>

#include "io/hostile.hpp"

namespace mien {
namespace {

using testing::HasSubstr;

std::string refusal(std::string_view text) {
    return hostile::refusal(parse_off, text);
}

const std::string tetrahedron =
    "OFF\n# four corners\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";

TEST(Off, refuses_what_breaks_its_promise_and_names_the_line) {
    EXPECT_THAT(refusal(""), HasSubstr("found the end of the file"));
    EXPECT_THAT(refusal("4OFF\n"), HasSubstr("off line 1: expected OFF"));
    EXPECT_THAT(refusal("OFF BINARY\n"), HasSubstr("text form"));
    EXPECT_THAT(refusal("OFF\n3 1\n"), HasSubstr("number of edges, found nothing"));
    EXPECT_THAT(refusal("OFF\n-3 1 0\n"), HasSubstr("found '-3'"));
    EXPECT_THAT(refusal("OFF\n1000000000 1000000000 0\n0 0 0\n"), HasSubstr("vertex 2 of 1000000000"));
    EXPECT_THAT(refusal("OFF\n1 0 0\n0 0 0\n"), HasSubstr("expected faces"));
    EXPECT_THAT(refusal("OFF\n1 1 0\n0 inf 0\n"), HasSubstr("off line 3: expected a finite coordinate, found 'inf'"));
    EXPECT_THAT(refusal("OFF\n1 1 0\n0 0 0\n3 0 0 1\n"),
                HasSubstr("expected a vertex index from 0, below 1, found '1'"));
    EXPECT_THAT(refusal("OFF\n1 1 0\n0 0 0\n4 0 0 0\n"), HasSubstr("found nothing"));
    EXPECT_THAT(refusal("OFF\n1 1 0\n0 0 0\n1000000000 0 0 0\n"), HasSubstr("found nothing"));
    EXPECT_THAT(refusal(tetrahedron + "3 0 1 2\n"), HasSubstr("expected the end of the file"));
}

TEST(Off, reads_vertices_and_polygons) {
    const Mesh mesh = parse_off(hostile::Copy(tetrahedron).bytes());
    EXPECT_EQ(mesh.positions[3], (Vec3f{0, 0, 1}));
    EXPECT_EQ(face_count(mesh), 4U);
    EXPECT_EQ(face(mesh, 3)[0], 2U);
    EXPECT_TRUE(mesh.parts.empty());
}

TEST(Off, passes_over_colours_normals_texture_and_small_faces) {
    for (const char* keyword : {"COFF", "NOFF", "STOFF", "CNOFF", "STCNOFF", "OFF 3 3 0 #"}) {
        const std::string counts = std::string_view(keyword).starts_with("OFF") ? "" : "3 3 0\n";
        const std::string text = std::string(keyword) + "\r\n" + counts +
                                 "0 0 0 255 0 0\r\n1 0 0 1 1 1\n\n0 1 0 0 0 0\n3 0 1 2 0.5 0.5 0.5\n2 0 1\n1 0\n";
        const Mesh mesh = parse_off(hostile::Copy(text).bytes());
        EXPECT_EQ(mesh.face_vertices, (std::vector<std::uint32_t>{0, 1, 2})) << keyword;
    }
}

TEST(Off, survives_every_prefix_and_every_changed_byte) {
    hostile::sweep(parse_off, tetrahedron, [](const Mesh& mesh) { return hostile::keeps_promise(mesh); });
}

}  // namespace
}  // namespace mien
