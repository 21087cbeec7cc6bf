// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/io/jpeg.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/hostile.hpp"
#include "io/picture_text.hpp"
#include "io/text.hpp"

namespace mien {
namespace {

using picture_text::jpeg;
using testing::HasSubstr;

// Every pixel of the picture within one of this colour, which is as exact as the standard asks decoders to be.
void expect_colour(const std::string& text, double red, double green, double blue) {
    const Picture picture = parse_jpeg(as_bytes(text));
    ASSERT_EQ(picture.rgba.size(), std::size_t{4} * picture.width * picture.height);
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
        EXPECT_NEAR(picture.rgba[i], red, 1);
        EXPECT_NEAR(picture.rgba[i + 1], green, 1);
        EXPECT_NEAR(picture.rgba[i + 2], blue, 1);
        EXPECT_EQ(picture.rgba[i + 3], 255);
    }
}

TEST(Jpeg, what_is_no_picture_is_refused_by_a_sentence) {
    EXPECT_THAT(hostile::refusal(parse_jpeg, ""), testing::MatchesRegex("jpeg byte 0: expected a picture, .*"));
    EXPECT_THAT(hostile::refusal(parse_jpeg, "no picture at all"), HasSubstr("jpeg byte"));
    const std::string whole = jpeg({{160}});
    EXPECT_THAT(hostile::refusal(parse_jpeg, whole.substr(0, whole.size() - 4)), HasSubstr("the end of the file"));
    EXPECT_THAT(hostile::refusal(parse_jpeg, jpeg({{160, 160, 160, 160}})), HasSubstr("4 inks"));
}

TEST(Jpeg, a_size_that_the_bytes_cannot_hold_is_refused_before_memory_is_taken) {
    EXPECT_THAT(hostile::refusal(parse_jpeg, jpeg({{160}, false, 65000, 65000})), HasSubstr("at most 67108864 pixels"));
    EXPECT_THAT(hostile::refusal(parse_jpeg, jpeg({{160}, true, 4000, 4000})), HasSubstr("4000 x 4000"));
}

TEST(Jpeg, a_file_that_goes_over_its_pixels_again_and_again_is_refused) {
    EXPECT_THAT(hostile::refusal(parse_jpeg, jpeg({{160}, true, 8, 8, 1000})), HasSubstr("scans"));
}

TEST(Jpeg, every_prefix_and_every_changed_byte_is_refused_or_a_picture) {
    const auto promise = [](const Picture& picture) { return hostile::keeps_promise(picture); };
    hostile::sweep(parse_jpeg, jpeg({{160, 150, 170}}), promise);
    hostile::sweep(parse_jpeg, jpeg({{180}, true}), promise);
}

TEST(Jpeg, a_picture_in_one_ink_is_grey) {
    expect_colour(jpeg({{128}}), 128, 128, 128);
    expect_colour(jpeg({{153}}), 153, 153, 153);
    expect_colour(jpeg({{180}, true}), 180, 180, 180);
    EXPECT_EQ(parse_jpeg(as_bytes(jpeg({{153}, false, 5, 3}))).width, 5U);
    EXPECT_EQ(parse_jpeg(as_bytes(jpeg({{153}, false, 5, 3}))).height, 3U);
}

// ITU T.871: R = Y + 1.402 (Cr - 128), G = Y - 0.344136 (Cb - 128) - 0.714136 (Cr - 128), B = Y + 1.772 (Cb - 128).
TEST(Jpeg, brightness_and_two_differences_are_colours) {
    for (const bool progressive : {false, true}) {
        expect_colour(jpeg({{150, 128, 178}, progressive}), 150 + 1.402 * 50, 150 - 0.714136 * 50, 150);
        expect_colour(jpeg({{150, 158, 128}, progressive}), 150, 150 - 0.344136 * 30, 150 + 1.772 * 30);
    }
}

TEST(Jpeg, the_same_bytes_are_the_same_picture) {
    const std::string text = jpeg({{170, 150, 144}});
    EXPECT_EQ(parse_jpeg(as_bytes(text)).rgba, parse_jpeg(as_bytes(text)).rgba);
}

}  // namespace
}  // namespace mien
