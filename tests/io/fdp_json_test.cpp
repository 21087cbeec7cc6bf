// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/io/fdp_json.hpp"

#include <cmath>
#include <gmock/gmock.h>

#include "io/fdp_face.hpp"
#include "io/text.hpp"
#include "refusal.hpp"

namespace mien {
namespace {

using testing::HasSubstr;

Fdp parsed(std::string_view text) {
    return parse_fdp_json(as_bytes(text));
}

std::string refused(std::string_view text) {
    return refusal([&] { static_cast<void>(parsed(text)); });
}

TEST(FdpJson, KeepsEverythingExactly) {
    Fdp before = small_face();
    before.fat.tables[2].transforms[0].angle = 1.0 / 3;
    before.fat.nodes[0].name = "an \"eye\"\n";
    const Fdp after = parsed(format_fdp_json(before));
    EXPECT_TRUE(after.fat == before.fat);
    EXPECT_EQ(after.mesh.positions, before.mesh.positions);
    EXPECT_EQ(after.mesh.face_starts, before.mesh.face_starts);
    EXPECT_EQ(after.mesh.face_vertices, before.mesh.face_vertices);
    EXPECT_EQ(after.mesh.corner_uvs, before.mesh.corner_uvs);
    EXPECT_EQ(after.mesh.unit, "m");
    EXPECT_EQ(after.fapu.mns, before.fapu.mns);
    EXPECT_EQ(format_fdp_json(after), format_fdp_json(before));
    EXPECT_TRUE(std::signbit(after.fat.tables[1].meshes[0].displacements[3].x));
}

TEST(FdpJson, KeepsPartsAndPointsInTheOrderOfTheStandard) {
    const Fdp after = parsed(format_fdp_json(small_face()));
    ASSERT_EQ(after.mesh.parts.size(), 2U);
    EXPECT_EQ(after.mesh.parts[1].name, "left eye");
    EXPECT_EQ(after.mesh.parts[1].first_face, 2U);
    ASSERT_EQ(after.points.size(), 3U);
    EXPECT_EQ(after.points[2].id, "11.4");
    EXPECT_EQ(after.points[2].vertex, 2U);
}

TEST(FdpJson, NamesThePlaceOfWhatItRefuses) {
    EXPECT_THAT(refused("[]"), HasSubstr("object"));
    EXPECT_THAT(refused("{"), HasSubstr("fdp"));
    EXPECT_THAT(refused(R"({"face": 1})"), HasSubstr("/face: expected none but the keys"));
    EXPECT_THAT(refused(R"({"positions": [1, 2]})"), HasSubstr("/positions: expected a multiple of 3 numbers"));
    EXPECT_THAT(refused(R"({"positions": [1, 2, 1e39]})"), HasSubstr("/positions/2: expected a number that a float"));
    EXPECT_THAT(refused(R"({"positions": [1, 2, "3"]})"), HasSubstr("/positions/2"));
    EXPECT_THAT(refused(R"({"positions": [1, 2, 3], "faces": [[0, 0, 1]]})"),
                HasSubstr("/faces/0: expected vertices below 1"));
    EXPECT_THAT(refused(R"({"positions": [1, 2, 3], "faces": [[0, 0]]})"), HasSubstr("three corners"));
    EXPECT_THAT(refused(R"({"positions": [1, 2, 3], "faces": [[0, 0, -1]]})"), HasSubstr("/faces/0/2"));
    EXPECT_THAT(refused(R"({"uvs": [1, 2]})"), HasSubstr("/uvs: expected two numbers for each of 0 corners"));
    EXPECT_THAT(refused(R"({"units": {"ES0": -1}})"), HasSubstr("/units/ES0: expected a distance from 0"));
    EXPECT_THAT(refused(R"({"points": {"2.1": [1, 2]}})"), HasSubstr("/points/2.1: expected three numbers"));
    EXPECT_THAT(
        refused(
            R"({"tables": [{"fap": 3, "meshes": [{"borders": [0, 1], "vertices": [0], "displacements": [1, 2, 3]}]}]})"),
        HasSubstr("FAP 3: expected vertices below 0, found 0"));
    EXPECT_THAT(refused(R"({"tables": [{"meshes": []}]})"), HasSubstr("/tables/0: expected the key fap"));
    EXPECT_THAT(
        refused(R"({"parts": [{"name": "a", "mesh": 0, "primitive": 0, "vertices": [0, 1], "faces": [0, 0]}]})"),
        HasSubstr("/parts/0/vertices: expected the first and the number of some of 0"));
    EXPECT_THAT(refused(std::string(100000, '[')), HasSubstr("64"));
}

}  // namespace
}  // namespace mien
