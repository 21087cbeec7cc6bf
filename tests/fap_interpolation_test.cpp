// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/fap_interpolation.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

#include "refusal.hpp"

namespace mien {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

FitTarget copied(int fap, double times = 1) {
    return {fap, {{times, {1}, {}}}, {}};
}

std::string refusal(const FapInterpolation& fit) {
    return mien::refusal([&] { interpolated_faps(fit); });
}

std::array<std::int32_t, fap_count> values(std::initializer_list<std::pair<int, int>> amounts) {
    std::array<std::int32_t, fap_count> value{};
    for (const auto& [fap, amount] : amounts) value[fap_index(fap)] = amount;
    return value;
}

// (2 x^2 y - 5) / (1 + 3 y^2)
TEST(FapInterpolation, AValueIsThatOfTheRationalPolynomial) {
    const FitTarget target{5, {{2, {2, 1}, {}}, {-5, {}, {}}}, {{1, {}, {}}, {3, {0, 2}, {}}}};
    const FitLink link{{3, 14}, {target}};
    for (const int x : {-40, 0, 7, 100})
        for (const int y : {-3, 0, 1, 11}) {
            const double expected = (2.0 * x * x * y - 5) / (1 + 3.0 * y * y);
            EXPECT_EQ(interpolated_value(link, target, values({{3, x}, {14, y}})), std::lround(expected))
                << x << ' ' << y;
        }
}

TEST(FapInterpolation, HalvesAreRoundedAwayFromZero) {
    const FitTarget target = copied(5, 0.5);
    for (const auto& [source, expected] : {std::pair{3, 2}, {-3, -2}, {4, 2}, {1, 1}, {-1, -1}})
        EXPECT_EQ(interpolated_value({{3}, {target}}, target, values({{3, source}})), expected);
}

TEST(FapInterpolation, AnImpulseLetsATermCountAtOneValueAlone) {
    const FitTarget target{5, {{10, {0, 1}, FitImpulse{3, 7}}, {1, {0, 1}, {}}}, {}};
    const FitLink link{{3, 4}, {target}};
    EXPECT_EQ(interpolated_value(link, target, values({{3, 7}, {4, 20}})), 220);
    EXPECT_EQ(interpolated_value(link, target, values({{3, 8}, {4, 20}})), 20);
}

TEST(FapInterpolation, ADenominatorOfZeroOrAValueBeyond32BitsGivesNothing) {
    const FitTarget inverse{5, {{100, {}, {}}}, {{1, {1}, {}}}};
    const FitLink link{{3}, {inverse}};
    EXPECT_EQ(interpolated_value(link, inverse, values({{3, 4}})), 25);
    EXPECT_EQ(interpolated_value(link, inverse, values({})), std::nullopt);
    const FitTarget zero_by_zero{5, {{1, {1}, {}}}, {{1, {1}, {}}}};
    EXPECT_EQ(interpolated_value(link, zero_by_zero, values({})), std::nullopt);
    constexpr std::int32_t most = std::numeric_limits<std::int32_t>::max();
    for (const int sign : {-1, 1}) {
        EXPECT_EQ(interpolated_value(link, copied(5), values({{3, sign * most}})), sign * most);
        EXPECT_EQ(interpolated_value(link, copied(5, 1.01), values({{3, sign * most}})), std::nullopt);
    }
    const FitTarget huge{5, {{1e308, {15}, {}}, {-1e308, {15}, {}}}, {}};  // infinite, less infinite
    EXPECT_EQ(interpolated_value(link, huge, values({{3, most}})), std::nullopt);
}

TEST(FapInterpolation, ParametersComeAfterAllThatTheyMayFollowFrom) {
    EXPECT_THAT(interpolated_faps({}), ElementsAre());
    const FapInterpolation fit{
        {{{8}, {copied(4)}}, {{31}, {copied(8), copied(68)}}, {{68}, {copied(8)}}, {{9}, {copied(4)}}}};
    EXPECT_THAT(interpolated_faps(fit), ElementsAre(68, 8, 4));
}

TEST(FapInterpolation, AChainThatLeadsBackIsRefusedAndNamed) {
    EXPECT_THAT(refusal({{{{31}, {copied(32)}}, {{32}, {copied(31)}}}}), HasSubstr("31 -> 32 -> 31"));
    const FapInterpolation around{{{{3}, {copied(6)}},
                                   {{6}, {copied(7)}},
                                   {{7, 9}, {{8, {{1, {}, {}}}, {}}}},
                                   {{8}, {copied(6)}},
                                   {{8}, {copied(4)}}}};
    const std::string sentence = refusal(around);
    EXPECT_THAT(sentence, HasSubstr("fit /links: "));
    EXPECT_THAT(sentence, testing::AnyOf(HasSubstr("6 -> 7 -> 8 -> 6"), HasSubstr("7 -> 8 -> 6 -> 7"),
                                         HasSubstr("8 -> 6 -> 7 -> 8")));
}

TEST(FapInterpolation, WhatBreaksItsPromiseIsRefusedAtItsPlace) {
    const auto expect_refused = [](const FitLink& link, const char* place) {
        EXPECT_THAT(refusal({{{{31}, {copied(32)}}, link}}), HasSubstr(std::string("fit /links/1") + place));
    };
    const auto with_term = [](const FitTerm& term) { return FitLink{{3, 4}, {{5, {term}, {}}}}; };
    for (const int fap : {-1, 0, 1, 2, 69, 1 << 30}) {
        expect_refused({{fap}, {copied(5)}}, "/from/0: ");
        expect_refused({{3}, {copied(5), copied(fap)}}, "/to/1/fap: ");
    }
    expect_refused({{3, 3}, {copied(5)}}, "/from/1: ");
    expect_refused({{3}, {copied(5), copied(5)}}, "/to/1/fap: ");
    expect_refused({{3}, {copied(3)}}, "/to/0/fap: ");
    expect_refused({{}, {copied(3)}}, "/from: ");
    expect_refused({{3}, {}}, "/to: ");
    expect_refused({{3}, {{5, {}, {}}}}, "/to/0/numerator: ");
    expect_refused({{3}, {{5, std::vector<FitTerm>(11, {1, {}, {}}), {}}}}, "/to/0/numerator: ");
    expect_refused({{3}, {{5, {{1, {}, {}}}, std::vector<FitTerm>(11, {1, {}, {}})}}}, "/to/0/denominator: ");
    expect_refused({{3}, {{5, {{1, {}, {}}}, {{1, {}, FitImpulse{3, 0}}}}}}, "/to/0/denominator: ");
    expect_refused(with_term({1, {1}, {}}), "/to/0/numerator/0/exponents: ");
    expect_refused(with_term({1, {1, -1}, {}}), "/to/0/numerator/0/exponents: ");
    expect_refused(with_term({1, {1, 16}, {}}), "/to/0/numerator/0/exponents: ");
    expect_refused(with_term({std::numeric_limits<double>::infinity(), {}, {}}), "/to/0/numerator/0/coefficient: ");
    expect_refused(with_term({std::numeric_limits<double>::quiet_NaN(), {}, {}}), "/to/0/numerator/0/coefficient: ");
    expect_refused(with_term({1, {}, FitImpulse{6, 0}}), "/to/0/numerator/0/impulse/fap: ");
    EXPECT_THAT(refusal({std::vector<FitLink>(1025, {{31}, {copied(32)}})}), HasSubstr("fit /links: "));
    EXPECT_EQ(refusal({{with_term({1, {0, 15}, FitImpulse{4, -9}})}}), "");
}

}  // namespace
}  // namespace mien
