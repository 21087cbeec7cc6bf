// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "io/gltf_document.hpp"

#include <gmock/gmock.h>
#include <map>

#include "io/gltf_text.hpp"
#include "io/hostile.hpp"
#include "refusal.hpp"

namespace mien {
namespace {

using namespace gltf_text;
using testing::HasSubstr;

// Files beside the document, and how often each was asked for.
struct Folder {
    std::map<std::string, std::string, std::less<>> files;
    std::map<std::string, int, std::less<>> asked;

    std::vector<std::byte> fetch(std::string_view uri) {
        const auto found = files.find(uri);
        if (found == files.end()) throw Error("no file " + std::string(uri));
        ++asked[found->first];
        const auto bytes = as_bytes(found->second);
        return {bytes.begin(), bytes.end()};
    }
};

GltfDocument load(const json& root, Folder& folder) {
    return load_gltf(as_bytes(root.dump()), [&](std::string_view uri) { return folder.fetch(uri); });
}

std::string refusal(const json& root) {
    Folder none;
    return mien::refusal([&] { load(root, none); });
}

std::string_view view_text(const GltfDocument& document, std::size_t view) {
    const json& value = document.json["bufferViews"][view];
    return as_text(document.binary)
        .substr(value["byteOffset"].get<std::size_t>(), value["byteLength"].get<std::size_t>());
}

json with_buffer_uri(const std::string& uri, std::size_t size) {
    json root = empty_json();
    root["buffers"] = json::array({{{"uri", uri}, {"byteLength", size}}});
    root["bufferViews"] = json::array({{{"buffer", 0}, {"byteLength", size}}});
    return root;
}

TEST(LoadGltf, RefusesOtherVersionsAndTypes) {
    EXPECT_THAT(refusal(json::object()), HasSubstr("/asset: expected an object, found none"));
    EXPECT_THAT(refusal({{"asset", {{"version", "1.0"}}}}), HasSubstr("/asset/version: expected 2.0, found '1.0'"));
    json root = empty_json();
    root["meshes"] = 5;
    EXPECT_THAT(refusal(root), HasSubstr("/meshes: expected an array, found '5'"));
    root["meshes"] = {5};
    EXPECT_THAT(refusal(root), HasSubstr("/meshes/0: expected an object, found '5'"));
}

TEST(LoadGltf, RefusesRequiredExtensionsByName) {
    json root = empty_json();
    root["extensionsRequired"] = {"KHR_materials_unlit", "X_strange"};
    EXPECT_THAT(refusal(root), HasSubstr("/extensionsRequired/1: expected an extension that is supported"));
    EXPECT_THAT(refusal(root), HasSubstr("X_strange"));
}

TEST(LoadGltf, RefusesReferencesToWhatIsNotThere) {
    const std::map<std::string, json> bad{
        {"/scene", {{"scene", 0}}},
        {"/nodes/0/children/0", {{"nodes", {{{"children", {7}}}}}}},
        {"/materials/0/normalTexture/index", {{"materials", {{{"normalTexture", {{"index", 0}}}}}}}},
        {"/meshes/0/primitives/0/attributes/A~1B", {{"meshes", {{{"primitives", {{{"attributes", {{"A/B", 1}}}}}}}}}}},
        {"/animations/0/channels/0/sampler", {{"animations", {{{"channels", {{{"sampler", 0}}}}}}}}},
        {"/nodes/0/mesh", {{"nodes", {{{"mesh", -1}}}}}},
        {"/nodes/0/skin", {{"nodes", {{{"skin", 0.5}}}}}},
    };
    for (const auto& [pointer, members] : bad) {
        json root = empty_json();
        root.update(members);
        EXPECT_THAT(refusal(root), HasSubstr("gltf " + pointer + ": expected"));
    }
}

TEST(LoadGltf, RefusesViewsThatEndBehindTheirBuffer) {
    for (const std::uint64_t offset : {std::uint64_t{1}, std::uint64_t{1} << 53}) {
        json root = with_buffer_uri("data:;base64,AAAAAA==", 4);
        root["bufferViews"][0]["byteOffset"] = offset;
        EXPECT_THAT(refusal(root), HasSubstr("/bufferViews/0: expected an end at most at byte 4"));
    }
    json root = with_buffer_uri("data:;base64,AAAAAA==", 4);
    root["bufferViews"][0]["byteOffset"] = std::uint64_t{0xFFFFFFFFFFFFFFFC};
    EXPECT_THAT(refusal(root), HasSubstr("/bufferViews/0/byteOffset: expected a whole number"));
}

TEST(LoadGltf, RefusesABufferThatPromisesMoreThanIsThere) {
    EXPECT_THAT(refusal(with_buffer_uri("data:;base64,AAAAAA==", 5)),
                HasSubstr("/buffers/0/byteLength: expected at most the 4 bytes that are there, found 5"));
}

TEST(LoadGltf, RefusesUrisOfOtherPlaces) {
    for (const char* uri : {"", "/dev/zero", "file:///etc/passwd", "http://127.0.0.1/x.bin", "\\\\host\\x", "a%00b"})
        EXPECT_THAT(refusal(with_buffer_uri(uri, 4)), HasSubstr("/buffers/0/uri: expected a relative uri")) << uri;
}

TEST(LoadGltf, RefusesWhatIsNoBase64) {
    for (const char* uri : {"data:;base64,!!!!", "data:;base64,AAAAA", "data:;base64,AA=A", "data:,abcd", "data:"})
        EXPECT_THAT(refusal(with_buffer_uri(uri, 3)), HasSubstr("/buffers/0/uri: expected")) << uri;
}

TEST(LoadGltf, ReadsDataUrisOfEveryLength) {
    for (const std::string text : {"f", "fo", "foo", "foob", "fooba", "foobar"}) {
        Folder folder;
        const std::string uri = "data:application/octet-stream;base64," + base64(as_bytes(text));
        EXPECT_EQ(view_text(load(with_buffer_uri(uri, text.size()), folder), 0), text);
    }
    Folder folder;  // the examples of RFC 4648
    EXPECT_EQ(view_text(load(with_buffer_uri("data:;base64,Zm9vYg==", 4), folder), 0), "foob");
    EXPECT_EQ(view_text(load(with_buffer_uri("data:;base64,Zm9vYmE", 5), folder), 0), "fooba");
}

TEST(LoadGltf, MergesAllBuffersAtMultiplesOfFourBytes) {
    Folder folder{{{"a b.bin", "12345"}, {"c.bin", "abcdefgh"}}, {}};
    json root = with_buffer_uri("a%20b.bin", 5);
    root["buffers"].push_back({{"uri", "c.bin"}, {"byteLength", 8}});
    root["bufferViews"].push_back({{"buffer", 1}, {"byteOffset", 4}, {"byteLength", 3}});
    const GltfDocument document = load(root, folder);
    EXPECT_EQ(view_text(document, 0), "12345");
    EXPECT_EQ(view_text(document, 1), "efg");
    EXPECT_EQ(document.json["bufferViews"][1]["byteOffset"], 12);
    EXPECT_EQ(document.json["bufferViews"][1]["buffer"], 0);
    ASSERT_EQ(document.json["buffers"].size(), 1U);
    EXPECT_FALSE(document.json["buffers"][0].contains("uri"));
}

TEST(LoadGltf, FetchesAFileOnceHoweverOftenItIsNamed) {
    Folder folder{{{"a.bin", "12345678"}}, {}};
    json root = with_buffer_uri("a.bin", 8);
    for (int i = 0; i < 9; ++i) root["buffers"].push_back(root["buffers"][0]);
    EXPECT_EQ(load(root, folder).binary.size(), 8U);
    EXPECT_EQ(folder.asked["a.bin"], 1);
}

TEST(LoadGltf, SaysWhatTheFetchSaysOfAFileThatIsNotThere) {
    EXPECT_EQ(refusal(with_buffer_uri("gone.bin", 4)), "no file gone.bin");
}

TEST(LoadGltf, TakesPicturesInByTheirFirstBytes) {
    Folder folder{{{"skin.jpg", "\x89PNG\r\n\x1a\nrest"}, {"b", "\xff\xd8\xff\xe0"}, {"c.txt", "no picture"}}, {}};
    json root = empty_json();
    root["images"] = json::array({{{"uri", "skin.jpg"}}, {{"uri", "b"}}, {{"uri", "c.txt"}}});
    const GltfDocument document = load(root, folder);
    const json& images = document.json["images"];
    EXPECT_EQ(images[0]["mimeType"], "image/png");
    EXPECT_EQ(images[1]["mimeType"], "image/jpeg");
    EXPECT_EQ(images[2]["mimeType"], "application/octet-stream");
    EXPECT_FALSE(images[0].contains("uri"));
    EXPECT_EQ(view_text(document, images[0]["bufferView"].get<std::size_t>()), folder.files["skin.jpg"]);
    EXPECT_EQ(view_text(document, images[2]["bufferView"].get<std::size_t>()), "no picture");
}

// Three pictures of which the middle one is not there, each with a texture, and a material that names all three.
json three_pictures() {
    json root = empty_json();
    root["images"] = json::array({{{"uri", "a.png"}}, {{"uri", "gone.png"}, {"name", "iris"}}, {{"uri", "c.png"}}});
    for (int i = 0; i < 3; ++i) root["textures"].push_back({{"source", i}});
    root["materials"].push_back(
        {{"emissiveTexture", {{"index", 0}}},
         {"normalTexture", {{"index", 2}}},
         {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 1}}}, {"roughnessFactor", 0.5}}},
         {"extensions", {{"KHR_materials_clearcoat", {{"clearcoatTexture", {{"index", 1}}}}}}}});
    return root;
}

TEST(LoadGltf, GoesWithoutAPictureThatIsNotThereAndSaysSo) {
    Folder folder{{{"a.png", "\x89PNG\r\n\x1a\nA"}, {"c.png", "\x89PNG\r\n\x1a\nC"}}, {}};
    const GltfDocument document = load(three_pictures(), folder);
    EXPECT_THAT(document.left_out, testing::ElementsAre("picture 1 'iris': no file gone.png"));
    ASSERT_EQ(document.json["images"].size(), 2U);
    EXPECT_EQ(view_text(document, document.json["images"][1]["bufferView"].get<std::size_t>()), folder.files["c.png"]);
    EXPECT_EQ(document.json["textures"], json::parse(R"([{"source": 0}, {}, {"source": 1}])"));
    EXPECT_EQ(document.json["materials"][0],
              json::parse(R"({"emissiveTexture": {"index": 0}, "normalTexture": {"index": 2},
        "pbrMetallicRoughness": {"roughnessFactor": 0.5}, "extensions": {"KHR_materials_clearcoat": {}}})"));
}

TEST(LoadGltf, KeepsATextureWhosePictureIsThereInAnotherFormat) {
    Folder folder{{{"a.png", "\x89PNG\r\n\x1a\nA"}, {"c.png", "RIFF1234WEBP"}}, {}};
    json root = three_pictures();
    root["textures"][1]["extensions"]["EXT_texture_webp"]["source"] = 2;
    root["textures"][2]["extensions"]["EXT_texture_webp"]["source"] = 1;
    const GltfDocument document = load(root, folder);
    EXPECT_EQ(document.json["textures"][1], json::parse(R"({"extensions": {"EXT_texture_webp": {"source": 1}}})"));
    EXPECT_EQ(document.json["textures"][2], json::parse(R"({"source": 1})"));
    EXPECT_EQ(document.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"], 1);
}

TEST(LoadGltf, GoesWithoutPicturesWhoseUriLeadsNowhere) {
    for (const char* uri : {"data:image/png,plain", "http://there/a.png", "/etc/a.png", "data:;base64,"}) {
        Folder folder;
        json root = empty_json();
        root["images"].push_back({{"uri", uri}});
        const GltfDocument document = load(root, folder);
        EXPECT_EQ(document.left_out.size(), 1U) << uri;
        EXPECT_FALSE(document.json.contains("images")) << uri;
    }
}

TEST(LoadGltf, DropsAFallbackBufferAndMovesWhatIsCompressed) {
    Folder folder{{{"a.bin", "0000"}, {"packed.bin", "12345678"}}, {}};
    json root = with_buffer_uri("a.bin", 4);
    root["buffers"].push_back({{"uri", "packed.bin"}, {"byteLength", 8}});
    root["buffers"].push_back(
        {{"byteLength", 1 << 30}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
    const json packed{{"buffer", 1}, {"byteOffset", 2}, {"byteLength", 6}};
    root["bufferViews"].push_back({{"buffer", 2},
                                   {"byteOffset", 64},
                                   {"byteLength", 4096},
                                   {"extensions", {{"EXT_meshopt_compression", packed}}}});
    const GltfDocument document = load(root, folder);
    EXPECT_EQ(document.binary.size(), 12U);
    const json& view = document.json["bufferViews"][1];
    EXPECT_EQ(view["byteLength"], 4096);
    EXPECT_EQ(view["extensions"]["EXT_meshopt_compression"]["byteOffset"], 6);
    EXPECT_EQ(view["extensions"]["EXT_meshopt_compression"]["buffer"], 0);
}

TEST(LoadGltf, RefusesPlainViewsOfAFallbackBuffer) {
    json root = with_buffer_uri("data:;base64,AAAA", 3);
    root["buffers"].push_back({{"byteLength", 8}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
    root["bufferViews"].push_back({{"buffer", 1}, {"byteLength", 8}});
    EXPECT_THAT(refusal(root), HasSubstr("/bufferViews/1: expected an extension EXT_meshopt_compression"));
}

// A view of four bytes that are there, another of a buffer that is nowhere, and an accessor for each.
json half_there() {
    json root = with_buffer_uri("data:;base64,Zm9vYg==", 4);
    root["buffers"].push_back({{"byteLength", 4}});
    const json nowhere{{"buffer", 1}, {"byteLength", 4}};
    root["bufferViews"].insert(root["bufferViews"].begin(), nowhere);
    const json numbers = {{"type", "SCALAR"}, {"componentType", 5126}, {"count", 1}};
    for (const std::size_t view : {0U, 1U}) {
        root["accessors"].push_back(numbers);
        root["accessors"].back()["bufferView"] = view;
    }
    root["meshes"] = json::array({{{"primitives", json::array({{{"attributes", {{"_USED", 1U}}}}})}}});
    return root;
}

TEST(LoadGltf, RefusesViewsOfABufferThatIsNowhere) {
    json root = half_there();
    root["meshes"][0]["primitives"][0]["attributes"]["_USED"] = 0U;
    EXPECT_THAT(refusal(root), HasSubstr("/bufferViews/0/buffer: expected a buffer with bytes"));
    root = half_there();
    root["images"] = json::array({{{"bufferView", 0U}, {"mimeType", "image/png"}}});
    EXPECT_THAT(refusal(root), HasSubstr("/bufferViews/0/buffer: expected a buffer with bytes"));
    root = half_there();
    root["extensionsUsed"] = json::array({"ACME_points"});
    EXPECT_THAT(refusal(root), HasSubstr("/bufferViews/0/buffer: expected a buffer with bytes"));
}

TEST(LoadGltf, LeavesOutViewsOfABufferThatIsNowhereWhenNothingIsMadeOfThem) {
    Folder folder;
    const GltfDocument document = load(half_there(), folder);
    ASSERT_EQ(document.json["bufferViews"].size(), 1U);
    EXPECT_EQ(view_text(document, 0), "foob");
    ASSERT_EQ(document.json["accessors"].size(), 1U);
    EXPECT_EQ(document.json["accessors"][0]["bufferView"], 0);
    EXPECT_EQ(document.json["meshes"][0]["primitives"][0]["attributes"]["_USED"], 0);
}

TEST(LoadGltf, RefusesExtensionsThatAreNoList) {
    for (const json& bad : {json("EXT_meshopt_compression"), json(5), json::object()}) {
        json root = empty_json();
        root["extensionsUsed"] = bad;
        EXPECT_THAT(refusal(root), HasSubstr("/extensionsUsed: expected an array"));
    }
}

}  // namespace
}  // namespace mien
