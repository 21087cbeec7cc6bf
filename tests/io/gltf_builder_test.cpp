// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "io/gltf_builder.hpp"

#include <gmock/gmock.h>

#include "io/gltf_player.hpp"
#include "io/gltf_unused.hpp"

#include "mien/error.hpp"

namespace mien {
namespace {

using nlohmann::json;
using testing::ElementsAre;

TEST(Builder, arrays_are_made_when_missing_and_everything_has_the_index_it_got) {
    GltfDocument document;
    EXPECT_EQ(append_object(document, "nodes", {{"name", "a"}}), 0U);
    EXPECT_EQ(append_object(document, "nodes", {{"name", "b"}}), 1U);
    EXPECT_EQ(document.json["nodes"][1]["name"], "b");
}

TEST(Builder, views_begin_at_multiples_of_four) {
    GltfDocument document;
    const std::vector<std::byte> five(5, std::byte{7});
    append_view(document, five, BufferTarget::none);
    append_view(document, five, BufferTarget::indices);
    const json& views = document.json["bufferViews"];
    EXPECT_EQ(views[1]["byteOffset"], 8);
    EXPECT_EQ(views[1]["byteLength"], 5);
    EXPECT_EQ(views[1]["target"], 34963);
    EXPECT_FALSE(views[0].contains("target"));
    EXPECT_EQ(document.binary.size(), 13U);
    EXPECT_EQ(document.binary[6], std::byte{0});
}

TEST(Builder, numbers_lie_as_they_were_given_with_the_bounds_of_each_component) {
    GltfDocument document;
    append_bytes(document, std::vector<std::uint8_t>{1, 2, 3, 250}, Elements::vec4, BufferTarget::vertices);
    const std::vector<Vec3f> points{{1, 5, -2}, {-1, 7, 0.5F}};
    const std::size_t accessor = append_vectors(document, points, BufferTarget::vertices, Bounds::given);
    EXPECT_EQ(accessor, 1U);
    EXPECT_THAT(played::numbers(document, accessor), ElementsAre(1, 5, -2, -1, 7, 0.5));
    EXPECT_THAT(played::numbers(document, 0), ElementsAre(1, 2, 3, 250));
    EXPECT_EQ(document.json["accessors"][1]["min"], json({-1.0, 5.0, -2.0}));
    EXPECT_EQ(document.json["accessors"][1]["max"], json({1.0, 7.0, 0.5}));
    EXPECT_EQ(document.json["accessors"][1]["count"], 2);
    EXPECT_FALSE(document.json["accessors"][0].contains("min"));
}

TEST(Builder, indices_are_shorts_until_one_would_restart_the_primitive) {
    GltfDocument document;
    const std::size_t narrow = append_indices(document, std::vector<std::uint32_t>{0, 65534, 1});
    const std::size_t wide = append_indices(document, std::vector<std::uint32_t>{0, 65535, 1});
    EXPECT_EQ(document.json["accessors"][narrow]["componentType"], 5123);
    EXPECT_EQ(document.json["accessors"][wide]["componentType"], 5125);
    EXPECT_THAT(played::numbers(document, narrow), ElementsAre(0, 65534, 1));
    EXPECT_THAT(played::numbers(document, wide), ElementsAre(0, 65535, 1));
}

// Two accessors of which a primitive uses the second, and a picture.
GltfDocument half_used() {
    GltfDocument document;
    append_floats(document, std::vector<float>{1, 2, 3}, Elements::vec3, BufferTarget::vertices);
    const std::size_t used =
        append_floats(document, std::vector<float>{4, 5, 6}, Elements::vec3, BufferTarget::vertices);
    const std::size_t picture = append_view(document, std::vector(3, std::byte{42}), BufferTarget::none);
    append_object(document, "images", {{"bufferView", picture}});
    json mesh;
    mesh["primitives"].push_back(json::object());
    mesh["primitives"][0]["attributes"]["POSITION"] = used;
    append_object(document, "meshes", mesh);
    return document;
}

TEST(Unused, accessors_views_and_bytes_go_and_the_rest_is_renumbered) {
    GltfDocument document = half_used();
    drop_unused_numbers(document);
    EXPECT_EQ(document.json["accessors"].size(), 1U);
    EXPECT_EQ(document.json["bufferViews"].size(), 2U);
    EXPECT_EQ(document.binary.size(), 15U);
    const json& position = document.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"];
    EXPECT_THAT(played::numbers(document, position), ElementsAre(4, 5, 6));
    const json& view = document.json["bufferViews"][document.json["images"][0]["bufferView"].get<std::size_t>()];
    EXPECT_EQ(document.binary.at(view["byteOffset"].get<std::size_t>()), std::byte{42});
}

TEST(Unused, numbers_that_are_written_with_a_fraction_of_zero_or_a_sign_refer_as_well) {
    for (const json& one : {json(1.0), json(std::int64_t{1})}) {
        GltfDocument document = half_used();
        json& position = document.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"];
        position = one;
        drop_unused_numbers(document);
        EXPECT_THAT(played::numbers(document, position.get<std::size_t>()), ElementsAre(4, 5, 6));
    }
}

TEST(Unused, a_number_that_an_extension_gives_beyond_the_list_is_refused) {
    GltfDocument document = half_used();
    append_object(document, "nodes", {{"extensions", {{"KHR_picture", {{"bufferView", 99U}}}}}});
    EXPECT_THROW(drop_unused_numbers(document), Error);
}

TEST(Unused, nothing_goes_when_an_extension_may_number_accessors_in_its_own_way) {
    GltfDocument document = half_used();
    document.json["extensionsUsed"] = json::array();
    document.json["extensionsUsed"].push_back("ACME_points");
    drop_unused_numbers(document);
    EXPECT_EQ(document.json["accessors"].size(), 2U);
}

TEST(Unused, views_that_share_their_bytes_do_not_blow_up_the_buffer) {
    GltfDocument document = half_used();
    for (int i = 0; i < 100; ++i) {
        json view = document.json["bufferViews"][1];
        append_object(document, "images", {{"bufferView", append_object(document, "bufferViews", view)}});
    }
    const std::size_t before = document.binary.size();
    drop_unused_numbers(document);
    EXPECT_EQ(document.binary.size(), before);
    const json& position = document.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"];
    EXPECT_THAT(played::numbers(document, position), ElementsAre(4, 5, 6));
}

}  // namespace
}  // namespace mien
