// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/draw/sheet.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vector>

#include "mien/error.hpp"

namespace mien {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

const Colour paper = SheetOptions{}.paper;
constexpr std::size_t line = 19;  // 1.4 sizes of 13 pixels, rounded up

// A picture in which every pixel tells its place and the number of its picture.
Picture coded(std::uint32_t width, std::uint32_t height, std::uint8_t number) {
    Picture picture{width, height, {}};
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x)
            picture.rgba.insert(picture.rgba.end(),
                                {static_cast<std::uint8_t>(x), static_cast<std::uint8_t>(y), number, 255});
    return picture;
}

std::vector<Picture> numbered(std::uint8_t count, std::uint32_t width = 60, std::uint32_t height = 40) {
    std::vector<Picture> pictures;
    for (std::uint8_t n = 0; n < count; ++n) pictures.push_back(coded(width, height, n));
    return pictures;
}

Colour pixel(const Picture& picture, std::size_t x, std::size_t y) {
    const std::uint8_t* p = &picture.rgba.at(4 * (y * picture.width + x));
    return {p[0], p[1], p[2], p[3]};
}

// Whether a picture lies there whole, with nothing over it.
bool holds(const Picture& sheet, const Picture& picture, std::size_t left, std::size_t top) {
    for (std::size_t y = 0; y < picture.height; ++y)
        for (std::size_t x = 0; x < picture.width; ++x)
            if (!(pixel(sheet, left + x, top + y) == pixel(picture, x, y))) return false;
    return true;
}

// How many pixels of a rectangle are not the paper's.
std::size_t inked(const Picture& sheet, std::size_t left, std::size_t top, std::size_t width, std::size_t height) {
    std::size_t count = 0;
    for (std::size_t y = top; y < top + height; ++y)
        for (std::size_t x = left; x < left + width; ++x) count += pixel(sheet, x, y) == paper ? 0 : 1;
    return count;
}

bool margin_is_clean(const Picture& sheet) {
    constexpr std::size_t m = 20;  // letters may reach a little into the margin of 24
    return inked(sheet, 0, 0, sheet.width, m) + inked(sheet, 0, sheet.height - m, sheet.width, m) +
               inked(sheet, 0, 0, m, sheet.height) + inked(sheet, sheet.width - m, 0, m, sheet.height) ==
           0;
}

TEST(ContactSheet, of_bare_pictures_is_as_large_as_its_cells_gaps_and_margins) {
    const std::vector<Picture> pictures = numbered(7);
    const Picture sheet = contact_sheet(pictures, {}, {.columns = 3});
    EXPECT_EQ(sheet.width, 2 * 24 + 3 * 60 + 2 * 12U);
    EXPECT_EQ(sheet.height, 2 * 24 + 3 * 40 + 2 * 12U);
    for (std::size_t p = 0; p < 7; ++p) EXPECT_TRUE(holds(sheet, pictures[p], 24 + p % 3 * 72, 24 + p / 3 * 52)) << p;
    EXPECT_EQ(inked(sheet, 0, 0, sheet.width, sheet.height), 7 * 60 * 40U);
}

TEST(ContactSheet, writes_captions_below_their_pictures_and_never_over_them) {
    const std::vector<Picture> pictures = numbered(4);
    const std::vector<std::string> captions = {"one", "a caption of many words", "two\nlines", "unbreakablylongword"};
    const Picture sheet = contact_sheet(pictures, captions, {.columns = 4});
    std::size_t lines = (sheet.height - 48 - 40) / line;
    EXPECT_EQ(sheet.height, 48 + 40 + lines * line);
    EXPECT_GE(lines, 3U);
    std::size_t in_cells = 0;
    for (std::size_t p = 0; p < 4; ++p) {
        EXPECT_TRUE(holds(sheet, pictures[p], 24 + p * 72, 24)) << p;
        EXPECT_GT(inked(sheet, 24 + p * 72, 64, 60, lines * line), 20U) << p;
        in_cells += inked(sheet, 22 + p * 72, 64, 64, lines * line);
    }
    EXPECT_EQ(in_cells + std::size_t{4} * 60 * 40, inked(sheet, 0, 0, sheet.width, sheet.height));
}

TEST(ContactSheet, keeps_room_by_the_longest_caption_of_a_row) {
    const std::vector<std::string> captions = {"1", "1\n2\n3", "1", "1"};
    const Picture sheet = contact_sheet(numbered(4), captions, {.columns = 2});
    EXPECT_EQ(sheet.height, 48 + (40 + 3 * line) + 12 + (40 + line));
    EXPECT_TRUE(holds(sheet, coded(60, 40, 2), 24, 24 + 40 + 3 * line + 12));
}

TEST(ContactSheet, centres_smaller_pictures_in_cells_of_the_largest) {
    const std::vector<Picture> pictures = {coded(60, 20, 0), coded(30, 50, 1)};
    const Picture sheet = contact_sheet(pictures, {}, {.columns = 2});
    EXPECT_EQ(sheet.height, 48 + 50U);
    EXPECT_TRUE(holds(sheet, pictures[0], 24, 24 + 15));
    EXPECT_TRUE(holds(sheet, pictures[1], 24 + 72 + 15, 24));
}

TEST(ContactSheet, shows_the_paper_through_pictures_that_are_not_opaque) {
    Picture glass = coded(10, 10, 0);
    for (std::size_t i = 3; i < glass.rgba.size(); i += 4) glass.rgba[i] = 0;
    const Picture sheet = contact_sheet(std::vector<Picture>{glass}, {});
    EXPECT_EQ(inked(sheet, 0, 0, sheet.width, sheet.height), 0U);
}

TEST(ContactSheet, chooses_columns_for_the_shape_of_three_to_two) {
    for (const std::uint8_t count : {std::uint8_t{1}, std::uint8_t{6}, std::uint8_t{24}, std::uint8_t{61}}) {
        const Picture sheet = contact_sheet(numbered(count, 40, 40), {}, {.margin = 0, .gap = 0});
        const double shape = static_cast<double>(sheet.width) / sheet.height;
        EXPECT_GE(shape, 0.99) << int{count};
        EXPECT_LE(shape, 2.1) << int{count};
    }
    EXPECT_EQ(contact_sheet(numbered(6, 40, 40), {}, {.margin = 0, .gap = 0}).width, 120U);
}

TEST(ContactSheet, sets_title_note_and_legend_inside_the_margins) {
    const std::vector<Picture> pictures = numbered(6);
    const Picture bare = contact_sheet(pictures, {}, {.columns = 3});
    const Picture sheet = contact_sheet(
        pictures, {},
        {.columns = 3, .title = "A title\nof two lines", .note = "and a note", .legend = Legend{0, 2, "mm", 80, 10}});
    EXPECT_EQ(sheet.width, bare.width);
    EXPECT_GT(sheet.height, bare.height + 3 * line);
    EXPECT_TRUE(margin_is_clean(sheet));
    const std::size_t top = 24 + 2 * 28 + line + 12;  // two lines of the title in 19.5 pixels, the note, a gap
    for (std::size_t p = 0; p < 6; ++p) EXPECT_TRUE(holds(sheet, pictures[p], 24 + p % 3 * 72, top + p / 3 * 52)) << p;
    EXPECT_GT(inked(sheet, 24, top + 92, sheet.width - 48, sheet.height - 24 - top - 92), 80 * 10U);
}

TEST(ContactSheet, is_the_same_bytes_twice) {
    const std::vector<std::string> captions(4, "caption");
    EXPECT_EQ(contact_sheet(numbered(4), captions).rgba, contact_sheet(numbered(4), captions).rgba);
}

TEST(ContactSheet, refuses_what_makes_no_sheet) {
    const std::vector<std::string> two = {"a", "b"};
    EXPECT_THAT([] { contact_sheet({}, {}); }, ThrowsMessage<Error>(HasSubstr("at least one picture")));
    EXPECT_THAT([&] { contact_sheet(numbered(3), two); }, ThrowsMessage<Error>(HasSubstr("each of 3 pictures")));
    EXPECT_THAT(
        [] {
            contact_sheet(std::vector<Picture>{{4, 4, {1, 2, 3}}}, {});
        },
        ThrowsMessage<Error>(HasSubstr("4 x 4 pixels of picture 1 in 64 bytes, found 3")));
    EXPECT_THAT([] { contact_sheet(numbered(1), {}, {.margin = 20000}); }, ThrowsMessage<Error>(HasSubstr("32767")));
}

TEST(Beside, is_a_sheet_of_two_columns) {
    const Picture sheet = beside(coded(60, 40, 0), coded(60, 40, 1), std::vector<std::string>{"a", "b"});
    EXPECT_EQ(sheet.width, 48 + 60 + 12 + 60U);
    EXPECT_EQ(sheet.height, 48 + 40 + line);
    EXPECT_TRUE(holds(sheet, coded(60, 40, 1), 96, 24));
}

TEST(Grid, puts_the_picture_of_row_and_column_where_their_names_meet) {
    const std::vector<Picture> pictures = numbered(6);
    const GridNames names{{"jawOpen", "browOuterUp (held)"}, {"truth", "RBF", "ours"}, {}};
    const Picture sheet = grid(pictures, names);
    const std::size_t left = sheet.width - 24 - 3 * 60 - 2 * 12, top = 24 + line;
    EXPECT_GT(left, 24U);
    EXPECT_EQ(sheet.height, top + 40 + 12 + 40 + 24);
    for (std::size_t p = 0; p < 6; ++p)
        EXPECT_TRUE(holds(sheet, pictures[p], left + p % 3 * 72, top + p / 3 * 52)) << p;
    for (std::size_t c = 0; c < 3; ++c) EXPECT_GT(inked(sheet, left + c * 72, 24, 60, line), 20U) << c;
    for (std::size_t r = 0; r < 2; ++r) EXPECT_GT(inked(sheet, 24, top + r * 52, left - 24, 40), 20U) << r;
    EXPECT_TRUE(margin_is_clean(sheet));
}

TEST(Grid, makes_a_row_as_high_as_its_name) {
    const std::vector<std::string> rows = {"1\n2\n3\n4\n5\n6", "1"};
    const Picture sheet = grid(numbered(2), {.rows = rows, .columns = {"a"}});
    EXPECT_EQ(sheet.height, 48 + line + 6 * line + 12 + 40);
    EXPECT_TRUE(margin_is_clean(sheet));
}

TEST(Grid, wants_rows_times_columns) {
    EXPECT_THAT(
        [] {
            grid(numbered(5), {.rows = {"a", "b"}, .columns = {"c", "d", "e"}});
        },
        ThrowsMessage<Error>(HasSubstr("2 rows by 3 columns, found 5")));
    EXPECT_THROW(grid({}, {}), Error);
}

}  // namespace
}  // namespace mien
