// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "io/text.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "io/hostile.hpp"

namespace mien {
namespace {

TEST(Text, a_number_takes_the_whole_word_or_nothing) {
    EXPECT_EQ(parse_double("-1.5e2"), -150.0);
    EXPECT_EQ(parse_double("+3"), 3.0);
    for (const char* word : {"", "+", "1,5", "1.5x", "0x10", "+-1", "++1", " 1", "--1", "e5"})
        EXPECT_EQ(parse_double(word), std::nullopt) << word;
    EXPECT_EQ(parse_integer("-12"), -12);
    for (const char* word : {"1.0", "", "99999999999999999999", "1e3"})
        EXPECT_EQ(parse_integer(word), std::nullopt) << word;
}

TEST(Text, numbers_out_of_range_are_infinite_or_zero) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(std::abs(*parse_double("1e999")), infinity);
    EXPECT_EQ(parse_double("1e-999"), 0.0);
    EXPECT_EQ(parse_double("0." + std::string(400, '0') + "1"), 0.0);
    EXPECT_EQ(parse_double("1" + std::string(400, '0')), infinity);
    EXPECT_TRUE(std::isinf(*parse_float("1e39")));
    EXPECT_EQ(parse_float("1e-300"), 0.0F);
    EXPECT_EQ(parse_float("1e-45"), std::numeric_limits<float>::denorm_min());
    EXPECT_EQ(parse_double("4.9e-324"), std::numeric_limits<double>::denorm_min());
    EXPECT_TRUE(std::isnan(*parse_float("NaN")));
}

TEST(Text, written_numbers_read_back_equal) {
    for (const double number : {0.1, 1.0 / 3, -2.5e-300, 1.7976931348623157e308, 1448841600.0333333}) {
        std::string text;
        append_number(text, number);
        EXPECT_EQ(parse_double(text), number) << text;
    }
    std::string text;
    append_number(text, 0.1F);
    EXPECT_EQ(text, "0.1");
}

TEST(Text, numbers_do_not_depend_on_the_locale) {
    const hostile::CommaLocale locale;
    if (!locale.there) GTEST_SKIP() << "no locale with a decimal comma is installed";
    EXPECT_EQ(parse_double("1.5"), 1.5);
    EXPECT_EQ(parse_double("1,5"), std::nullopt);
    std::string text;
    append_number(text, 1.5);
    EXPECT_EQ(text, "1.5");
}

TEST(Text, lines_end_at_lf_or_cr_lf_and_know_their_number) {
    Lines lines(
        "\xef\xbb\xbf"
        "a\r\nb\n\nc",
        "x");
    ASSERT_TRUE(lines.next());
    EXPECT_EQ(lines.line(), "a");
    ASSERT_TRUE(lines.next());
    ASSERT_TRUE(lines.next_filled());
    EXPECT_EQ(lines.line(), "c");
    EXPECT_EQ(lines.number(), 4U);
    EXPECT_FALSE(lines.next());
}

TEST(Text, what_was_found_is_shown_short_and_printable) {
    EXPECT_EQ(shown(""), "nothing");
    EXPECT_EQ(shown("a\x01\n"),
              "'a?"
              "?'");
    EXPECT_EQ(shown(std::string(100, 'x')), "'" + std::string(40, 'x') + "...'");
}

TEST(Text, quoted_cells_hold_commas_and_doubled_quotes) {
    EXPECT_EQ(comma_cells("a, \"b,\"\"c\" ,"), (std::vector<std::string>{"a", "b,\"c", ""}));
    EXPECT_EQ(comma_cells("a,\"b"), std::nullopt);
}

}  // namespace
}  // namespace mien
