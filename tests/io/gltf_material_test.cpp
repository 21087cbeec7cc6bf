// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Materials and pictures of scenes: what a document says of them, and what becomes of what cannot be shown.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <numbers>

#include "io/gltf_text.hpp"
#include "io/hostile.hpp"
#include "io/picture_text.hpp"
#include "io/scene_text.hpp"

#include "mien/io/scene.hpp"

namespace mien {
namespace {

using namespace gltf_text;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::size_t add_picture(GltfDocument& document, const std::string& bytes) {
    document.json["images"].push_back(
        {{"bufferView", add_view(document, std::vector<char>(bytes.begin(), bytes.end()))}, {"mimeType", "image/png"}});
    document.json["textures"].push_back({{"source", document.json["images"].size() - 1}});
    return document.json["textures"].size() - 1;
}

// A triangle in this material.
GltfDocument with_material(json material) {
    GltfDocument document = triangle();
    json& primitive = document.json["meshes"][0]["primitives"][0];
    primitive["attributes"]["TEXCOORD_0"] =
        add_accessor(document, std::vector<float>{0, 0, 1, 0, 0.25F, 0.75F}, "VEC2", 5126, 2);
    primitive["attributes"]["TEXCOORD_1"] =
        add_accessor(document, std::vector<float>{0.5F, 0.5F, 0.5F, 1, 1, 1}, "VEC2", 5126, 2);
    primitive["material"] = 0;
    document.json["materials"].push_back(std::move(material));
    add_node(document, {{"mesh", 0}});
    return document;
}

json colour_picture(const json& info) {
    return {{"pbrMetallicRoughness", {{"baseColorTexture", info}}}};
}

const Material& only(const Scene& scene) {
    EXPECT_TRUE(hostile::keeps_promise(scene));
    EXPECT_EQ(scene.materials.size(), 1U);
    return scene.materials.at(0);
}

TEST(GltfMaterial, without_a_word_is_white_metal_that_is_rough) {
    GltfDocument document = with_material(json::object());
    for (const bool given : {true, false}) {
        if (!given) document.json["meshes"][0]["primitives"][0].erase("material");
        const Scene scene = scene_in(document);
        const Material& material = only(scene);
        EXPECT_THAT(material.colour, ElementsAre(1, 1, 1, 1));
        EXPECT_EQ(material.metallic, 1);
        EXPECT_EQ(material.roughness, 1);
        EXPECT_THAT(material.emission, ElementsAre(0, 0, 0));
        EXPECT_EQ(material.alpha, Material::Alpha::opaque);
        EXPECT_FALSE(material.double_sided || material.unlit || material.colour_picture);
        EXPECT_THAT(scene.left_out, IsEmpty());
    }
}

TEST(GltfMaterial, says_colour_shine_light_and_cover) {
    json value = json::parse(R"({"name": "skin", "doubleSided": true, "alphaMode": "MASK", "alphaCutoff": 0.25,
        "emissiveFactor": [0.5, 0.25, 1],
        "pbrMetallicRoughness": {"baseColorFactor": [0.1, 0.2, 0.3, 0.4], "metallicFactor": 0.5, "roughnessFactor": 0.75},
        "extensions": {"KHR_materials_unlit": {}, "KHR_materials_emissive_strength": {"emissiveStrength": 4}}})");
    const Scene scene = scene_in(with_material(value));
    const Material& material = only(scene);
    EXPECT_EQ(material.name, "skin");
    EXPECT_THAT(material.colour, ElementsAre(0.1F, 0.2F, 0.3F, 0.4F));
    EXPECT_EQ(material.metallic, 0.5F);
    EXPECT_EQ(material.roughness, 0.75F);
    EXPECT_THAT(material.emission, ElementsAre(2, 1, 4));
    EXPECT_EQ(material.alpha, Material::Alpha::mask);
    EXPECT_EQ(material.alpha_cutoff, 0.25F);
    EXPECT_TRUE(material.double_sided);
    EXPECT_TRUE(material.unlit);
    EXPECT_THAT(scene.left_out, IsEmpty());
    value["alphaMode"] = "BLEND";
    EXPECT_EQ(only(scene_in(with_material(value))).alpha, Material::Alpha::blend);
}

TEST(GltfMaterial, numbers_out_of_range_are_brought_into_it) {
    const json value = json::parse(R"({"alphaCutoff": -1, "emissiveFactor": [-1, 1e300, 1],
        "pbrMetallicRoughness": {"baseColorFactor": [-1, 2, 0.5, 9], "metallicFactor": 7, "roughnessFactor": -7},
        "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 1e300}}})");
    const Material material = only(scene_in(with_material(value)));
    EXPECT_THAT(material.colour, ElementsAre(0, 1, 0.5F, 1));
    EXPECT_EQ(material.metallic, 1);
    EXPECT_EQ(material.roughness, 0);
    EXPECT_EQ(material.emission[0], 0);
}

TEST(GltfMaterial, what_is_wrong_is_said_with_its_place) {
    const auto said = [](const char* text) { return refusal(with_material(json::parse(text))); };
    EXPECT_THAT(said(R"({"pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1]}})"),
                HasSubstr("/materials/0/pbrMetallicRoughness/baseColorFactor: expected 4 numbers"));
    EXPECT_THAT(said(R"({"emissiveFactor": [1, 1, "x"]})"),
                HasSubstr("/materials/0/emissiveFactor/2: expected a number"));
    EXPECT_THAT(said(R"({"alphaMode": "GLASS"})"), HasSubstr("/materials/0/alphaMode: expected OPAQUE, MASK or BLEND"));
    EXPECT_THAT(said(R"({"normalTexture": {}})"),
                HasSubstr("/materials/0/normalTexture/index: expected a whole number"));
}

TEST(GltfMaterial, pictures_are_read_once_whoever_uses_them) {
    GltfDocument document = with_material(json::object());
    const std::size_t png = add_picture(document, picture_text::dot(9, 8, 7, 6));
    const std::size_t jpeg = add_picture(document, picture_text::jpeg({{153}}));
    add_picture(document, picture_text::dot(1, 1, 1));  // nobody uses it
    json& material = document.json["materials"][0];
    material["pbrMetallicRoughness"] = {{"baseColorTexture", {{"index", png}}},
                                        {"metallicRoughnessTexture", {{"index", jpeg}}}};
    material["emissiveTexture"] = {{"index", png}};
    material["normalTexture"] = {{"index", jpeg}, {"scale", 0.5}};
    const Scene scene = scene_in(document);
    ASSERT_EQ(scene.pictures.size(), 2U);
    EXPECT_THAT(scene.pictures[0].rgba, ElementsAre(9, 8, 7, 6));
    EXPECT_EQ(scene.pictures[1].width, 8U);
    EXPECT_NEAR(scene.pictures[1].rgba[0], 153, 1);
    EXPECT_EQ(only(scene).colour_picture, 0U);
    EXPECT_EQ(only(scene).roughness_picture, 1U);
    EXPECT_EQ(only(scene).normal_picture, 1U);
    EXPECT_EQ(only(scene).emission_picture, 0U);
    EXPECT_EQ(only(scene).normal_scale, 0.5F);
    EXPECT_THAT(scene.left_out, IsEmpty());
}

TEST(GltfMaterial, a_picture_that_cannot_be_read_is_named_and_the_colour_stays) {
    GltfDocument document = with_material(colour_picture({{"index", 0}}));
    document.json["materials"][0]["emissiveTexture"] = {{"index", 0}};
    document.json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {0.5, 0.5, 0.5, 1};
    std::string broken = picture_text::dot(9, 8, 7);
    broken.resize(broken.size() - 20);
    add_picture(document, broken);
    document.json["images"][0]["name"] = "iris";
    const Scene scene = scene_in(document);
    EXPECT_FALSE(only(scene).colour_picture || only(scene).emission_picture);
    EXPECT_EQ(only(scene).colour[0], 0.5F);
    EXPECT_THAT(scene.left_out, ElementsAre(HasSubstr("picture 0 'iris': png byte")));
}

TEST(GltfMaterial, pictures_in_other_formats_and_from_nowhere_are_named) {
    GltfDocument document = with_material(colour_picture({{"index", 0}}));
    add_picture(document, std::string("RIFF\0\0\0\0WEBPVP8 ", 16));
    EXPECT_THAT(scene_in(document).left_out, ElementsAre("picture 0: expected PNG or JPEG, found image/webp"));
    document.json["textures"][0] = {{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}};
    EXPECT_THAT(scene_in(document).left_out, ElementsAre("texture 0: it has no picture as PNG or JPEG"));
    document.json["textures"][0] = {{"source", 0}};
    document.json["images"][0] = {{"uri", "gone.png"}};
    EXPECT_THAT(scene_in(document).left_out, ElementsAre("picture 0: no file gone.png"));
}

// Each picture is 2048 x 2048 in 8 kB; together they are more than so few bytes may ask for.
TEST(GltfMaterial, many_large_pictures_in_few_bytes_are_not_all_unpacked) {
    GltfDocument document = with_material(colour_picture({{"index", 0}}));
    const picture_text::JpegKind grey{{128}, true, 2048, 2048};
    // 2048 x 2048 pixels are 65536 blocks of one bit each: 8192 bytes of zeros.
    std::string picture = picture_text::jpeg(grey);
    picture.insert(picture.size() - 2, std::string(8200, '\0'));
    for (int i = 0; i < 20; ++i) add_picture(document, picture);
    json& meshes = document.json["meshes"];
    for (std::size_t i = 1; i < 20; ++i) {
        document.json["materials"].push_back(colour_picture({{"index", i}}));
        meshes[0]["primitives"].push_back(meshes[0]["primitives"][0]);
        meshes[0]["primitives"][i]["material"] = i;
    }
    const Scene scene = scene_in(document);
    EXPECT_GE(scene.pictures.size(), 16U);
    EXPECT_LT(scene.pictures.size(), 20U);
    EXPECT_THAT(scene.left_out, Contains(HasSubstr("more pixels in all")));
}

std::vector<Vec2f> uvs(const json& info) {
    GltfDocument document = with_material(colour_picture(info));
    add_picture(document, picture_text::dot(9, 8, 7));
    const Scene scene = scene_in(document);
    EXPECT_THAT(scene.left_out, IsEmpty());
    return scene.surfaces.at(0).uvs;
}

json transformed(const json& transform) {
    return {{"index", 0}, {"extensions", {{"KHR_texture_transform", transform}}}};
}

TEST(GltfMaterial, texture_coordinates_are_those_that_the_pictures_use) {
    EXPECT_THAT(uvs({{"index", 0}}), ElementsAre(Vec2f{0, 0}, Vec2f{1, 0}, Vec2f{0.25F, 0.75F}));
    EXPECT_THAT(uvs({{"index", 0}, {"texCoord", 1}}), ElementsAre(Vec2f{0.5F, 0.5F}, Vec2f{0.5F, 1}, Vec2f{1, 1}));
    EXPECT_THAT(uvs(transformed({{"texCoord", 1}})), ElementsAre(Vec2f{0.5F, 0.5F}, Vec2f{0.5F, 1}, Vec2f{1, 1}));
    EXPECT_THAT(uvs({{"index", 0}, {"texCoord", 2}}), IsEmpty());
}

// The two examples of the extension's own text.
TEST(GltfMaterial, transformed_pictures_show_what_the_extension_says) {
    EXPECT_THAT(uvs(transformed({{"offset", {0, 1}}, {"scale", {1, -1}}})),
                ElementsAre(Vec2f{0, 1}, Vec2f{1, 1}, Vec2f{0.25F, 0.25F}));
    // "Only the lower left quadrant of the source image, rotated clockwise 90 degrees": the top left corner of the
    // surface shows the lower left corner of the picture, its top right corner the middle of the left edge.
    const std::vector<Vec2f> turned =
        uvs(transformed({{"offset", {0, 1}}, {"rotation", std::numbers::pi / 2}, {"scale", {0.5, 0.5}}}));
    EXPECT_NEAR(turned[0].x, 0, 1e-6);
    EXPECT_NEAR(turned[0].y, 1, 1e-6);
    EXPECT_NEAR(turned[1].x, 0, 1e-6);
    EXPECT_NEAR(turned[1].y, 0.5, 1e-6);
    EXPECT_NEAR(turned[2].x, 0.375, 1e-6);
    EXPECT_NEAR(turned[2].y, 0.875, 1e-6);
}

TEST(GltfMaterial, a_transform_scales_before_it_turns) {
    const std::vector<Vec2f> turned = uvs(transformed({{"rotation", std::numbers::pi / 2}, {"scale", {2, 1}}}));
    EXPECT_NEAR(turned[1].x, 0, 1e-6);
    EXPECT_NEAR(turned[1].y, -2, 1e-6);
}

TEST(GltfMaterial, pictures_that_lie_otherwise_than_the_first_are_left_out) {
    GltfDocument document = with_material(colour_picture(transformed({{"scale", {2, 2}}})));
    add_picture(document, picture_text::dot(9, 8, 7));
    document.json["materials"][0]["emissiveTexture"] = transformed({{"scale", {2, 2}}});
    document.json["materials"][0]["normalTexture"] = {{"index", 0}};
    document.json["materials"][0]["name"] = "skin";
    const Scene scene = scene_in(document);
    EXPECT_TRUE(only(scene).colour_picture && only(scene).emission_picture);
    EXPECT_FALSE(only(scene).normal_picture);
    EXPECT_EQ(scene.surfaces[0].uvs[1], (Vec2f{2, 0}));
    EXPECT_THAT(scene.left_out,
                ElementsAre("material 0 'skin': normalTexture, which lies otherwise than the pictures before it"));
}

TEST(GltfMaterial, coordinates_that_run_over_are_refused) {
    GltfDocument document = with_material(colour_picture(transformed({{"scale", {1e300, 1}}})));
    add_picture(document, picture_text::dot(9, 8, 7));
    EXPECT_THAT(refusal(document), HasSubstr("/meshes/0/primitives/0/attributes/TEXCOORD_0: expected finite"));
}

TEST(GltfMaterial, an_edge_that_holds_or_mirrors_is_named_where_it_shows) {
    for (const double scale : {1.0, 2.0}) {
        GltfDocument document = with_material(colour_picture(transformed({{"scale", {scale, 1}}})));
        add_picture(document, picture_text::dot(9, 8, 7));
        document.json["samplers"].push_back({{"wrapS", 33071}});
        document.json["textures"][0]["sampler"] = 0;
        const std::vector<std::string> left_out = scene_in(document).left_out;
        if (scale == 1)
            EXPECT_THAT(left_out, IsEmpty());
        else
            EXPECT_THAT(left_out,
                        ElementsAre("mesh 0, primitive 0: how material 0 goes on beyond the edge of its pictures"));
    }
}

TEST(GltfMaterial, what_a_material_has_besides_is_named) {
    json value =
        json::parse(R"({"name": "skin", "extensions": {"KHR_materials_clearcoat": {}, "KHR_materials_sheen": {}}})");
    GltfDocument document = with_material(value);
    document.json["materials"][0]["occlusionTexture"] = {{"index", 0}};
    add_picture(document, picture_text::dot(9, 8, 7));
    document.json["extensionsUsed"] = {"KHR_materials_clearcoat", "KHR_materials_sheen"};
    EXPECT_THAT(scene_in(document).left_out,
                ElementsAre("material 0 'skin': occlusionTexture", "material 0 'skin': 'KHR_materials_clearcoat'",
                            "material 0 'skin': 'KHR_materials_sheen'"));
}

TEST(GltfMaterial, every_changed_byte_is_refused_or_keeps_the_promise) {
    GltfDocument document = with_material(colour_picture(transformed({{"offset", {0.5, 0}}, {"rotation", 1}})));
    add_picture(document, picture_text::dot(9, 8, 7));
    add_picture(document, picture_text::jpeg({{153}}));
    document.json["materials"][0]["emissiveTexture"] = transformed({{"offset", {0.5, 0}}, {"rotation", 1}});
    document.json["materials"][0]["emissiveTexture"]["index"] = 1;
    const auto parse = [](std::span<const std::byte> bytes) { return parse_scene(bytes, no_file); };
    hostile::sweep(parse, glb_text(document), [](const Scene& scene) { return hostile::keeps_promise(scene); });
}

}  // namespace
}  // namespace mien
