// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/render/look.hpp"

#include <gtest/gtest.h>
#include <limits>

namespace mien {
namespace {

double lightness(const Colour& c) {
    return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
}

TEST(ColourScale, HeatGetsLighterAllTheWay) {
    for (int i = 0; i < 100; ++i)
        EXPECT_LT(lightness(colour_at(ColourScale::heat, i / 100.0)),
                  lightness(colour_at(ColourScale::heat, (i + 1) / 100.0)));
}

TEST(ColourScale, OppositeIsLightestInTheMiddle) {
    for (int i = 1; i <= 50; ++i)
        for (const int side : {-1, 1})
            EXPECT_GT(lightness(colour_at(ColourScale::opposite, 0.5 + side * (i - 1) / 100.0)),
                      lightness(colour_at(ColourScale::opposite, 0.5 + side * i / 100.0)));
}

TEST(ColourScale, SharesBeyondTheEndsAreHeldThere) {
    for (const ColourScale scale : {ColourScale::heat, ColourScale::opposite}) {
        EXPECT_EQ(colour_at(scale, -3), colour_at(scale, 0));
        EXPECT_EQ(colour_at(scale, 3), colour_at(scale, 1));
        EXPECT_EQ(colour_at(scale, std::numeric_limits<double>::quiet_NaN()), colour_at(scale, 0));
    }
}

}  // namespace
}  // namespace mien
