// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Parameters against displacement fields that were drawn by hand, one per parameter, on a head made for MPEG-4.

#include <gtest/gtest.h>

#include "obadiah_figures.hpp"

namespace mien {
namespace {

// Two of its fields go against the standard, as its description says: stretched corners of the inner lips go inwards.
bool is_inverted(int fap) {
    return fap == 6 || fap == 7;
}

TEST(FapFigures, EveryParameterMovesAHandMadeHeadAlongTheAxisAndInTheDirectionThatWereDrawn) {
    if (!obadiah::is_there()) GTEST_SKIP() << "the head is not there";
    const obadiah::Subject subject = obadiah::read_subject();
    std::size_t compared = 0;
    for (int fap = 3; fap <= 68; ++fap) {
        const auto agreement = obadiah::compare(subject, fap);
        if (!agreement) continue;
        ++compared;
        EXPECT_TRUE(agreement->same_axis) << fap_info(fap).name;
        EXPECT_EQ(agreement->same_sign, !is_inverted(fap)) << fap_info(fap).name;
        EXPECT_EQ(agreement->cosine > 0, !is_inverted(fap)) << fap_info(fap).name;
    }
    EXPECT_EQ(compared, 50U);
}

}  // namespace
}  // namespace mien
