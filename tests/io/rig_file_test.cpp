// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include <array>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

#include "io/glb.hpp"
#include "io/hostile.hpp"
#include "refusal.hpp"
#include "shapes.hpp"

#include "mien/error.hpp"
#include "mien/io/gltf.hpp"

namespace mien {
namespace {

using nlohmann::json;
using Bytes = std::vector<std::byte>;

struct Rigged {
    Mesh mesh;
    Rig rig;
    Skin skin;
};

// A rig of any mesh: signed weights with odd fractions on all vertices but the last three, which are an eyeball.
Rig rig_of(const Mesh& mesh) {
    Rig rig;
    rig.method = "biharmonic";
    rig.rest = mesh.positions;
    for (std::uint32_t p = 0; p < 3; ++p) rig.points.push_back(shapes::point_at(mesh, "4." + std::to_string(p), p));
    rig.points[0].moves = {false, true, true};
    rig.points[1].position = {0.1, -0.0, 1e-300};
    rig.points[2].snapped = 1.0 / 3;
    rig.row_starts = {0};
    const auto vertices = static_cast<std::uint32_t>(mesh.positions.size());
    for (std::uint32_t v = 0; v < vertices; ++v) {
        for (std::uint16_t p = 0; p < 3 && v + 3 < vertices; ++p) {
            if ((v + p) % 4 == 0) continue;
            rig.row_points.push_back(p);
            rig.weights.push_back({1.0F / static_cast<float>(v + p + 1), -0.1F, static_cast<float>(p) / 7});
        }
        rig.row_starts.push_back(static_cast<std::uint32_t>(rig.row_points.size()));
    }
    rig.eyeballs = {{"left eye", {vertices - 3, vertices - 2}, {0.1, 0.2, 0.3}, 1}, {"glass", {vertices - 1}, {}, {}}};
    rig.attachments = {{"teeth", "follows the jaw", 3}};
    rig.unreached = 2;
    return rig;
}

Rigged rigged(Mesh mesh) {
    Rigged made{std::move(mesh), {}, {}};
    made.rig = rig_of(made.mesh);
    for (std::size_t slot = 0; slot < 4 * made.mesh.positions.size(); ++slot)
        made.skin.joints.push_back(static_cast<std::uint16_t>(slot % 4));
    made.skin.weights.assign(4 * made.mesh.positions.size(), 0.25F);
    return made;
}

// A head that is no glTF: quads, texture coordinates with a seam, two parts, a unit.
Mesh polygons() {
    Mesh mesh = shapes::grid(4, 3, 0.1F);
    shapes::append(mesh, shapes::strip(2), {1, 1, 1});
    for (std::size_t c = 0; c < mesh.face_vertices.size(); ++c)
        mesh.corner_uvs.push_back({0.25F, 1.0F / static_cast<float>(c + 1)});
    mesh.parts = {{"face", 0, 0, 0, 20, 0, 12}, {"board", 1, 0, 20, 6, 12, 2}};
    mesh.unit = "cm";
    return mesh;
}

Bytes no_files(std::string_view /*uri*/) {
    throw Error("no files");
}

// The same head from a glTF: below a node that turns, scales and mirrors, beside a camera, with a material of its own.
Mesh from_gltf() {
    GltfDocument document = parse_glb(format_glb(polygons(), MorphTrack{}));
    json& root = document.json;
    root["materials"].push_back({{"name", "skin of mine"}});
    root["meshes"][0]["primitives"][0]["material"] = 1;
    root["nodes"].push_back({{"children", {0, 1}}, {"rotation", {0.6, 0, 0, 0.8}}, {"scale", {-2, 0.3, 1.7}}});
    root["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", 0.1}}}}};
    root["nodes"].push_back({{"camera", 0}, {"name", "view"}});
    root["scenes"][0]["nodes"] = {2, 3};
    return parse_gltf(format_glb(document), no_files);
}

Bytes written(const Rigged& head) {
    Bytes bytes = format_rig(head.mesh, head.rig, head.skin);
    if (const char* folder = std::getenv("MIEN_KEEP_GLB")) {
        static int number = 0;
        std::ofstream file(std::string(folder) + "/rig" + std::to_string(number++) + ".glb", std::ios::binary);
        file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    }
    return bytes;
}

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

std::array<std::uint64_t, 3> bits(const Vec3& v) {
    return std::bit_cast<std::array<std::uint64_t, 3>>(v);
}

void expect_same(const Rig& a, const Rig& b) {
    EXPECT_EQ(a.method, b.method);
    ASSERT_EQ(a.points.size(), b.points.size());
    for (std::size_t i = 0; i < a.points.size(); ++i) {
        EXPECT_EQ(a.points[i].id, b.points[i].id);
        EXPECT_EQ(a.points[i].vertex, b.points[i].vertex);
        EXPECT_EQ(bits(a.points[i].position), bits(b.points[i].position)) << i;
        EXPECT_EQ(a.points[i].moves, b.points[i].moves);
        EXPECT_EQ(a.points[i].snapped, b.points[i].snapped);
    }
    EXPECT_TRUE(same_bits(a.rest, b.rest));
    EXPECT_EQ(a.row_starts, b.row_starts);
    EXPECT_EQ(a.row_points, b.row_points);
    EXPECT_TRUE(same_bits(a.weights, b.weights));
    ASSERT_EQ(a.eyeballs.size(), b.eyeballs.size());
    for (std::size_t i = 0; i < a.eyeballs.size(); ++i) {
        EXPECT_EQ(a.eyeballs[i].name, b.eyeballs[i].name);
        EXPECT_EQ(a.eyeballs[i].vertices, b.eyeballs[i].vertices);
        EXPECT_EQ(a.eyeballs[i].centre, b.eyeballs[i].centre);
        EXPECT_EQ(a.eyeballs[i].point, b.eyeballs[i].point);
    }
    ASSERT_EQ(a.attachments.size(), b.attachments.size());
    for (std::size_t i = 0; i < a.attachments.size(); ++i) {
        EXPECT_EQ(a.attachments[i].name, b.attachments[i].name);
        EXPECT_EQ(a.attachments[i].how, b.attachments[i].how);
        EXPECT_EQ(a.attachments[i].vertices, b.attachments[i].vertices);
    }
    EXPECT_EQ(a.unreached, b.unreached);
}

// What parse_rig says of the file after `change`; empty when it takes it.
std::string refusal(const std::function<void(GltfDocument&, json& extension)>& change, const Mesh& mesh = polygons()) {
    GltfDocument document = parse_glb(format_rig(mesh, rig_of(mesh), rigged(mesh).skin));
    change(document, document.json["extensions"]["MIEN_rig"]);
    return mien::refusal([&] { parse_rig(format_glb(document)); });
}

// The same with one number of an array changed.
template <class T>
std::string refusal_of_number(const char* name, std::size_t index, T value) {
    return refusal([&](GltfDocument& document, json& extension) {
        const json& array = extension.contains(name) ? extension[name] : extension["head"][name];
        const json& view = document.json["bufferViews"][array["bufferView"].get<std::size_t>()];
        std::memcpy(document.binary.data() + view["byteOffset"].get<std::size_t>() + index * sizeof(T), &value,
                    sizeof value);
    });
}

#define EXPECT_SAYS(sentence, part) EXPECT_THAT(sentence, testing::HasSubstr(part))

TEST(RigFile, a_file_without_a_rig_or_of_another_version_is_refused) {
    EXPECT_SAYS(refusal([](GltfDocument& d, json&) { d.json.erase("extensions"); }), "/extensions/MIEN_rig: expected");
    EXPECT_SAYS(refusal([](GltfDocument&, json& e) { e["version"] = 2; }), "/MIEN_rig/version: expected 1, found '2'");
    EXPECT_SAYS(refusal([](GltfDocument&, json& e) { e = 7; }), "/MIEN_rig: expected an object");
    EXPECT_SAYS(refusal([](GltfDocument&, json& e) { e.erase("head"); }), "expected \"head\" or \"neutral\"");
}

TEST(RigFile, members_of_another_kind_are_refused_by_their_place) {
    for (const char* name : {"version", "method", "points", "rest", "rowStarts", "rowPoints", "weights", "eyeballs",
                             "attachments", "unreached", "head"})
        for (const json& wrong : {json(nullptr), json(-1), json::array({json::array()}), json(true)})
            EXPECT_SAYS(refusal([&](GltfDocument&, json& e) { e[name] = wrong; }), std::string("MIEN_rig/") + name)
                << name << wrong;
    for (const char* name : {"id", "vertex", "position", "moves", "snapped"})
        EXPECT_SAYS(refusal([&](GltfDocument&, json& e) { e["points"][1].erase(name); }),
                    std::string("/points/1/") + name);
}

TEST(RigFile, views_outside_the_buffer_are_refused) {
    const auto view = [](GltfDocument& d, json& e) -> json& {
        return d.json["bufferViews"][e["weights"]["bufferView"].get<std::size_t>()];
    };
    const std::int64_t huge = std::int64_t{1} << 53;
    EXPECT_SAYS(refusal([&](GltfDocument& d, json& e) { view(d, e)["byteOffset"] = huge; }), "/byteOffset");
    EXPECT_SAYS(refusal([&](GltfDocument& d, json& e) { view(d, e)["byteLength"] = huge; }), "/byteLength");
    EXPECT_SAYS(refusal([&](GltfDocument& d, json& e) { view(d, e)["buffer"] = 1; }), "/buffer: expected 0");
    EXPECT_SAYS(refusal([&](GltfDocument& d, json& e) { view(d, e)["byteStride"] = 12; }), "/byteStride");
    EXPECT_SAYS(refusal([&](GltfDocument&, json& e) { e["weights"]["bufferView"] = 999; }), "/weights/bufferView");
    EXPECT_SAYS(refusal([&](GltfDocument&, json& e) { e["weights"]["count"] = huge; }), "/weights/count");
    EXPECT_SAYS(refusal([&](GltfDocument&, json& e) { e["rest"] = {{"count", 0}}; }), "MIEN_rig");
}

TEST(RigFile, numbers_that_do_not_fit_together_are_refused) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_SAYS(refusal_of_number<float>("rest", 4, nan), "/rest: expected finite numbers");
    EXPECT_SAYS(refusal_of_number<float>("weights", 4, nan), "/weights: expected finite numbers");
    EXPECT_SAYS(refusal_of_number<std::uint32_t>("rowStarts", 0, 1), "/rowStarts: expected 0 first, found 1");
    EXPECT_SAYS(refusal_of_number<std::uint32_t>("rowStarts", 3, 0), "/rowStarts: expected numbers that never fall");
    EXPECT_SAYS(refusal_of_number<std::uint32_t>("rowStarts", 26, 9999), "/rowPoints/count: expected 9999");
    EXPECT_SAYS(refusal_of_number<std::uint16_t>("rowPoints", 5, 3), "/rowPoints: expected numbers of 3 points");
    EXPECT_SAYS(refusal_of_number<std::uint16_t>("rowPoints", 1, 1), "/rowPoints: expected points that rise");
    EXPECT_SAYS(refusal_of_number<float>("cornerUvs", 4, nan), "/cornerUvs: expected finite");
    EXPECT_SAYS(refusal_of_number<std::uint32_t>("faceStarts", 1, 2), "/faceStarts: expected three corners");
    EXPECT_SAYS(refusal_of_number<std::uint32_t>("faceStarts", 14, 99), "/faceStarts: expected 56 last, found 99");
    EXPECT_SAYS(refusal_of_number<std::uint32_t>("faceVertices", 7, 26), "/faceVertices: expected vertices below 26");
}

TEST(RigFile, points_eyeballs_and_parts_out_of_range_are_refused) {
    const auto says = [](auto change) { return refusal([&](GltfDocument&, json& e) { change(e); }); };
    EXPECT_SAYS(says([](json& e) { e["points"][2]["vertex"] = 26; }), "/points/2/vertex: expected at most 25");
    EXPECT_SAYS(says([](json& e) { e["points"][2]["id"] = "4.1"; }), "/points: expected each id once");
    EXPECT_SAYS(says([](json& e) { e["points"][0]["moves"] = "zy"; }), "/points/0/moves");
    EXPECT_SAYS(says([](json& e) { e["points"][0]["snapped"] = -1; }), "/points/0/snapped: expected 0 or more");
    EXPECT_SAYS(says([](json& e) { e["eyeballs"][0]["point"] = 3; }), "/eyeballs/0/point: expected at most 2");
    EXPECT_SAYS(says([](json& e) { e["eyeballs"][1] = e["eyeballs"][0]; }),
                "/eyeballs/1/vertices: expected vertices that no other");
    EXPECT_SAYS(says([](json& e) { e["eyeballs"][0]["vertices"] = e["head"]["faceVertices"]; }),
                "vertices without weights");
    EXPECT_SAYS(says([](json& e) { e["attachments"][0]["vertices"] = 27; }),
                "/attachments/0/vertices: expected at most 26");
    EXPECT_SAYS(says([](json& e) { e["unreached"] = 27; }), "/unreached: expected at most 26");
    EXPECT_SAYS(says([](json& e) { e["head"]["parts"][1]["vertexCount"] = 7; }), "/head/parts/1/vertexCount");
    EXPECT_SAYS(says([](json& e) { e["head"]["parts"][1]["firstFace"] = 4294967295; }), "/head/parts/1/faceCount");
}

TEST(RigFile, a_neutral_head_that_is_not_in_the_file_is_refused) {
    const Mesh mesh = from_gltf();
    for (const char* name : {"nodes", "accessors", "bufferViews", "byteLength", "sceneNodes"}) {
        EXPECT_SAYS(refusal([&](GltfDocument&, json& e) { e["neutral"][name] = 1 << 30; }, mesh), name);
        EXPECT_NE(refusal([&](GltfDocument&, json& e) { e["neutral"][name] = 1; }, mesh), "") << name;
        EXPECT_SAYS(refusal([&](GltfDocument&, json& e) { e["neutral"].erase(name); }, mesh), name);
    }
}

TEST(RigFile, bytes_cut_or_changed_are_refused_or_a_whole_rig) {
    const Rigged head = rigged(shapes::strip(2));
    const Bytes bytes = written(head);
    const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const auto parse = [](std::span<const std::byte> each) { return parse_rig(each); };
    hostile::sweep(parse, text, [](const RigFile& file) {
        return hostile::keeps_promise(file.mesh) && file.mesh.positions.size() == file.rig.rest.size();
    });
}

TEST(RigFile, another_head_than_the_rigged_one_is_not_written) {
    Rigged head = rigged(polygons());
    head.mesh.positions[3].x += 1;
    EXPECT_THROW(written(head), Error);
    head.mesh.positions.pop_back();
    EXPECT_THROW(written(head), Error);
}

TEST(RigFile, a_head_of_polygons_comes_back_whole) {
    const Rigged head = rigged(polygons());
    const RigFile file = parse_rig(written(head));
    expect_same(file.rig, head.rig);
    EXPECT_EQ(file.mesh.positions, head.mesh.positions);
    EXPECT_EQ(file.mesh.face_starts, head.mesh.face_starts);
    EXPECT_EQ(file.mesh.face_vertices, head.mesh.face_vertices);
    EXPECT_EQ(file.mesh.corner_uvs, head.mesh.corner_uvs);
    EXPECT_EQ(file.mesh.unit, "cm");
    ASSERT_EQ(file.mesh.parts.size(), 2U);
    EXPECT_EQ(file.mesh.parts[1].name, "board");
    EXPECT_EQ(file.mesh.parts[1].first_vertex, 20U);
    EXPECT_EQ(file.mesh.parts[1].face_count, 2U);
    EXPECT_TRUE(file.mesh.gltf.empty());
}

TEST(RigFile, a_head_from_gltf_comes_back_with_its_document) {
    const Rigged head = rigged(from_gltf());
    const RigFile file = parse_rig(written(head));
    expect_same(file.rig, head.rig);
    EXPECT_EQ(file.mesh.positions, head.mesh.positions);
    EXPECT_EQ(face_count(file.mesh), face_count(head.mesh));
    const json root = parse_glb(file.mesh.gltf).json;
    EXPECT_EQ(root["materials"][1]["name"], "skin of mine");
    EXPECT_EQ(root["cameras"].size(), 1U);
    EXPECT_FALSE(root.contains("skins"));
    EXPECT_FALSE(root.contains("extensionsUsed"));
    EXPECT_THAT(root["nodes"].dump(), testing::Not(testing::HasSubstr("4.1"))) << "no joints";
}

TEST(RigFile, writing_what_was_read_gives_the_same_bytes) {
    for (const Mesh& mesh : {polygons(), shapes::strip(3), from_gltf()}) {
        const Rigged head = rigged(mesh);
        const Bytes first = written(head);
        const RigFile file = parse_rig(first);
        EXPECT_EQ(format_rig(file.mesh, file.rig, head.skin), first);
    }
}

TEST(RigFile, only_a_document_with_a_rig_is_one) {
    EXPECT_FALSE(is_rig(polygons()));
    EXPECT_FALSE(is_rig(from_gltf()));
    for (const Mesh& mesh : {polygons(), from_gltf()}) {
        const Bytes bytes = written(rigged(mesh));
        EXPECT_TRUE(is_rig(parse_gltf(bytes, no_files)));
        EXPECT_FALSE(is_rig(parse_rig(bytes).mesh));
    }
}

TEST(RigFile, every_program_sees_a_skinned_head_at_rest) {
    const json root = parse_glb(written(rigged(from_gltf()))).json;
    EXPECT_EQ(root["skins"].size(), 1U);
    EXPECT_EQ(root["skins"][0]["joints"].size(), 6U);
    EXPECT_EQ(root["extensionsUsed"], json::array({"MIEN_rig"}));
    EXPECT_FALSE(root.contains("extensionsRequired"));
    EXPECT_FALSE(root.contains("animations"));
}

TEST(RigFile, a_rig_that_moves_nothing_has_no_empty_views) {
    Rigged head = rigged(shapes::strip(2));
    head.rig.row_starts.assign(head.rig.row_starts.size(), 0);
    head.rig.row_points.clear();
    head.rig.weights.clear();
    head.rig.eyeballs.clear();
    head.rig.attachments.clear();
    const RigFile file = parse_rig(written(head));
    expect_same(file.rig, head.rig);
}

}  // namespace
}  // namespace mien
