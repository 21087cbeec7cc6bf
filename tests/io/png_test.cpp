// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/io/png.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/hostile.hpp"
#include "io/picture_text.hpp"
#include "io/text.hpp"

namespace mien {
namespace {

using picture_text::big_endian;
using picture_text::bytes_of;
using picture_text::chunk;
using picture_text::png;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<int> pixels(const std::string& text) {
    const Picture picture = parse_png(as_bytes(text));
    return {picture.rgba.begin(), picture.rgba.end()};
}

TEST(Png, what_is_no_picture_is_refused_by_a_sentence) {
    EXPECT_THAT(hostile::refusal(parse_png, ""), HasSubstr("signature"));
    EXPECT_THAT(hostile::refusal(parse_png, "GIF89a, and more behind it"), HasSubstr("signature"));
    std::string broken = picture_text::dot(1, 2, 3);
    broken[broken.size() - 20] ^= 1;
    EXPECT_THAT(hostile::refusal(parse_png, broken), testing::MatchesRegex("png byte [0-9]+: expected a picture, .*"));
}

TEST(Png, a_size_that_the_bytes_cannot_hold_is_refused_before_memory_is_taken) {
    EXPECT_THAT(hostile::refusal(parse_png, png({1U << 14U, 1U << 13U}, "")), HasSubstr("at most 67108864 pixels"));
    EXPECT_THAT(hostile::refusal(parse_png, png({8000, 8000}, "")), HasSubstr("8000 x 8000"));
    EXPECT_THAT(hostile::refusal(parse_png, png({0xffffffffU, 0xffffffffU}, "")), HasSubstr("png"));
    EXPECT_THAT(hostile::refusal(parse_png, png({0, 1}, "")), HasSubstr("png"));
}

TEST(Png, every_prefix_and_every_changed_byte_is_refused_or_a_picture) {
    const auto promise = [](const Picture& picture) { return hostile::keeps_promise(picture); };
    hostile::sweep(parse_png, png({2, 2, 8, 2}, bytes_of({0, 1, 2, 3, 4, 5, 6, 1, 9, 8, 7, 6, 5, 4})), promise);
    hostile::sweep(parse_png, png({3, 1, 1, 3}, bytes_of({0, 0xa0}), chunk("PLTE", bytes_of({1, 2, 3, 4, 5, 6}))),
                   promise);
}

TEST(Png, red_green_blue_and_alpha_come_row_by_row_from_the_top) {
    const std::string text = png({1, 2}, bytes_of({0, 1, 2, 3, 4, 0, 250, 251, 252, 253}));
    EXPECT_THAT(pixels(text), ElementsAre(1, 2, 3, 4, 250, 251, 252, 253));
    EXPECT_EQ(parse_png(as_bytes(text)).width, 1U);
    EXPECT_EQ(parse_png(as_bytes(text)).height, 2U);
}

TEST(Png, without_alpha_a_picture_is_opaque) {
    EXPECT_THAT(pixels(png({1, 1, 8, 2}, bytes_of({0, 9, 8, 7}))), ElementsAre(9, 8, 7, 255));
    EXPECT_THAT(pixels(png({2, 1, 8, 0}, bytes_of({0, 9, 200}))), ElementsAre(9, 9, 9, 255, 200, 200, 200, 255));
    EXPECT_THAT(pixels(png({1, 1, 8, 4}, bytes_of({0, 9, 77}))), ElementsAre(9, 9, 9, 77));
}

TEST(Png, a_palette_and_its_clear_entries_are_colours) {
    const std::string palette = chunk("PLTE", bytes_of({1, 2, 3, 4, 5, 6})) + chunk("tRNS", bytes_of({128}));
    EXPECT_THAT(pixels(png({2, 1, 1, 3}, bytes_of({0, 0x40}), palette)), ElementsAre(1, 2, 3, 128, 4, 5, 6, 255));
}

TEST(Png, one_bit_is_black_or_white_and_sixteen_are_rounded_to_eight) {
    EXPECT_THAT(pixels(png({2, 1, 1, 0}, bytes_of({0, 0x40}))), ElementsAre(0, 0, 0, 255, 255, 255, 255, 255));
    // Of 65535, 0x8100 is 128.498 of 255 and 0x8101 is 128.502.
    EXPECT_THAT(pixels(png({1, 1, 16, 2}, bytes_of({0, 0x81, 0x00, 0x81, 0x01, 0xff, 0xff}))),
                ElementsAre(128, 129, 255, 255));
}

// Adam7: the first pixel in the first pass, its neighbour in the sixth, the second row in the seventh.
TEST(Png, an_interlaced_picture_is_the_same_picture) {
    const std::string text = png({2, 2, 8, 0, 1}, bytes_of({0, 10, 0, 20, 0, 30, 40}));
    const Picture picture = parse_png(as_bytes(text));
    EXPECT_THAT((std::vector<int>{picture.rgba[0], picture.rgba[4], picture.rgba[8], picture.rgba[12]}),
                ElementsAre(10, 20, 30, 40));
}

TEST(Png, what_a_file_says_of_its_colour_space_changes_nothing) {
    const std::string gamma = chunk("gAMA", big_endian(100000, 4)) + chunk("iCCP", "broken") + chunk("tEXt", "a");
    EXPECT_THAT(pixels(png({1, 1, 8, 2}, bytes_of({0, 9, 80, 170}), gamma)), ElementsAre(9, 80, 170, 255));
}

Picture pattern(std::uint32_t width, std::uint32_t height, bool opaque) {
    Picture picture{width, height, {}};
    for (std::uint32_t i = 0; i < 4 * width * height; ++i)
        picture.rgba.push_back(static_cast<std::uint8_t>(opaque && i % 4 == 3 ? 255U : i * i / 7));
    return picture;
}

TEST(Png, what_is_written_is_read_back) {
    for (const bool opaque : {true, false}) {
        const Picture picture = pattern(37, 11, opaque);
        const std::vector<std::byte> bytes = format_png(picture);
        const Picture back = parse_png(bytes);
        EXPECT_EQ(back.width, 37U);
        EXPECT_EQ(back.height, 11U);
        EXPECT_EQ(back.rgba, picture.rgba);
        EXPECT_EQ(format_png(picture), bytes);
        EXPECT_EQ(static_cast<int>(bytes[25]), opaque ? 2 : 6) << "the kind of colour";
    }
}

TEST(Png, a_picture_whose_numbers_do_not_fit_its_size_is_not_written) {
    EXPECT_THROW(format_png({}), Error);
    EXPECT_THROW(format_png({2, 2, std::vector<std::uint8_t>(15)}), Error);
    EXPECT_THROW(format_png({0, 2, {}}), Error);
}

}  // namespace
}  // namespace mien
