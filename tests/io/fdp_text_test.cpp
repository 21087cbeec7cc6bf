// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/io/fdp_text.hpp"

#include <cmath>
#include <gmock/gmock.h>

#include "io/fdp_face.hpp"
#include "io/text.hpp"
#include "refusal.hpp"

namespace mien {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Fdp parsed(std::string_view text, const FdpTextOptions& options = {}) {
    return parse_fdp_text(as_bytes(text), options);
}

std::string refused(std::string_view text) {
    return refusal([&] { static_cast<void>(parsed(text)); });
}

// The form that is told of the standard, with a head of 52 vertices.
std::string example(const std::string& tables) {
    std::string points;
    for (int v = 0; v < 52; ++v) points += std::to_string(v) + " 0 0,";
    return "WorldInfo { info [\"FAPU MW0 1024\"] }\nFDP { faceSceneGraph [ Transform { children Shape { geometry DEF "
           "Head "
           "IndexedFaceSet { coord Coordinate { point [" +
           points + "] } coordIndex [0, 50, 51, -1] } } } ]\n faceDefTables [ " + tables + " ] }";
}

constexpr std::string_view told =
    "FaceDefTables { fapID 6 highLevelSelect 1 # a corner of the mouth\n faceDefMesh [ FaceDefMesh { "
    "faceSceneGraphNode "
    "USE Head intervalBorders [-1000 0 500 1000] coordIndex [50 51] displacements [1 0 0, 0.9 0 0, 1.5 0 4, 0.8 0 0, "
    "0.7 "
    "0 0, 2 0 0] } ] }";

TEST(FdpText, ReadsTheFormThatIsToldOfTheStandard) {
    const Fdp fdp = parsed(example(std::string(told)));
    ASSERT_EQ(fdp.fat.tables.size(), 1U);
    const FaceDefTables& table = fdp.fat.tables[0];
    EXPECT_EQ(table.fap, 6);
    EXPECT_EQ(table.high_level_select, 0);
    ASSERT_EQ(table.meshes.size(), 1U);
    EXPECT_THAT(table.meshes[0].borders, ElementsAre(-1000, 0, 500, 1000));
    EXPECT_THAT(table.meshes[0].vertices, ElementsAre(50, 51));
    EXPECT_THAT(table.meshes[0].displacements, ElementsAre(Vec3f{1, 0, 0}, Vec3f{0.9F, 0, 0}, Vec3f{1.5F, 0, 4},
                                                           Vec3f{0.8F, 0, 0}, Vec3f{0.7F, 0, 0}, Vec3f{2, 0, 0}));
    EXPECT_EQ(vertex_count(fdp.mesh), 52U);
    EXPECT_THAT(face(fdp.mesh, 0), ElementsAre(0, 50, 51));
    EXPECT_EQ(fdp.mesh.parts.at(0).name, "Head");
}

TEST(FdpText, MultipliesDisplacementsByTheUnitUnlessTold) {
    std::string text = example(std::string(told));
    text.replace(text.find("1024"), 4, "2048");
    EXPECT_EQ(parsed(text).fat.tables[0].meshes[0].displacements[2], (Vec3f{3, 0, 8}));
    EXPECT_EQ(parsed(text, {false, false}).fat.tables[0].meshes[0].displacements[2], (Vec3f{1.5F, 0, 4}));
}

TEST(FdpText, TurnsDisplacementsBelowZeroWhenTheyAreDownward) {
    const Fdp fdp = parsed(example(std::string(told)), {true, true});
    EXPECT_EQ(fdp.fat.tables[0].meshes[0].displacements[0], (Vec3f{-1, 0, 0}));
    EXPECT_EQ(fdp.fat.tables[0].meshes[0].displacements[1], (Vec3f{0.9F, 0, 0}));
    EXPECT_EQ(fdp.fat.tables[0].meshes[0].displacements[3], (Vec3f{-0.8F, 0, 0}));
}

TEST(FdpText, TakesItsUnitsFromTheFeaturePointsWhereNothingElseTellsThem) {
    std::string points;
    for (const StandardPoint& point : standard_points())
        points += point.id == "8.3"   ? "3072 0 0 "
                  : point.id == "8.4" ? "-1024 5 5 "
                  : point.id == "2.1" ? "1 -2 3 "
                                      : "+I +I +I ";
    std::string text = example(std::string(told));
    text.replace(text.find("FDP {"), 5, "FDP { featurePointsCoord Coordinate { point [" + points + "] }");
    text.replace(0, text.find('\n'), "");
    const Fdp fdp = parsed(text);
    EXPECT_EQ(fdp.fapu.mw, 4096);
    EXPECT_EQ(fdp.fapu.es, 0);
    EXPECT_EQ(fdp.fat.tables[0].meshes[0].displacements[0], (Vec3f{4, 0, 0}));
    ASSERT_EQ(fdp.points.size(), 3U);
    EXPECT_EQ(fdp.points[0].id, "2.1");
    EXPECT_EQ(fdp.points[0].position, (Vec3{1, -2, 3}));
}

TEST(FdpText, ReadsOverWhatItDoesNotKnow) {
    const Fdp fdp = parsed(
        "#VRML V2.0 utf8\nPROTO A [ field SFNode b NULL ] { Group { } }\nViewpoint { position 0 0 5 "
        "description \"a } \\\" b\" }\nROUTE a.b TO c.d\nGroup { children [ Face { fap FAP { viseme Viseme { } } fdp " +
        example(std::string(told)).substr(example(std::string(told)).find("FDP")) +
        " ttsSource NULL renderedFace [] } WorldInfo { info \"FAPU MW0 1024\" } ] }");
    EXPECT_EQ(fdp.fat.tables.size(), 1U);
}

TEST(FdpText, AppliesTheTransformsOfTheSceneGraph) {
    const Fdp fdp = parsed(
        "WorldInfo { info [\"FAPU MW0 1024\"] } FDP { faceSceneGraph Transform { translation 1 2 3 scale 2 2 2 "
        "children DEF Jaw "
        "Transform { center 1 0 0 rotation 0 0 1 1.5707963267948966 children Shape { geometry DEF Head IndexedFaceSet "
        "{ coord "
        "Coordinate { point [1 0 0, 2 0 0, 1 1 0] } coordIndex [0 1 2] } } } } faceDefTables [ FaceDefTables { fapID 6 "
        "faceDefMesh FaceDefMesh { faceSceneGraphNode USE Head intervalBorders [0 1] coordIndex [1] displacements [1 0 "
        "0] } "
        "faceDefTransform FaceDefTransform { faceSceneGraphNode USE Jaw translationDef 0 1 0 } } ] }");
    ASSERT_EQ(fdp.mesh.positions.size(), 3U);
    const auto near = [](Vec3f a, Vec3f b) { return distance(a, b) < 1e-5F; };
    EXPECT_TRUE(near(fdp.mesh.positions[0], {3, 2, 3}));
    EXPECT_TRUE(near(fdp.mesh.positions[1], {3, 4, 3}));
    EXPECT_TRUE(near(fdp.mesh.positions[2], {1, 2, 3}));
    EXPECT_TRUE(near(fdp.fat.tables[0].meshes[0].displacements[0], {0, 2, 0}));
    EXPECT_EQ(fdp.fat.nodes.at(0).centre, (Vec3{3, 2, 3}));
    EXPECT_EQ(fdp.fat.tables[0].transforms.at(0).translation, (Vec3{0, 2, 0}));
}

TEST(FdpText, KeepsTheTableExactlyOnItsWayThroughText) {
    const Fdp before = small_face();
    const Fdp after = parsed(format_fdp_text(before));
    EXPECT_TRUE(after.fat == before.fat);
    EXPECT_EQ(after.fat.tables[1].meshes[0].displacements, before.fat.tables[1].meshes[0].displacements);
    EXPECT_TRUE(std::signbit(after.fat.tables[1].meshes[0].displacements[3].x));
}

TEST(FdpText, KeepsTheModelThePointsAndTheUnits) {
    const Fdp before = small_face();
    const Fdp after = parsed(format_fdp_text(before));
    EXPECT_EQ(after.mesh.positions, before.mesh.positions);
    EXPECT_EQ(after.mesh.unit, "m");
    ASSERT_EQ(after.points.size(), before.points.size());
    for (std::size_t i = 0; i < after.points.size(); ++i) {
        EXPECT_EQ(after.points[i].id, before.points[i].id);
        EXPECT_EQ(after.points[i].vertex, before.points[i].vertex);
        EXPECT_EQ(after.points[i].position, before.points[i].position);
    }
    EXPECT_EQ(after.fapu.mns, before.fapu.mns);
    EXPECT_EQ(after.fapu.irisd, before.fapu.irisd);
    ASSERT_EQ(after.mesh.parts.size(), 2U);  // the eye, in its node, comes first
    EXPECT_EQ(after.mesh.parts[0].name, "left eye");
    EXPECT_EQ(after.mesh.parts[1].name, "skin");
    EXPECT_THAT(face(after.mesh, 0), ElementsAre(4, 5, 6));
    EXPECT_THAT(std::vector(after.mesh.corner_uvs.begin() + 3, after.mesh.corner_uvs.end()),
                testing::ElementsAreArray(before.mesh.corner_uvs.begin(), before.mesh.corner_uvs.begin() + 6));
}

TEST(FdpText, ComesBackAsTheSameBytesFromTheSecondTripOn) {
    const std::string once = format_fdp_text(parsed(format_fdp_text(small_face())));
    EXPECT_EQ(format_fdp_text(parsed(once)), once);
}

TEST(FdpText, ChangesNumbersOfTransformsByTheirLastDigitAtMostAndOnce) {
    Fdp before = small_face();
    std::vector<FaceDefTransform>& turns = before.fat.tables[2].transforms;
    for (int i = 1; i < 5000; ++i) {
        turns.push_back(turns.front());
        turns.back().angle = 1e-4 * std::abs(std::sin(i));
    }
    const Fdp once = parsed(format_fdp_text(before)), twice = parsed(format_fdp_text(once));
    for (std::size_t i = 0; i < turns.size(); ++i) {
        const double angle = once.fat.tables[2].transforms.at(i).angle;
        EXPECT_NEAR(angle, turns[i].angle, 3e-16 * angle);
        EXPECT_EQ(angle, twice.fat.tables[2].transforms.at(i).angle);
    }
}

// Of every size, and with a unit that no number of them is a multiple of.
TEST(FdpText, KeepsAnyDisplacementBitForBit) {
    Fdp before = small_face();
    FaceDefMesh& mesh = before.fat.tables[1].meshes[0];
    mesh.borders = {0};
    mesh.vertices = {3};
    mesh.displacements.clear();
    std::uint32_t bits = 1;
    for (int i = 0; i < 20000; ++i) {
        mesh.borders.push_back(i + 1);
        bits = 1664525 * bits + 1013904223;
        const float sign = bits >> 31U != 0 ? -1 : 1;
        const auto size =
            std::ldexp(1 + static_cast<float>(bits & 0x7fffffU) / 0x800000, static_cast<int>(bits >> 23U & 63U) - 40);
        mesh.displacements.push_back({sign * size, size, 1 / size});
    }
    EXPECT_EQ(parsed(format_fdp_text(before)).fat.tables[1].meshes[0].displacements, mesh.displacements);
}

TEST(FdpText, HoldsUnitsAloneOrPointsAlone) {
    Fdp units;
    units.fapu.mw = 0.05;
    EXPECT_EQ(parsed(format_fdp_text(units)).fapu.mw, 0.05);
    Fdp points;
    points.points = small_face().points;
    EXPECT_EQ(parsed(format_fdp_text(points)).points.size(), 3U);
}

TEST(FdpText, ReadsItsOwnNothing) {
    EXPECT_TRUE(parsed(format_fdp_text({})).points.empty());
    Fdp fdp;
    fdp.fapu.mns = 1;
    fdp.fat.tables = {{3, 0, {{{0, 1}, {}, {}}}, {}}};
    EXPECT_TRUE(parsed(format_fdp_text(fdp)).fat == fdp.fat);
}

TEST(FdpText, RefusesNodesThatNoTreeOfShapesCanHold) {
    const auto refused_with = [](std::vector<std::uint32_t> vertices) {
        Fdp fdp = small_face();
        fdp.fat.nodes[0].vertices = std::move(vertices);
        return refusal([&] { static_cast<void>(format_fdp_text(fdp)); });
    };
    EXPECT_THAT(refused_with({4, 5}), HasSubstr("face 2 partly in it"));
    EXPECT_THAT(refused_with({4, 5, 6, 7}), HasSubstr("expected the vertices of its faces"));
    Fdp fdp = small_face();
    fdp.fat.nodes[1].vertices = {0, 1, 2, 3};
    EXPECT_EQ(refusal([&] { static_cast<void>(format_fdp_text(fdp)); }), "");
}

TEST(FdpText, RefusesToWriteATableWithoutItsUnit) {
    Fdp fdp = small_face();
    fdp.fapu.mns = 0;
    EXPECT_THAT(refusal([&] { static_cast<void>(format_fdp_text(fdp)); }), HasSubstr("FAP 3 (open_jaw)"));
}

TEST(FdpText, NamesTheLineOfWhatItRefuses) {
    EXPECT_THAT(refused("FDP {\n"), HasSubstr("line 2: expected a field or }, found the end of the file"));
    EXPECT_THAT(refused("FDP { a [ 1 2\n\n"), HasSubstr("line 3: expected the brackets to close"));
    EXPECT_THAT(refused("FDP { }\n}"), HasSubstr("line 2: expected a bracket that is open, found } too many"));
    EXPECT_THAT(refused("FDP { a \"b\n"), HasSubstr("line 1: expected the quote to close"));
    EXPECT_THAT(refused("FDP { a { [ } ] }"), HasSubstr("expected the other bracket, found }"));
    EXPECT_THAT(refused("DEF a FDP { } DEF a FDP { }"), HasSubstr("DEF 'a' again"));
    EXPECT_THAT(refused("Group { }"), HasSubstr("expected an FDP node"));
    EXPECT_THAT(refused(""), HasSubstr("expected an FDP node"));
    EXPECT_THAT(refused("WorldInfo { info \"FAPU EYES 3\" }"), HasSubstr("found 'EYES' '3'"));
    EXPECT_THAT(refused("FDP { featurePointsCoord Coordinate { point [1 2 3] } }"),
                HasSubstr("84 feature points, found 1"));
    EXPECT_THAT(refused("FDP { faceSceneGraph USE nobody }"), HasSubstr("called 'nobody', found none"));
}

TEST(FdpText, RefusesBracketsThatLieTooDeep) {
    std::string open = "FDP { ";
    for (int i = 0; i < 100000; ++i) open += "a [ ";
    EXPECT_THAT(refused(open), HasSubstr("64 deep"));
    std::string nodes;
    for (int i = 0; i < 100000; ++i) nodes += "a { b ";
    EXPECT_THAT(refused(nodes), HasSubstr("64 deep"));
}

TEST(FdpText, RefusesSceneGraphsThatAreNoTree) {
    EXPECT_THAT(refused("FDP { faceSceneGraph DEF A Group { children USE A } }"), HasSubstr("once, found 'A' again"));
    std::string chain = "FDP { faceSceneGraph USE A0 } ";
    for (int i = 0; i < 1000; ++i)
        chain += "DEF A" + std::to_string(i) + " Group { children USE A" + std::to_string(i + 1) + " } ";
    EXPECT_THAT(refused(chain), HasSubstr("64 deep"));
}

std::string changed(std::string_view from, std::string_view to) {
    std::string text = example(std::string(told));
    text.replace(text.find(from), from.size(), to);
    return refused(text);
}

TEST(FdpText, RefusesTablesThatDoNotFitTheModel) {
    EXPECT_THAT(changed("[50 51]", "[50 52]"), HasSubstr("line 4: expected vertices below 52 in coordIndex, found 52"));
    EXPECT_THAT(changed("[50 51]", "[50 50]"), HasSubstr("ascend"));
    EXPECT_THAT(changed("[50 51]", "[50 x]"), HasSubstr("expected numbers for coordIndex, found 'x'"));
    EXPECT_THAT(changed("[50 51]", "[50 1.5]"), HasSubstr("whole numbers"));
    EXPECT_THAT(changed("[50 51]", "[50]"),
                HasSubstr("expected 3 displacements for 1 vertices and 4 borders, found 6"));
    EXPECT_THAT(changed("-1000 0", "-1000 1"), HasSubstr("through 0"));
    EXPECT_THAT(changed("[-1000 0 500 1000]", "[]"), HasSubstr("two intervalBorders or more, found 0"));
    EXPECT_THAT(changed("2 0 0]", "2 0 1e39]"), HasSubstr("finite"));
    EXPECT_THAT(changed("2 0 0]", "2 0]"), HasSubstr("a multiple of 3 numbers for displacements, found 17"));
    EXPECT_THAT(changed("USE Head", "USE Hand"), HasSubstr("called 'Hand', found none"));
    EXPECT_THAT(changed("fapID 6", "fapID 69"), HasSubstr("fapID from 1 to 68, found 69"));
    EXPECT_THAT(changed("fapID 6", "fapID 31"), HasSubstr("the unit of FAP 31 (raise_l_i_eyebrow)"));
    EXPECT_THAT(changed("51, -1]", "52, -1]"), HasSubstr("expected a vertex below 52, found 52"));
    EXPECT_THAT(changed("51 0 0", "51 0 +inf"), HasSubstr("points that are finite"));
}

}  // namespace
}  // namespace mien
