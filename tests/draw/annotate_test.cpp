// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/draw/annotate.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include "mien/error.hpp"

// What fontconfig has read of its settings it keeps to the end of the program, which the leak check takes for lost.
// NOLINTBEGIN(bugprone-reserved-identifier, readability-identifier-naming)
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
    return "leak:libfontconfig";
}
// NOLINTEND(bugprone-reserved-identifier, readability-identifier-naming)

namespace mien {
namespace {

constexpr Colour white = {255, 255, 255}, black = {0, 0, 0};

Picture plain(std::uint32_t width, std::uint32_t height, const Colour& colour = white) {
    Picture picture{width, height, {}};
    for (std::uint32_t p = 0; p < width * height; ++p)
        picture.rgba.insert(picture.rgba.end(), {colour.r, colour.g, colour.b, colour.a});
    return picture;
}

Colour pixel(const Picture& picture, std::size_t x, std::size_t y) {
    const std::uint8_t* p = &picture.rgba.at(4 * (y * picture.width + x));
    return {p[0], p[1], p[2], p[3]};
}

// How much ink lies on a white picture: 1 for a black pixel; and the middle of it.
struct Ink {
    double sum = 0, x = 0, y = 0;
    double left = 1e9, right = -1, top = 1e9, bottom = -1;  // edges of what is touched
};

Ink ink(const Picture& picture) {
    Ink result;
    for (std::uint32_t y = 0; y < picture.height; ++y)
        for (std::uint32_t x = 0; x < picture.width; ++x) {
            const double dark = 1 - pixel(picture, x, y).g / 255.0;
            if (dark == 0) continue;
            result.sum += dark;
            result.x += dark * (x + 0.5);
            result.y += dark * (y + 0.5);
            result.left = std::min<double>(result.left, x);
            result.right = std::max<double>(result.right, x + 1);
            result.top = std::min<double>(result.top, y);
            result.bottom = std::max<double>(result.bottom, y + 1);
        }
    result.x /= result.sum;
    result.y /= result.sum;
    return result;
}

TEST(DrawMarker, covers_the_area_of_a_disc_around_its_place) {
    Picture picture = plain(40, 40);
    draw_marker(picture, {18.3F, 21.6F}, {.radius = 6, .fill = black, .rim = {0, 0, 0, 0}});
    const Ink found = ink(picture);
    EXPECT_NEAR(found.sum, 3.14159265 * 36, 0.6);
    EXPECT_NEAR(found.x, 18.3, 0.05);
    EXPECT_NEAR(found.y, 21.6, 0.05);
}

TEST(DrawMarker, has_a_rim_of_a_third_of_its_radius) {
    Picture picture = plain(40, 40, {90, 90, 90});
    draw_marker(picture, {20.5F, 20.5F}, {.radius = 9, .fill = {255, 0, 0}, .rim = {0, 0, 255}});
    EXPECT_EQ(pixel(picture, 20, 20), (Colour{255, 0, 0}));
    EXPECT_EQ(pixel(picture, 25, 20), (Colour{255, 0, 0}));
    EXPECT_EQ(pixel(picture, 28, 20), (Colour{0, 0, 255}));
    EXPECT_EQ(pixel(picture, 31, 20), (Colour{90, 90, 90}));
}

TEST(DrawLine, covers_its_length_times_its_width_and_its_round_ends) {
    Picture picture = plain(80, 60);
    draw_line(picture, {20, 15}, {50, 45}, {.width = 5, .ink = black});
    const Ink found = ink(picture);
    EXPECT_NEAR(found.sum, 5 * std::hypot(30, 30) + 3.14159265 * 2.5 * 2.5, 1.5);
    EXPECT_NEAR(found.x, 35, 0.05);
    EXPECT_NEAR(found.y, 30, 0.05);
}

TEST(DrawLabel, lies_between_its_place_and_its_width_by_its_alignment) {
    for (const auto& [align, share] : {std::pair{Align::left, 0.0}, {Align::middle, 0.5}, {Align::right, 1.0}}) {
        Picture picture = plain(300, 60);
        const LabelStyle style{.size = 20, .align = align, .ink = black};
        draw_label(picture, {150, 30}, "Heads", style);
        const double width = label_width("Heads", style), left = 150 - share * width;
        EXPECT_GE(ink(picture).left, std::floor(left));
        EXPECT_LE(ink(picture).right, std::ceil(left + width));
        EXPECT_GT(ink(picture).right - ink(picture).left, 0.85 * width);
    }
}

TEST(DrawLabel, centres_capitals_on_the_height_of_its_place) {
    Picture picture = plain(120, 60);
    draw_label(picture, {10, 30}, "HEH", {.size = 24, .ink = black});
    EXPECT_NEAR((ink(picture).top + ink(picture).bottom) / 2, 30, 1);
}

TEST(DrawLabel, scales_with_its_size) {
    EXPECT_NEAR(label_width("caption", {.size = 40}), 4 * label_width("caption", {.size = 10}), 0.5);
    EXPECT_GT(label_width("caption", {.bold = true}), label_width("caption"));
    EXPECT_EQ(label_width(""), 0);
}

TEST(DrawLabel, is_moved_with_its_place_by_whole_pixels) {
    Picture here = plain(100, 40), there = plain(100, 40);
    draw_label(here, {10, 20}, "8.4", {.ink = black});
    draw_label(there, {17, 20}, "8.4", {.ink = black});
    for (std::size_t y = 0; y < 40; ++y)
        for (std::size_t x = 0; x < 90; ++x) ASSERT_EQ(pixel(here, x, y), pixel(there, x + 7, y)) << x << ' ' << y;
}

TEST(DrawLabel, parts_its_letters_from_the_picture_by_a_halo) {
    Picture bare = plain(60, 40, black), rimmed = bare;
    draw_label(bare, {10, 20}, "8.4", {.ink = black});
    draw_label(rimmed, {10, 20}, "8.4", {.ink = black, .halo = white});
    EXPECT_EQ(bare.rgba, plain(60, 40, black).rgba);
    EXPECT_NE(rimmed.rgba, bare.rgba);
}

TEST(DrawLabel, shows_text_that_is_no_utf8_with_question_marks) {
    Picture wrong = plain(100, 40), asked = plain(100, 40);
    draw_label(wrong, {10, 20},
               "a\xff"
               "b");
    draw_label(asked, {10, 20}, "a?b");
    EXPECT_EQ(wrong.rgba, asked.rgba);
    EXPECT_GT(ink(wrong).sum, 1);
}

TEST(Drawing, changes_nothing_outside_the_picture_or_at_no_place) {
    const float nan = std::nanf(""), infinity = std::numeric_limits<float>::infinity();
    Picture picture = plain(30, 20);
    const std::vector<std::uint8_t> before = picture.rgba;
    for (const Vec2f& at : {Vec2f{-200, 10}, {10, 500}, {nan, 10}, {10, infinity}, {3e6F, 3e6F}}) {
        draw_label(picture, at, "text");
        draw_marker(picture, at);
        draw_line(picture, at, at);
        draw_legend(picture, at, {.width = 50});
    }
    EXPECT_EQ(picture.rgba, before);
    Picture none;
    draw_label(none, {0, 0}, "text");
    draw_legend(none, {0, 0}, {});
    EXPECT_TRUE(none.rgba.empty());
}

TEST(Drawing, cuts_marks_at_the_edges_of_the_picture) {
    Picture whole = plain(60, 60), corner = plain(30, 30);
    for (Picture* picture : {&whole, &corner}) {
        draw_marker(*picture, {29, 29}, {.radius = 8});
        draw_label(*picture, {10, 28}, "edge");
        draw_line(*picture, {5, 5}, {50, 40});
    }
    for (std::size_t y = 0; y < 30; ++y)
        for (std::size_t x = 0; x < 30; ++x)
            for (std::size_t c = 0; c < 4; ++c)  // cut outlines round otherwise
                ASSERT_NEAR(corner.rgba[4 * (y * 30 + x) + c], whole.rgba[4 * (y * 60 + x) + c], 16) << x << ' ' << y;
}

TEST(Drawing, over_a_transparent_picture_keeps_its_own_colour) {
    Picture glass = plain(20, 20, {0, 255, 0, 0});
    draw_marker(glass, {10, 10}, {.radius = 6, .fill = {200, 100, 50, 128}, .rim = {0, 0, 0, 0}});
    const Colour middle = pixel(glass, 10, 10);
    EXPECT_NEAR(middle.r, 200, 1);
    EXPECT_NEAR(middle.g, 100, 1);
    EXPECT_EQ(middle.a, 128);
}

TEST(DrawPoints, puts_each_name_where_it_covers_no_other_mark) {
    // Two rows of dots so near that names to the right alone would run over the next dot.
    std::vector<Vec2f> places;
    std::vector<std::string> names;
    for (int i = 0; i < 5; ++i) {
        places.push_back({60.0F + 16.0F * static_cast<float>(i), 60});
        names.push_back("8." + std::to_string(i));
    }
    const PointsStyle style{.label = {.size = 10, .ink = black}};
    Picture all = plain(220, 120), dots = plain(220, 120);
    draw_points(all, places, names, style);
    for (const Vec2f& place : places) draw_marker(dots, place, style.marker);
    double letters = 0;
    for (const std::string& name : names) {
        Picture one = plain(60, 30);
        draw_label(one, {5, 15}, name, style.label);
        letters += ink(one).sum;
    }
    EXPECT_NEAR(ink(all).sum, ink(dots).sum + letters, 0.02 * letters);
}

TEST(DrawPoints, wants_a_name_for_each_place) {
    Picture picture = plain(10, 10);
    EXPECT_THROW(draw_points(picture, std::vector<Vec2f>(2), std::vector<std::string>(1)), Error);
}

TEST(DrawLegend, goes_from_the_lowest_colour_to_the_highest) {
    Picture picture = plain(400, 40);
    draw_legend(picture, {100, 15}, {.low = 0, .high = 3.5, .unit = "mm", .width = 200, .height = 10});
    EXPECT_EQ(pixel(picture, 100, 15), colour_at(ColourScale::heat, 0));
    EXPECT_EQ(pixel(picture, 299, 24), colour_at(ColourScale::heat, 1));
    EXPECT_EQ(pixel(picture, 300, 24), white);
    EXPECT_EQ(pixel(picture, 200, 14), white);
    for (std::size_t x = 0; x < 200; ++x)
        ASSERT_EQ(pixel(picture, 100 + x, 20), colour_at(ColourScale::heat, static_cast<double>(x) / 199)) << x;
}

TEST(DrawLegend, writes_its_ends_outside_the_bar) {
    Picture picture = plain(400, 40);
    draw_legend(picture, {100, 15}, {.low = 0, .high = 3.5, .unit = "mm", .width = 200, .height = 10});
    Picture before = plain(100, 40), behind = plain(100, 40);
    for (std::size_t y = 0; y < 40; ++y)
        for (std::size_t x = 0; x < 100; ++x)
            for (std::size_t c = 0; c < 3; ++c) {
                before.rgba[4 * (y * 100 + x) + c] = picture.rgba[4 * (y * 400 + x) + c];
                behind.rgba[4 * (y * 100 + x) + c] = picture.rgba[4 * (y * 400 + 300 + x) + c];
            }
    EXPECT_NEAR(ink(before).right, 100 - 6.5, 2);
    EXPECT_NEAR(ink(behind).left, 6.5, 2);
    EXPECT_NEAR(ink(behind).right - ink(behind).left, label_width("3.5 mm"), 3);
}

}  // namespace
}  // namespace mien
