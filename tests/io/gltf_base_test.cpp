// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "io/gltf_base.hpp"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <gmock/gmock.h>

#include "io/gltf_builder.hpp"
#include "io/gltf_player.hpp"
#include "shapes.hpp"

#include "mien/error.hpp"
#include "mien/io/gltf.hpp"

namespace mien {
namespace {

using nlohmann::json;
using testing::ElementsAre;

void keep(const char* name, const GltfDocument& document) {
    const char* folder = std::getenv("MIEN_KEEP_GLB");
    if (!folder) return;
    const std::vector<std::byte> bytes = format_glb(document);
    std::ofstream file(std::string(folder) + "/" + name + ".glb", std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

const json& attributes(const GltfDocument& document, std::size_t mesh = 0) {
    return document.json.at("meshes").at(mesh).at("primitives").at(0).at("attributes");
}

// A head of the file: one triangle with everything that a source may have, on a child node that is scaled, below a
// node that is turned and moved, beside a camera.
Mesh source_head(Vec3 scale) {
    GltfDocument file;
    json& root = file.json;
    root["asset"] = {{"version", "2.0"}, {"generator", "another"}};
    root["scene"] = 0;
    append_object(file, "scenes", {{"nodes", {0, 2}}});
    const double h = std::sqrt(0.5);
    append_object(file, "nodes",
                  {{"translation", {1, 2, 3}}, {"rotation", {0, h, 0, h}}, {"children", json::parse("[1]")}});
    append_object(file, "nodes", {{"name", "face"}, {"mesh", 0}, {"scale", {scale.x, scale.y, scale.z}}});
    append_object(file, "nodes", {{"name", "view"}, {"camera", 0}});
    append_object(file, "cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.01}}}});
    append_object(file, "materials", {{"name", "skin"}, {"doubleSided", true}});
    const std::vector<Vec3f> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    json points;
    points["POSITION"] = append_vectors(file, corners, BufferTarget::vertices, Bounds::given);
    const std::vector<Vec3f> slanted(3, Vec3f{0.6F, 0, 0.8F});
    points["NORMAL"] = append_vectors(file, slanted, BufferTarget::vertices);
    const std::vector<float> tangents{0.8F, 0, -0.6F, 1, 0.8F, 0, -0.6F, 1, 0.8F, 0, -0.6F, 1};
    points["TANGENT"] = append_floats(file, tangents, Elements::vec4, BufferTarget::vertices);
    const std::vector<float> uvs{0, 0, 1, 0, 0, 1};
    points["TEXCOORD_0"] = append_floats(file, uvs, Elements::vec2, BufferTarget::vertices);
    points["WEIGHTS_0"] = append_floats(file, std::vector<float>(12, 0.25F), Elements::vec4, BufferTarget::vertices);
    json primitive = {{"attributes", points}, {"material", 0}};
    const std::size_t target = append_vectors(file, corners, BufferTarget::vertices, Bounds::given);
    primitive["targets"].push_back(json::object());
    primitive["targets"][0]["POSITION"] = target;
    primitive["indices"] = append_indices(file, std::vector<std::uint32_t>{0, 1, 2});
    primitive["extras"]["targetNames"] = std::vector<std::string>{"smile"};
    json shape = {{"name", "Face"}, {"weights", std::vector<double>{0.5}}};
    shape["extras"] = {{"targetNames", std::vector<std::string>{"smile"}}, {"maker", "someone"}};
    shape["primitives"].push_back(primitive);
    append_object(file, "meshes", shape);
    root["animations"] = json::array();
    root["skins"] = json::array();

    Mesh mesh;
    // A quarter turn about y takes (x, y, z) to (z, y, -x).
    for (const Vec3f& p : corners)
        mesh.positions.push_back(
            to_float({scale.z * p.z + 1, scale.y * p.y + 2, -scale.x * static_cast<double>(p.x) + 3}));
    add_face(mesh, std::array{0U, 1U, 2U});
    mesh.parts.push_back({"Face", 0, 0, 0, 3, 0, 1});
    mesh.unit = "m";
    mesh.gltf = format_glb(file);
    return mesh;
}

TEST(Base, a_head_that_does_not_fit_its_document_is_refused) {
    Mesh mesh = source_head({1, 1, 1});
    mesh.parts[0].vertex_count = 2;
    EXPECT_THROW(base_document(mesh), Error);
    mesh = source_head({1, 1, 1});
    mesh.parts[0].mesh = 7;
    EXPECT_THROW(base_document(mesh), Error);
    mesh = source_head({1, 1, 1});
    mesh.positions.pop_back();
    EXPECT_THROW(base_document(mesh), Error);
    EXPECT_THROW(base_document(Mesh{}), Error);
}

TEST(Base, materials_cameras_nodes_and_extras_survive_and_motion_goes) {
    const BaseDocument base = base_document(source_head({1, 1, 1}));
    const json& root = base.document.json;
    keep("source", base.document);
    EXPECT_EQ(root["materials"][0]["name"], "skin");
    EXPECT_EQ(root["meshes"][0]["primitives"][0]["material"], 0);
    EXPECT_EQ(root["cameras"][0]["type"], "perspective");
    EXPECT_EQ(root["nodes"][2]["camera"], 0);
    EXPECT_EQ(root["nodes"][0]["translation"], json({1, 2, 3}));
    EXPECT_EQ(root["meshes"][0]["extras"], json({{"maker", "someone"}}));
    EXPECT_EQ(root["asset"]["generator"], "mien");
    EXPECT_FALSE(root.contains("animations") || root.contains("skins"));
    EXPECT_FALSE(root["meshes"][0].contains("weights"));
    EXPECT_FALSE(root["meshes"][0]["primitives"][0].contains("targets"));
    EXPECT_FALSE(root["meshes"][0]["primitives"][0].contains("extras")) << "names of targets that are gone";
    EXPECT_FALSE(attributes(base.document).contains("WEIGHTS_0"));
    EXPECT_THAT(played::numbers(base.document, attributes(base.document)["TEXCOORD_0"]), ElementsAre(0, 0, 1, 0, 0, 1));
    EXPECT_EQ(root["accessors"].size(), 5U) << "positions, normals, tangents, texture coordinates, indices";
    EXPECT_EQ(base.document.binary.size(), 36U + 36 + 48 + 24 + 8) << "indices are padded";
}

TEST(Base, the_mesh_stands_in_the_scene_on_a_root_without_a_transform) {
    const Mesh mesh = source_head({2, 1, 1});
    const BaseDocument base = base_document(mesh);
    const json& root = base.document.json;
    EXPECT_FALSE(root["nodes"][1].contains("mesh"));
    ASSERT_THAT(base.mesh_nodes, ElementsAre(3));
    EXPECT_EQ(root["nodes"][3], json({{"name", "Face"}, {"mesh", 0}}));
    EXPECT_THAT(root["scenes"][0]["nodes"], ElementsAre(0, 2, 3));
    ASSERT_EQ(base.primitives.size(), 1U);
    EXPECT_THAT(base.primitives[0].vertices, ElementsAre(0, 1, 2));
    const std::vector<Vec3> placed = played::vectors(base.document, attributes(base.document)["POSITION"]);
    EXPECT_THAT(placed, ElementsAre(Vec3{1, 2, 3}, Vec3{1, 2, 1}, Vec3{1, 3, 3}));
    EXPECT_EQ(root["accessors"][attributes(base.document)["POSITION"].get<std::size_t>()]["min"],
              json({1.0, 2.0, 1.0}));
}

// The surface is spanned by the tangent (0.8, 0, -0.6) and y; scaled by 2 along x and turned it is spanned by
// (-0.6, 0, -1.6) and y, and its normal is (1.6, 0, -0.6), normalised.
TEST(Base, normals_and_tangents_stay_square_to_each_other_under_uneven_scale) {
    const BaseDocument base = base_document(source_head({2, 1, 1}));
    const double size = std::hypot(1.6, 0.6);
    const std::vector<Vec3> normals = played::vectors(base.document, attributes(base.document)["NORMAL"]);
    for (const Vec3& n : normals) EXPECT_LT(distance(n, Vec3{1.6, 0, -0.6} / size), 1e-7);
    const std::vector<double> t = played::numbers(base.document, attributes(base.document)["TANGENT"]);
    EXPECT_LT(distance(Vec3{t[0], t[1], t[2]}, Vec3{-0.6, 0, -1.6} / size), 1e-7);
    EXPECT_EQ(t[3], 1);
}

TEST(Base, a_head_that_was_reshaped_has_its_normals_turned_with_its_surface) {
    Mesh mesh = source_head({1, 1, 1});
    const std::vector<Vec3> before =
        played::vectors(base_document(mesh).document, attributes(base_document(mesh).document)["NORMAL"]);
    for (Vec3f& p : mesh.positions) p = {-p.y, p.x, p.z};  // a quarter turn about z
    const BaseDocument base = base_document(mesh);
    const std::vector<Vec3> after = played::vectors(base.document, attributes(base.document)["NORMAL"]);
    ASSERT_EQ(after.size(), before.size());
    // The triangle faces x and then y; what the normals lean aside from it leans with it.
    for (std::size_t v = 0; v < after.size(); ++v)
        EXPECT_LT(distance(after[v], {-before[v].y, before[v].x, before[v].z}), 1e-6);
    EXPECT_FALSE(attributes(base.document).contains("TANGENT"));
    EXPECT_THAT(played::numbers(base.document, attributes(base.document)["TEXCOORD_0"]), ElementsAre(0, 0, 1, 0, 0, 1));
}

TEST(Base, a_mirroring_node_turns_triangles_round_and_flips_the_hand_of_tangents) {
    const BaseDocument base = base_document(source_head({-1, 1, 1}));
    keep("mirrored", base.document);
    const json& primitive = base.document.json["meshes"][0]["primitives"][0];
    EXPECT_THAT(played::numbers(base.document, primitive["indices"]), ElementsAre(0, 2, 1));
    EXPECT_EQ(played::numbers(base.document, attributes(base.document)["TANGENT"])[3], -1);
    // (0.6, 0, 0.8) mirrored is (-0.6, 0, 0.8), turned (0.8, 0, 0.6).
    EXPECT_LT(distance(played::vectors(base.document, attributes(base.document)["NORMAL"])[0], {0.8, 0, 0.6}), 1e-7);
}

TEST(Base, strips_and_fans_under_a_mirror_become_lists_turned_round) {
    for (const int mode : {5, 6}) {
        Mesh mesh = source_head({-1, 1, 1});
        GltfDocument file = parse_glb(mesh.gltf);
        file.json["meshes"][0]["primitives"][0]["mode"] = mode;
        const std::size_t indices = append_indices(file, std::vector<std::uint32_t>{0, 1, 2, 0});
        file.json["meshes"][0]["primitives"][0]["indices"] = indices;
        mesh.gltf = format_glb(file);
        const BaseDocument base = base_document(mesh);
        const json& primitive = base.document.json["meshes"][0]["primitives"][0];
        EXPECT_EQ(primitive["mode"], 4);
        const std::vector<double> strip{0, 2, 1, 1, 2, 0}, fan{0, 2, 1, 0, 0, 2};
        EXPECT_EQ(played::numbers(base.document, primitive["indices"]), mode == 5 ? strip : fan);
    }
}

// Two quads side by side whose shared edge has two texture coordinates on each of its vertices.
Mesh seam() {
    Mesh mesh = shapes::strip(2);
    for (int quad = 0; quad < 2; ++quad)
        for (const Vec2f uv : {Vec2f{0, 0}, Vec2f{1, 0}, Vec2f{1, 1}, Vec2f{0, 1}}) mesh.corner_uvs.push_back(uv);
    return mesh;
}

TEST(Base, vertices_are_split_at_seams_of_texture_and_only_there) {
    const Mesh mesh = seam();
    const BaseDocument base = base_document(mesh);
    keep("seam", base.document);
    ASSERT_EQ(base.primitives.size(), 1U);
    const std::vector<std::uint32_t>& behind = base.primitives[0].vertices;
    EXPECT_THAT(behind, ElementsAre(0, 1, 1, 2, 3, 4, 4, 5));
    const std::vector<Vec3> positions = played::vectors(base.document, attributes(base.document)["POSITION"]);
    for (std::size_t i = 0; i < behind.size(); ++i) EXPECT_EQ(positions[i], to_double(mesh.positions[behind[i]]));
    const std::vector<double> uvs = played::numbers(base.document, attributes(base.document)["TEXCOORD_0"]);
    const std::vector<double> indices =
        played::numbers(base.document, base.document.json["meshes"][0]["primitives"][0]["indices"]);
    // The fan of quad q: corners 0 1 2, 0 2 3.
    const std::vector<std::size_t> corners{0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7};
    ASSERT_EQ(indices.size(), corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const auto at = static_cast<std::size_t>(indices[i]);
        EXPECT_EQ(behind[at], mesh.face_vertices[corners[i]]);
        EXPECT_EQ(uvs[2 * at], mesh.corner_uvs[corners[i]].x);
        EXPECT_EQ(uvs[2 * at + 1], mesh.corner_uvs[corners[i]].y);
    }
}

TEST(Base, a_mesh_without_texture_is_written_vertex_by_vertex) {
    Mesh mesh = shapes::strip(2);
    mesh.positions.push_back({9, 9, 9});
    const BaseDocument base = base_document(mesh);
    EXPECT_THAT(base.primitives[0].vertices, ElementsAre(0, 1, 2, 3, 4, 5)) << "what no face uses is left out";
    EXPECT_FALSE(attributes(base.document).contains("TEXCOORD_0"));
}

TEST(Base, groups_become_meshes_by_their_number) {
    Mesh mesh = shapes::strip(3);
    mesh.parts = {{"skin", 0, 0, 0, 8, 0, 1}, {"teeth", 1, 0, 0, 8, 1, 1}, {"skin", 0, 1, 0, 8, 2, 1}};
    const BaseDocument base = base_document(mesh);
    ASSERT_EQ(base.document.json["meshes"].size(), 2U);
    EXPECT_EQ(base.document.json["meshes"][0]["name"], "skin");
    EXPECT_EQ(base.document.json["meshes"][1]["name"], "teeth");
    EXPECT_THAT(base.primitives[0].vertices, ElementsAre(0, 1, 2, 3, 4, 5, 6, 7));
    EXPECT_THAT(base.primitives[1].vertices, ElementsAre(1, 2, 5, 6));
    EXPECT_EQ(base.mesh_nodes.size(), 2U);
}

// Each corner of a cube has three right angles, however its sides are split; normals point along the diagonals.
TEST(Base, normals_are_weighted_by_angle_and_shared_by_vertices_at_one_place) {
    Mesh cube;
    for (std::uint32_t side = 0; side < 6; ++side) {
        const std::uint32_t axis = side / 2;
        for (const auto& [u, w] : {std::pair{-1.F, -1.F}, {1.F, -1.F}, {1.F, 1.F}, {-1.F, 1.F}}) {
            const std::array<float, 3> out{side % 2 == 0 ? 1.F : -1.F, side % 2 == 0 ? u : -u, w};
            cube.positions.push_back({out[(3 - axis) % 3], out[(4 - axis) % 3], out[(5 - axis) % 3]});
        }
        add_face(cube, std::array{4 * side, 4 * side + 1, 4 * side + 2, 4 * side + 3});
    }
    const BaseDocument base = base_document(cube);
    const std::vector<Vec3> normals = played::vectors(base.document, attributes(base.document)["NORMAL"]);
    ASSERT_EQ(normals.size(), 24U);
    for (std::size_t v = 0; v < 24; ++v)
        EXPECT_LT(distance(normals[v], to_double(cube.positions[v]) / std::sqrt(3.0)), 1e-6) << v;
}

}  // namespace
}  // namespace mien
