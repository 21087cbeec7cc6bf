// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/io/gltf.hpp"

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <iterator>
#include <limits>

#include "io/gltf_text.hpp"
#include "io/hostile.hpp"

namespace mien {
namespace {

using namespace gltf_text;
using testing::ElementsAre;
using testing::HasSubstr;

std::string refusal(const GltfDocument& document) {
    return hostile::refusal(parse, glb_text(document));
}

std::vector<std::uint32_t> corners(const Mesh& mesh) {
    return mesh.face_vertices;
}

void expect_near(const Vec3f& found, const Vec3f& expected) {
    EXPECT_NEAR(found.x, expected.x, 1e-6);
    EXPECT_NEAR(found.y, expected.y, 1e-6);
    EXPECT_NEAR(found.z, expected.z, 1e-6);
}

json turn_about_z() {
    return json::array({0, 0, std::sqrt(0.5), std::sqrt(0.5)});  // a right angle: x becomes y
}

// A square with indices, texture coordinates, a target, a skin and two nodes.
GltfDocument everything() {
    GltfDocument document = square({0, 1, 2, 2, 1, 3});
    json& root = document.json;
    const std::size_t uv = add_accessor(document, std::vector<float>{0, 0, 1, 0, 0, 1, 1, 1}, "VEC2", 5126, 2);
    const std::size_t delta = add_vec3(document, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2});
    const std::vector<std::uint8_t> joints(16);
    const std::size_t joint = add_accessor(document, joints, "VEC4", 5121, 4);
    const std::vector<float> weights{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
    const std::size_t weight = add_accessor(document, weights, "VEC4", 5126, 4);
    json& primitive = root["meshes"][0]["primitives"][0];
    primitive["attributes"].update(json{{"TEXCOORD_0", uv}, {"JOINTS_0", joint}, {"WEIGHTS_0", weight}});
    primitive["targets"] = json::array({{{"POSITION", delta}}});
    root["skins"] = json::array({{{"joints", {1}}}});
    add_node(document, {{"mesh", 0}, {"skin", 0}, {"children", {1}}});
    add_node(document, {{"translation", {0, 0, 1}}});
    root["scenes"] = json::array({{{"nodes", {0}}}});
    return document;
}

TEST(ParseGltf, RefusesOrKeepsItsPromiseHoweverAFileIsDamaged) {
    hostile::sweep(parse, glb_text(everything()), [](const Mesh& mesh) { return hostile::keeps_promise(mesh); });
}

TEST(ParseGltf, NamesTheIndexThatIsOutOfRange) {
    EXPECT_THAT(refusal(square({0, 1, 4})), HasSubstr("/meshes/0/primitives/0/indices: expected indices below 4"));
}

TEST(ParseGltf, RefusesNumbersThatAreNotFinite) {
    for (const float bad : {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
        GltfDocument document = empty();
        add_mesh(document, {0, 0, 0, 1, bad, 0, 0, 1, 0});
        EXPECT_THAT(refusal(document), HasSubstr("/accessors/0: expected finite numbers"));
    }
}

TEST(ParseGltf, RefusesMoreElementsThanTheViewHasBytesFor) {
    for (const std::uint64_t count : {std::uint64_t{4}, std::uint64_t{1} << 40, std::uint64_t{1} << 62}) {
        GltfDocument document = triangle();
        document.json["accessors"][0]["count"] = count;
        EXPECT_THAT(refusal(document), HasSubstr("/accessors/0")) << count;
    }
}

TEST(ParseGltf, RefusesCountsThatNoBytesStandBehind) {
    GltfDocument document = triangle();
    document.json["accessors"][0].erase("bufferView");
    document.json["accessors"][0]["count"] = 1 << 30;
    EXPECT_THAT(refusal(document), HasSubstr("/accessors/0/count: expected at most 16777216"));
}

TEST(ParseGltf, RefusesManyPrimitivesThatShareOneLargeAccessor) {
    GltfDocument document = triangle();
    document.json["accessors"][0].erase("bufferView");
    document.json["accessors"][0]["count"] = 1 << 24;
    json& primitives = document.json["meshes"][0]["primitives"];
    primitives[0]["mode"] = 0;
    for (int i = 0; i < 2; ++i) primitives.push_back(primitives[0]);
    EXPECT_THAT(refusal(document), HasSubstr("/meshes/0/primitives/0: expected at most 262"));
}

TEST(ParseGltf, RefusesStridesShorterThanAnElement) {
    GltfDocument document = triangle();
    document.json["bufferViews"][0]["byteStride"] = 8;
    EXPECT_THAT(refusal(document), HasSubstr("/bufferViews/0/byteStride: expected at least 12"));
}

TEST(ParseGltf, RefusesAttributesOfDifferentCounts) {
    GltfDocument document = triangle();
    document.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = add_vec3(document, {0, 0, 1});
    EXPECT_THAT(refusal(document), HasSubstr("expected 3 elements in every attribute"));
}

TEST(ParseGltf, RefusesCyclesAndSecondParents) {
    GltfDocument document = triangle();
    document.json["nodes"] = json::array({{{"children", {1}}}, {{"children", {0}}}});
    EXPECT_THAT(refusal(document), HasSubstr("/nodes/0: expected a node that a root leads to, found a cycle"));
    document.json["nodes"] = json::array({{{"children", {2}}}, {{"children", {2}}}, json::object()});
    EXPECT_THAT(refusal(document), HasSubstr("/nodes/1/children/0: expected a node without another parent"));
}

TEST(ParseGltf, RefusesTransformsThatRunOver) {
    GltfDocument document = triangle();
    for (int i = 0; i < 9; ++i) add_node(document, {{"scale", {1e38, 1e38, 1e38}}, {"children", {i + 1}}});
    add_node(document, {{"mesh", 0}});
    EXPECT_THAT(refusal(document), HasSubstr("/nodes/8: expected a finite transform"));
}

TEST(ParseGltf, FollowsAChainOfNodesAsLongAsTheFile) {
    GltfDocument document = triangle();
    constexpr int length = 20000;
    for (int i = 0; i < length; ++i) add_node(document, {{"translation", {1, 0, 0}}, {"children", {i + 1}}});
    add_node(document, {{"mesh", 0}});
    EXPECT_EQ(read(document).positions[0], (Vec3f{length, 0, 0}));
}

TEST(ParseGltf, ReadsAFileWithoutMeshesAsAnEmptyMesh) {
    const Mesh mesh = read(empty());
    EXPECT_EQ(vertex_count(mesh), 0U);
    EXPECT_EQ(face_count(mesh), 0U);
}

TEST(ParseGltf, ReadsVerticesWithoutIndicesInTheirOrder) {
    const Mesh mesh = read(triangle());
    EXPECT_THAT(mesh.positions, ElementsAre(Vec3f{0, 0, 0}, Vec3f{1, 0, 0}, Vec3f{0, 1, 0}));
    EXPECT_THAT(corners(mesh), ElementsAre(0, 1, 2));
    EXPECT_EQ(mesh.unit, "m");
    EXPECT_TRUE(mesh.corner_uvs.empty());
}

TEST(ParseGltf, WindsEveryTriangleOfAStripAlike) {
    EXPECT_THAT(corners(read(square({0, 1, 2, 3}, 5))), ElementsAre(0, 1, 2, 1, 3, 2));
}

TEST(ParseGltf, SpreadsAFanFromItsFirstVertex) {
    EXPECT_THAT(corners(read(square({0, 1, 3, 2}, 6))), ElementsAre(0, 1, 3, 0, 3, 2));
}

TEST(ParseGltf, KeepsPointsAndLinesAsPartsWithoutFaces) {
    const Mesh mesh = read(square({0, 1, 2, 3}, 1));
    ASSERT_EQ(mesh.parts.size(), 1U);
    EXPECT_EQ(mesh.parts[0].vertex_count, 4U);
    EXPECT_EQ(mesh.parts[0].face_count, 0U);
}

TEST(ParseGltf, KeepsFacesThatRepeatACorner) {
    EXPECT_THAT(corners(read(square({0, 0, 1, 0, 1, 2}))), ElementsAre(0, 0, 1, 0, 1, 2));
}

TEST(ParseGltf, ReadsInterleavedNumbers) {
    GltfDocument document = empty();
    add_mesh(document, {9, 9, 0, 0, 0, 9, 1, 0, 0, 9, 0, 1, 0});
    document.json["bufferViews"][0]["byteStride"] = 16;
    document.json["accessors"][0]["byteOffset"] = 8;
    document.json["accessors"][0]["count"] = 3;
    EXPECT_THAT(read(document).positions, ElementsAre(Vec3f{0, 0, 0}, Vec3f{1, 0, 0}, Vec3f{0, 1, 0}));
}

TEST(ParseGltf, ReadsSparseNumbersOverAViewAndOverZeros) {
    for (const bool over_view : {true, false}) {
        GltfDocument document = triangle();
        const std::size_t indices = add_view(document, std::vector<std::uint8_t>{1});
        const std::size_t values = add_view(document, std::vector<float>{7, 8, 9});
        json& accessor = document.json["accessors"][0];
        accessor["sparse"] = {{"count", 1},
                              {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                              {"values", {{"bufferView", values}}}};
        if (!over_view) accessor.erase("bufferView");
        EXPECT_THAT(read(document).positions,
                    ElementsAre(Vec3f{0, 0, 0}, Vec3f{7, 8, 9}, over_view ? Vec3f{0, 1, 0} : Vec3f{}));
    }
}

TEST(ParseGltf, RefusesSparseIndicesOutOfRangeOrOrder) {
    for (const auto& bad : {std::vector<std::uint8_t>{0, 3}, std::vector<std::uint8_t>{1, 1}}) {
        GltfDocument document = triangle();
        const std::size_t indices = add_view(document, bad);
        const std::size_t values = add_view(document, std::vector<float>(6));
        document.json["accessors"][0]["sparse"] = {{"count", 2},
                                                   {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                                                   {"values", {{"bufferView", values}}}};
        EXPECT_THAT(refusal(document), HasSubstr("/accessors/0/sparse/indices: expected"));
    }
}

TEST(ParseGltf, ReadsNormalizedAndQuantizedPositions) {
    GltfDocument document = empty();
    document.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    add_mesh(document, {0, 0, 0});
    const std::vector<std::int8_t> numbers{127, -128, 0, 0, -127, 1, 0, 0};  // padded to four bytes
    const std::size_t accessor = add_accessor(document, numbers, "VEC3", 5120, 4);
    document.json["bufferViews"][1]["byteStride"] = 4;
    document.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = accessor;
    EXPECT_EQ(read(document).positions[0], (Vec3f{127, -128, 0}));
    document.json["accessors"][accessor]["normalized"] = true;
    EXPECT_EQ(read(document).positions[0], (Vec3f{1, -1, 0}));
    EXPECT_EQ(read(document).positions[1], (Vec3f{-1, 1.F / 127, 0}));
}

TEST(ParseGltf, PlacesAMeshByTranslationRotationAndScaleOfAllItsParents) {
    GltfDocument document = triangle();
    add_node(document, {{"translation", {10, 0, 0}}, {"rotation", turn_about_z()}, {"children", {1}}});
    add_node(document, {{"scale", {2, 3, 4}}, {"mesh", 0}});
    const Mesh mesh = read(document);
    expect_near(mesh.positions[0], {10, 0, 0});
    expect_near(mesh.positions[1], {10, 2, 0});
    expect_near(mesh.positions[2], {7, 0, 0});
}

TEST(ParseGltf, PlacesAMeshByAMatrixColumnByColumn) {
    GltfDocument document = triangle();
    add_node(document, {{"matrix", {0, 1, 0, 0, -3, 0, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1}}, {"mesh", 0}});
    EXPECT_THAT(read(document).positions, ElementsAre(Vec3f{5, 6, 7}, Vec3f{5, 7, 7}, Vec3f{2, 6, 7}));
}

TEST(ParseGltf, TurnsTheWindingWhereANodeMirrors) {
    GltfDocument document = triangle();
    add_node(document, {{"scale", {-1, 1, 1}}, {"mesh", 0}});
    EXPECT_THAT(corners(read(document)), ElementsAre(0, 2, 1));
}

TEST(ParseGltf, PlacesAMeshByTheFirstNodeOfTheSceneShown) {
    GltfDocument document = triangle();
    for (const int x : {1, 2, 3}) add_node(document, {{"translation", {x, 0, 0}}, {"mesh", 0}});
    document.json["scenes"] = json::array({{{"nodes", {0}}}, {{"nodes", {2, 1}}}, json::object()});
    document.json["scene"] = 1;
    EXPECT_EQ(read(document).positions[0].x, 3);
    document.json["scene"] = 2;
    EXPECT_EQ(read(document).positions[0].x, 0);
}

TEST(ParseGltf, NumbersPartsByMeshAndPrimitive) {
    GltfDocument document = triangle();
    add_mesh(document, {0, 0, 1, 1, 0, 1, 0, 1, 1});
    json& meshes = document.json["meshes"];
    meshes[0]["name"] = "head";
    meshes[0]["primitives"].push_back(meshes[1]["primitives"][0]);
    add_node(document, {{"mesh", 1}, {"name", "eye"}});
    const Mesh mesh = read(document);
    ASSERT_EQ(mesh.parts.size(), 3U);
    EXPECT_EQ(mesh.parts[1].name, "head");
    EXPECT_EQ(mesh.parts[1].primitive, 1U);
    EXPECT_EQ(mesh.parts[2].name, "eye");
    EXPECT_EQ(mesh.parts[2].mesh, 1U);
    EXPECT_EQ(mesh.parts[2].first_vertex, 6U);
    EXPECT_THAT(corners(mesh), ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 8));
}

TEST(ParseGltf, GivesCornersOfAPrimitiveWithoutTextureCoordinatesZeros) {
    GltfDocument document = triangle();
    add_mesh(document, {0, 0, 1, 1, 0, 1, 0, 1, 1});
    const std::vector<std::uint8_t> uvs{255, 0, 0, 255, 0, 0};
    const std::size_t uv = add_accessor(document, uvs, "VEC2", 5121, 2);
    document.json["accessors"][uv]["normalized"] = true;
    document.json["meshes"][1]["primitives"][0]["attributes"]["TEXCOORD_0"] = uv;
    EXPECT_THAT(read(document).corner_uvs,
                ElementsAre(Vec2f{}, Vec2f{}, Vec2f{}, Vec2f{1, 0}, Vec2f{0, 1}, Vec2f{0, 0}));
}

TEST(ParseGltf, ReadsMorphTargetsThroughTheLinearPartOfTheirNode) {
    GltfDocument document = triangle();
    const std::size_t delta = add_vec3(document, {0, 0, 0, 0, 0, 0, 1, 0, 5});
    json& mesh = document.json["meshes"][0];
    mesh["primitives"][0]["targets"] = json::array({{{"POSITION", delta}}, {{"POSITION", delta}}});
    mesh["extras"]["targetNames"] = {"smile"};
    add_node(document, {{"translation", {9, 9, 9}}, {"scale", {2, 1, 1}}, {"mesh", 0}});
    const Mesh read_back = read(document);
    ASSERT_EQ(read_back.morph_targets.size(), 2U);
    EXPECT_EQ(read_back.morph_targets[0].name, "smile");
    EXPECT_EQ(read_back.morph_targets[1].name, "morph_2");
    EXPECT_THAT(read_back.morph_targets[0].vertices, ElementsAre(2));
    EXPECT_THAT(read_back.morph_targets[0].deltas, ElementsAre(Vec3f{2, 0, 5}));
}

TEST(ParseGltf, MergesTargetsOfOneNameAcrossMeshes) {
    GltfDocument document = triangle();
    add_mesh(document, {0, 0, 1, 1, 0, 1, 0, 1, 1});
    const std::size_t delta = add_vec3(document, {0, 0, 0, 0, 1, 0, 0, 0, 0});
    for (json& mesh : document.json["meshes"]) {
        mesh["primitives"][0]["targets"] = json::array({{{"POSITION", delta}}});
        mesh["extras"]["targetNames"] = {"jawOpen"};
    }
    const Mesh mesh = read(document);
    ASSERT_EQ(mesh.morph_targets.size(), 1U);
    EXPECT_THAT(mesh.morph_targets[0].vertices, ElementsAre(1, 4));
}

TEST(ParseGltf, KeepsTargetsOfOneNameInOneMeshApart) {
    GltfDocument document = triangle();
    const std::size_t delta = add_vec3(document, {0, 0, 0, 0, 1, 0, 0, 0, 0});
    json& mesh = document.json["meshes"][0];
    mesh["primitives"][0]["targets"] = json::array({{{"POSITION", delta}}, {{"POSITION", delta}}});
    mesh["extras"]["targetNames"] = {"a", "a"};
    const Mesh read_back = read(document);
    ASSERT_EQ(read_back.morph_targets.size(), 2U);
    EXPECT_NE(read_back.morph_targets[0].name, read_back.morph_targets[1].name);
}

TEST(ParseGltf, KeepsTargetsApartWhateverOthersAreCalled) {
    GltfDocument document = triangle();
    const std::size_t delta = add_vec3(document, {0, 0, 0, 0, 1, 0, 0, 0, 0});
    json& mesh = document.json["meshes"][0];
    const json target{{"POSITION", delta}};
    mesh["primitives"][0]["targets"] = json::array({target, target, target});
    mesh["extras"]["targetNames"] = {"a_3", "a", "a"};
    const Mesh read_back = read(document);
    ASSERT_EQ(read_back.morph_targets.size(), 3U);
    for (const MorphTarget& each : read_back.morph_targets) EXPECT_THAT(each.vertices, ElementsAre(1)) << each.name;
}

TEST(ParseGltf, TakesNamesOfTargetsFromAPrimitiveWhereTheMeshHasNone) {
    GltfDocument document = triangle();
    const std::size_t delta = add_vec3(document, {0, 0, 0, 0, 1, 0, 0, 0, 0});
    json& mesh = document.json["meshes"][0];
    mesh["primitives"][0]["targets"] = json::array({{{"POSITION", delta}}});
    mesh["primitives"][0]["extras"]["targetNames"] = {"smile"};
    EXPECT_EQ(read(document).morph_targets.at(0).name, "smile");
    mesh["extras"]["targetNames"] = {"frown"};
    EXPECT_EQ(read(document).morph_targets.at(0).name, "frown");
}

TEST(ParseGltf, RefusesPrimitivesOfDifferentNumbersOfTargets) {
    GltfDocument document = triangle();
    json& primitives = document.json["meshes"][0]["primitives"];
    primitives.push_back(primitives[0]);
    primitives[1]["targets"] = json::array({json::object()});
    EXPECT_THAT(refusal(document), HasSubstr("/meshes/0/primitives/1/targets: expected 0"));
}

TEST(ParseGltf, ReadsASkinInItsRestPoseWhereItsNodeHasNoSay) {
    GltfDocument document = everything();
    document.json["nodes"][0]["translation"] = {100, 0, 0};
    document.json["nodes"][1] = {{"translation", {0, 0, 1}}, {"rotation", turn_about_z()}};
    document.json["nodes"][0].erase("children");
    std::vector<float> inverse{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -5, 1};
    document.json["skins"][0]["inverseBindMatrices"] = add_accessor(document, inverse, "MAT4", 5126, 16);
    const Mesh mesh = read(document);
    expect_near(mesh.positions[0], {0, 0, -4});
    expect_near(mesh.positions[1], {0, 1, -4});
    ASSERT_EQ(mesh.morph_targets.size(), 1U);
    expect_near(mesh.morph_targets[0].deltas[0], {0, 0, 2});
}

TEST(ParseGltf, BlendsTheJointsOfAVertexByWeightsThatMissOneALittle) {
    GltfDocument document = triangle();
    std::vector<std::uint8_t> joints{0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0};
    std::vector<std::uint8_t> weights{127, 127, 0, 0, 254, 0, 0, 0, 0, 0, 0, 0};
    json attributes{{"JOINTS_0", add_accessor(document, joints, "VEC4", 5121, 4)},
                    {"WEIGHTS_0", add_accessor(document, weights, "VEC4", 5121, 4)}};
    document.json["accessors"][2]["normalized"] = true;
    document.json["meshes"][0]["primitives"][0]["attributes"].update(attributes);
    document.json["skins"] = json::array({{{"joints", {0, 1}}}});
    add_node(document, {{"translation", {2, 0, 0}}});
    add_node(document, {{"translation", {0, 4, 0}}});
    add_node(document, {{"mesh", 0}, {"skin", 0}});
    const Mesh mesh = read(document);
    expect_near(mesh.positions[0], {1, 2, 0});
    expect_near(mesh.positions[1], {3, 0, 0});
    expect_near(mesh.positions[2], {0, 1, 0});
}

TEST(ParseGltf, RefusesJointsThatTheSkinDoesNotHave) {
    GltfDocument document = everything();
    document.json["skins"][0]["joints"] = json::array();
    EXPECT_THAT(refusal(document), HasSubstr("JOINTS_0: expected"));
}

TEST(ParseGltf, KeepsADocumentThatReadsBackAsTheSameMesh) {
    const Mesh mesh = read(everything());
    const Mesh again = parse(mesh.gltf);
    EXPECT_EQ(again.positions, mesh.positions);
    EXPECT_EQ(again.face_vertices, mesh.face_vertices);
    EXPECT_EQ(again.gltf, mesh.gltf);
}

struct Head {
    const char* file;
    std::size_t vertices, faces, targets;
};

class RealHeads : public testing::TestWithParam<Head> {};

TEST_P(RealHeads, AreReadWhole) {
    const std::filesystem::path path = std::filesystem::path(MIEN_SHARED) / "data" / GetParam().file;
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << path;
    std::ifstream file(path, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    const Mesh mesh = parse(as_bytes(text));
    EXPECT_EQ(vertex_count(mesh), GetParam().vertices);
    EXPECT_EQ(face_count(mesh), GetParam().faces);
    EXPECT_EQ(mesh.morph_targets.size(), GetParam().targets);
    EXPECT_TRUE(hostile::keeps_promise(mesh));
    EXPECT_EQ(parse(mesh.gltf).positions, mesh.positions);
}

INSTANTIATE_TEST_SUITE_P(ParseGltf, RealHeads,
                         testing::Values(Head{"mh-caucasian/mh-caucasian-male.glb", 5000, 9388, 34},
                                         Head{"mh-caucasian/mh-caucasian-female.glb", 5000, 9388, 34},
                                         Head{"suzanne/suzi.glb", 7503, 14842, 0},
                                         Head{"suzanne/suzi-draco.glb", 7503, 14842, 0},
                                         Head{"ict/ict_face.glb", 11248, 22288, 27}));

}  // namespace
}  // namespace mien
