// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "io/gltf_codecs.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "io/gltf_accessors.hpp"
#include "io/gltf_text.hpp"
#include "refusal.hpp"

#include "mien/io/read.hpp"

namespace mien {
namespace {

using nlohmann::json;

constexpr std::uint32_t corners = 64;

std::vector<float> positions() {
    std::vector<float> values;
    for (std::uint32_t v = 0; v < corners; ++v)
        for (const std::uint32_t k : {7U, 11U, 13U}) values.push_back(static_cast<float>((v * k) % 17) / 4);
    return values;
}

std::vector<std::uint32_t> triangles() {
    std::vector<std::uint32_t> indices;
    for (std::uint32_t v = 0; v + 2 < corners; ++v) indices.insert(indices.end(), {v, v + 1, v + 2});
    return indices;
}

std::vector<unsigned char> encoded_positions() {
    const std::vector<float> values = positions();
    std::vector<unsigned char> bytes(meshopt_encodeVertexBufferBound(corners, 12));
    bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), values.data(), corners, 12));
    return bytes;
}

std::vector<unsigned char> encoded_triangles() {
    const std::vector<std::uint32_t> indices = triangles();
    std::vector<unsigned char> bytes(meshopt_encodeIndexBufferBound(indices.size(), corners));
    bytes.resize(meshopt_encodeIndexBuffer(bytes.data(), bytes.size(), indices.data(), indices.size()));
    return bytes;
}

std::vector<unsigned char> encoded_sequence() {
    const std::vector<std::uint32_t> indices = triangles();
    std::vector<unsigned char> bytes(meshopt_encodeIndexSequenceBound(indices.size(), corners));
    bytes.resize(meshopt_encodeIndexSequence(bytes.data(), bytes.size(), indices.data(), indices.size()));
    return bytes;
}

// A document of one triangle mesh whose two views are compressed.
GltfDocument compressed(const std::vector<unsigned char>& vertices, const std::vector<unsigned char>& indices,
                        const char* index_mode) {
    const std::size_t count = triangles().size();
    GltfDocument document;
    document.json = json::parse(R"({"asset": {"version": "2.0"}, "extensionsUsed": ["EXT_meshopt_compression"],
        "extensionsRequired": ["EXT_meshopt_compression"], "buffers": [{"byteLength": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}], "scene": 0})");
    const auto add = [&](const std::vector<unsigned char>& bytes, std::size_t elements, std::size_t stride,
                         const char* mode) {
        while (document.binary.size() % 4 != 0) document.binary.push_back({});
        const json extension{{"buffer", 0U},
                             {"byteOffset", document.binary.size()},
                             {"byteLength", bytes.size()},
                             {"byteStride", stride},
                             {"count", elements},
                             {"mode", mode}};
        document.json["bufferViews"].push_back({{"buffer", 0U},
                                                {"byteLength", elements * stride},
                                                {"extensions", {{"EXT_meshopt_compression", extension}}}});
        const auto raw = std::as_bytes(std::span(bytes));
        document.binary.insert(document.binary.end(), raw.begin(), raw.end());
    };
    add(vertices, corners, 12, "ATTRIBUTES");
    add(indices, count, 4, index_mode);
    document.json["accessors"] = {{{"bufferView", 0U}, {"componentType", 5126U}, {"count", corners}, {"type", "VEC3"}},
                                  {{"bufferView", 1U}, {"componentType", 5125U}, {"count", count}, {"type", "SCALAR"}}};
    return document;
}

json& extension_of(GltfDocument& document, std::size_t view) {
    return document.json["bufferViews"][view]["extensions"]["EXT_meshopt_compression"];
}

std::string refusal(GltfDocument document) {
    return mien::refusal([&] { decompress(document); });
}

TEST(GltfCodecs, RefusesWhatTheExtensionDoesNotKnow) {
    const std::tuple<const char*, json, const char*> wrongs[] = {
        {"mode", "BEST", "/mode"},           {"filter", "BLUR", "/filter"}, {"byteStride", 13U, "/byteStride"},
        {"byteStride", 260U, "/byteStride"}, {"count", 0U, "/count"},       {"byteOffset", 1U << 30U, "bytes inside"},
        {"buffer", 3U, "bytes inside"},      {"count", -1, "/count"}};
    for (const auto& [member, value, place] : wrongs) {
        GltfDocument document = compressed(encoded_positions(), encoded_triangles(), "TRIANGLES");
        extension_of(document, 0)[member] = value;
        EXPECT_THAT(refusal(document), testing::HasSubstr(place)) << member << " " << value;
    }
}

TEST(GltfCodecs, APromisedCountIsHeldAgainstTheBytesBeforeAnythingIsAllocated) {
    GltfDocument document = compressed(encoded_positions(), encoded_triangles(), "TRIANGLES");
    extension_of(document, 0)["count"] = 1ULL << 40U;
    EXPECT_THAT(refusal(document), testing::HasSubstr("/count"));
}

TEST(GltfCodecs, ManyViewsOfTheSameBytesShareOneBudget) {
    // 4096 equal vertices take few bytes, and each of the views below makes them large again.
    const std::vector<float> still(std::size_t{3} * 4096);
    std::vector<unsigned char> bytes(meshopt_encodeVertexBufferBound(4096, 12));
    bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), still.data(), 4096, 12));
    GltfDocument document = compressed(bytes, encoded_triangles(), "TRIANGLES");
    extension_of(document, 0)["count"] = 4096U;
    EXPECT_EQ(refusal(document), "");
    for (int copies = 0; copies < 200; ++copies)
        document.json["bufferViews"].push_back(json(document.json["bufferViews"][0]));
    EXPECT_THAT(refusal(document), testing::HasSubstr("128 times"));
}

TEST(GltfCodecs, BytesCutShortAndBytesOfAnotherKindAreRefused) {
    std::vector<unsigned char> cut = encoded_positions();
    cut.resize(cut.size() / 2);
    EXPECT_THAT(refusal(compressed(cut, encoded_triangles(), "TRIANGLES")), testing::HasSubstr("/bufferViews/0"));
    EXPECT_THAT(refusal(compressed(encoded_positions(), encoded_positions(), "TRIANGLES")),
                testing::HasSubstr("/bufferViews/1"));
}

TEST(GltfCodecs, MeshoptGivesBackEveryNumber) {
    for (const bool sequence : {false, true}) {
        GltfDocument document = compressed(encoded_positions(), sequence ? encoded_sequence() : encoded_triangles(),
                                           sequence ? "INDICES" : "TRIANGLES");
        decompress(document);
        EXPECT_EQ(read_floats(document, 0, 3, ""), positions());
        const auto found = read_indices(document, 1, "");
        const auto expected = triangles();
        ASSERT_EQ(found.size(), expected.size());
        // The triangle codec may turn the corners of a triangle round.
        for (std::size_t t = 0; t < found.size(); t += 3)
            EXPECT_TRUE(std::is_permutation(&found[t], &found[t] + 3, &expected[t])) << t;
    }
}

TEST(GltfCodecs, NothingOfTheCompressionIsLeft) {
    GltfDocument document = compressed(encoded_positions(), encoded_triangles(), "TRIANGLES");
    decompress(document);
    EXPECT_EQ(document.json.dump().find("EXT_meshopt_compression"), std::string::npos);
    EXPECT_EQ(document.binary.size(), positions().size() * 4 + triangles().size() * 4);
}

// A triangle as Draco codes it, x further along than the unit triangle.
std::vector<unsigned char> draco_triangle(float x) {
    const std::array<std::array<float, 3>, 3> corner{{{x, 0, 0}, {x + 1, 0, 0}, {x, 1, 0}}};
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(1);
    const int positions = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    builder.SetAttributeValuesForFace(positions, draco::FaceIndex(0), corner[0].data(), corner[1].data(),
                                      corner[2].data());
    draco::Encoder encoder;
    encoder.SetEncodingMethod(draco::MESH_SEQUENTIAL_ENCODING);
    draco::EncoderBuffer bytes;
    EXPECT_TRUE(encoder.EncodeMeshToBuffer(*builder.Finalize(), &bytes).ok());
    const auto* begin = reinterpret_cast<const unsigned char*>(bytes.data());
    return {begin, begin + bytes.size()};
}

// A primitive of such a triangle in the document: accessors 0 and 1 say what comes out.
json draco_primitive(GltfDocument& document, float x) {
    const std::size_t view = gltf_text::add_view(document, draco_triangle(x));
    if (!document.json.contains("accessors"))
        document.json["accessors"] = {{{"componentType", 5126U}, {"count", 3U}, {"type", "VEC3"}},
                                      {{"componentType", 5125U}, {"count", 3U}, {"type", "SCALAR"}}};
    const json extension{{"bufferView", view}, {"attributes", {{"POSITION", 0U}}}};
    return {{"attributes", {{"POSITION", 0U}}},
            {"indices", 1U},
            {"extensions", {{"KHR_draco_mesh_compression", extension}}}};
}

TEST(GltfCodecs, ADracoMeshThatCallsItselfAStripOrAFanIsAListOfTriangles) {
    for (const unsigned mode : {4U, 5U, 6U}) {
        GltfDocument document = gltf_text::empty();
        json primitive = draco_primitive(document, 0);
        primitive["mode"] = mode;
        document.json["meshes"].push_back({{"primitives", json::array({primitive})}});
        const Mesh mesh = gltf_text::read(document);
        EXPECT_EQ(face_count(mesh), 1U) << mode;
        EXPECT_THAT(mesh.face_vertices, testing::UnorderedElementsAre(0, 1, 2)) << mode;
    }
}

TEST(GltfCodecs, ADracoMeshThatManyPrimitivesNameIsUnpackedOnce) {
    GltfDocument document = gltf_text::empty();
    const json primitive = draco_primitive(document, 0);
    document.json["meshes"].push_back({{"primitives", json::array()}});
    for (int i = 0; i < 1000; ++i) document.json["meshes"][0]["primitives"].push_back(primitive);
    EXPECT_EQ(refusal(document), "");
    decompress(document);
    EXPECT_EQ(document.json["accessors"].size(), 2U);
    EXPECT_EQ(document.binary.size(), 3U * 12 + 3 * 4);
}

TEST(GltfCodecs, TwoDracoMeshesWithOneAccessorStayTwo) {
    GltfDocument document = gltf_text::empty();
    const json first = draco_primitive(document, 0), second = draco_primitive(document, 5);
    document.json["meshes"].push_back({{"primitives", json::array({first, second})}});
    const Mesh mesh = gltf_text::read(document);
    ASSERT_EQ(vertex_count(mesh), 6U);
    for (std::size_t v = 0; v < 3; ++v) {
        EXPECT_LE(mesh.positions[v].x, 1) << v;
        EXPECT_GE(mesh.positions[v + 3].x, 5) << v;
    }
}

TEST(GltfCodecs, APlainPrimitiveKeepsTheNumbersThatADracoMeshReplaces) {
    GltfDocument document = gltf_text::triangle();
    json primitive = draco_primitive(document, 5);
    primitive["indices"] = gltf_text::add_accessor(document, std::vector<std::uint16_t>{0, 1, 2}, "SCALAR", 5123, 1);
    document.json["meshes"][0]["primitives"].push_back(primitive);
    const Mesh mesh = gltf_text::read(document);
    ASSERT_EQ(vertex_count(mesh), 6U);
    EXPECT_EQ(mesh.positions[1], (Vec3f{1, 0, 0}));
    EXPECT_GE(mesh.positions[4].x, 5);
}

TEST(GltfCodecs, AHeadThatDracoCodedIsItsPlainTwin) {
    const std::filesystem::path folder = std::filesystem::path(MIEN_SHARED) / "data" / "suzanne";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder;
    const auto sorted = [&](const char* name) {
        std::vector<Vec3f> places = read_mesh(folder / name).positions;
        std::sort(places.begin(), places.end(),
                  [](const Vec3f& a, const Vec3f& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); });
        return places;
    };
    EXPECT_EQ(sorted("suzi-draco.glb"), sorted("suzi.glb"));
}

}  // namespace
}  // namespace mien
