// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/colour.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

namespace mien {
namespace {

struct Lab {
    double lightness, a, b;
};

double linear(std::uint8_t coded) {
    const double c = coded / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

// sRGB to OKLab, the direction that the library does not go (Ottosson 2020).
Lab oklab(const Colour& colour) {
    const double r = linear(colour.r), g = linear(colour.g), b = linear(colour.b);
    const double l = std::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
    const double m = std::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
    const double s = std::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
    return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
            1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
            0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

double distance(const Lab& p, const Lab& q) {
    return std::hypot(p.lightness - q.lightness, p.a - q.a, p.b - q.b);
}

TEST(HeatColour, takes_equal_steps_for_equal_differences_of_value) {
    std::vector<double> steps;
    steps.reserve(20);
    for (int i = 0; i < 20; ++i)
        steps.push_back(distance(oklab(colour_at(ColourScale::heat, i / 20.0)),
                                 oklab(colour_at(ColourScale::heat, (i + 1) / 20.0))));
    const auto [least, most] = std::minmax_element(steps.begin(), steps.end());
    EXPECT_GT(*least, 0.03);
    EXPECT_LT(*most / *least, 1.1);  // 8 bits round a step of 0.04 by up to 0.002
}

TEST(HeatColour, grows_lighter_all_the_way) {
    for (int i = 0; i < 64; ++i)
        EXPECT_LT(oklab(colour_at(ColourScale::heat, i / 64.0)).lightness,
                  oklab(colour_at(ColourScale::heat, (i + 1) / 64.0)).lightness)
            << i;
}

TEST(HeatColour, keeps_its_chroma_and_so_lies_inside_srgb) {
    for (int i = 0; i <= 64; ++i) {
        const Lab lab = oklab(colour_at(ColourScale::heat, i / 64.0));
        EXPECT_NEAR(std::hypot(lab.a, lab.b), 0.16, 0.008) << i;
    }
}

TEST(HeatColour, stops_at_its_ends_and_shows_what_is_no_number_in_grey) {
    EXPECT_EQ(colour_at(ColourScale::heat, -3), colour_at(ColourScale::heat, 0));
    EXPECT_EQ(colour_at(ColourScale::heat, std::numeric_limits<double>::infinity()), colour_at(ColourScale::heat, 1));
    EXPECT_EQ(colour_at(ColourScale::heat, std::nan("")), (Colour{128, 128, 128}));
}

TEST(ColourScale, OppositeIsLightestInTheMiddleAndDarkerTowardsBothEnds) {
    for (int i = 1; i <= 32; ++i)
        for (const double side : {-1.0, 1.0})
            EXPECT_GT(oklab(colour_at(ColourScale::opposite, 0.5 + side * (i - 1) / 64)).lightness,
                      oklab(colour_at(ColourScale::opposite, 0.5 + side * i / 64)).lightness);
    const Colour middle = colour_at(ColourScale::opposite, 0.5);
    EXPECT_EQ(middle.r, middle.b);
    EXPECT_GT(colour_at(ColourScale::opposite, 0).b, colour_at(ColourScale::opposite, 0).r);
    EXPECT_LT(colour_at(ColourScale::opposite, 1).b, colour_at(ColourScale::opposite, 1).r);
}

}  // namespace
}  // namespace mien
