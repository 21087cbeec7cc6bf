// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "io/glb.hpp"

#include <cstring>
#include <gmock/gmock.h>

#include "io/gltf_text.hpp"
#include "io/hostile.hpp"

namespace mien {
namespace {

using namespace gltf_text;
using testing::HasSubstr;

std::string refusal(const std::string& text) {
    return hostile::refusal(parse_glb, text);
}

// A number of the container changed.
std::string with_number(std::string text, std::size_t at, std::uint32_t number) {
    std::memcpy(text.data() + at, &number, sizeof number);
    return text;
}

std::string chunk(const std::string& type, const std::string& content) {
    return with_number(std::string(4, '\0'), 0, static_cast<std::uint32_t>(content.size())) + type + content;
}

std::string container(const std::string& chunks) {
    const std::string header("glTF\x02\0\0\0....", 12);
    return with_number(header, 8, static_cast<std::uint32_t>(12 + chunks.size())) + chunks;
}

const std::string bin_type("BIN\0", 4);

TEST(ParseGlb, RefusesEveryDamageToTheContainerWithASentence) {
    hostile::sweep(parse_glb, glb_text(triangle()), [](const GltfDocument& d) { return d.json.is_object(); });
}

TEST(ParseGlb, NamesTheByteOfAWrongHeader) {
    const std::string good = glb_text(triangle());
    EXPECT_THAT(refusal(with_number(good, 0, 0x20202020)), HasSubstr("glb byte 0: expected \"glTF\""));
    EXPECT_THAT(refusal(with_number(good, 4, 3)), HasSubstr("glb byte 4: expected version 2, found 3"));
    EXPECT_THAT(refusal(with_number(good, 8, 0xFFFFFFFF)), HasSubstr("glb byte 8: expected a length"));
}

TEST(ParseGlb, NamesTheByteOfAWrongChunk) {
    const std::string good = glb_text(triangle());
    EXPECT_THAT(refusal(with_number(good, 12, 0xFFFFFFFC)), HasSubstr("glb byte 12: expected a chunk of at most"));
    EXPECT_THAT(refusal(with_number(good, 16, 0x004E4942)), HasSubstr("glb byte 16: expected a JSON chunk first"));
    EXPECT_THAT(refusal(container(chunk("JSON", "{}  ") + chunk("ABCD", "") + chunk(bin_type, "abcd"))),
                HasSubstr("glb byte 36: expected one JSON and one BIN chunk"));
}

TEST(ParseGlb, LeavesOutChunksThatItDoesNotKnow) {
    const GltfDocument document =
        parse_glb(as_bytes(container(chunk("JSON", "{}  ") + chunk(bin_type, "abcd") + chunk("ABCD", "efgh"))));
    EXPECT_EQ(as_text(document.binary), "abcd");
}

TEST(ParseGlb, LeavesOutWhatFollowsTheContainer) {
    EXPECT_EQ(parse_glb(as_bytes(glb_text(triangle()) + "more")).json, triangle().json);
}

TEST(ParseGltfJson, RefusesAnythingElseThanAnObject) {
    EXPECT_THAT(hostile::refusal(parse_gltf_json, "[1]"), HasSubstr("expected an object"));
    EXPECT_THAT(hostile::refusal(parse_gltf_json, std::string(100000, '[')), HasSubstr("64"));
}

TEST(FormatGlb, ReadsBackAsTheSameDocument) {
    const GltfDocument document = triangle();
    const GltfDocument again = parse_glb(format_glb(document));
    EXPECT_EQ(again.json, document.json);
    EXPECT_EQ(again.binary, document.binary);
}

TEST(FormatGlb, PadsBothChunksToFourBytes) {
    for (std::size_t size = 1; size < 9; ++size) {
        GltfDocument document = empty();
        document.binary.assign(size, std::byte{7});
        document.json["x"] = std::string(size, 'y');
        const std::vector<std::byte> bytes = format_glb(document);
        EXPECT_EQ(bytes.size() % 4, 0U);
        const GltfDocument again = parse_glb(bytes);
        EXPECT_EQ(again.json["buffers"][0]["byteLength"], size);
        EXPECT_EQ(again.binary.size(), (size + 3) / 4 * 4);
    }
}

TEST(FormatGlb, WritesNoBufferWithoutBytes) {
    GltfDocument document = empty();
    document.json["buffers"] = json::array({{{"byteLength", 4}}});
    EXPECT_FALSE(parse_glb(format_glb(document)).json.contains("buffers"));
}

}  // namespace
}  // namespace mien
