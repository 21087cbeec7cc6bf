// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/io/fit.hpp"

#include <array>
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>

#include "io/hostile.hpp"

namespace mien {
namespace {

using testing::HasSubstr;

constexpr std::string_view forms = R"({"_about": "forms", "links": [
    {"from": [3, 14], "to": [
        {"fap": 5, "numerator": [{"coefficient": -0.5, "exponents": [1, 0]}]},
        {"fap": 18, "numerator": [{"coefficient": 40, "impulse": {"fap": 14, "value": -2}},
                                  {"coefficient": 1e-3, "exponents": [2, 1]}],
                    "denominator": [{"coefficient": 1}, {"coefficient": 0.1, "exponents": [0, 2], "_": 1}]}]},
    {"from": [5], "to": [{"fap": 52, "numerator": [{"coefficient": 1, "exponents": [1]}]}]}]})";

FapInterpolation parse(std::string_view text) {
    return parse_fit(hostile::Copy(text).bytes());
}

std::string refusal(std::string_view text) {
    return hostile::refusal(parse_fit, text);
}

// A table of one link to one parameter, with some text in place of its numerator.
std::string with_numerator(std::string_view numerator) {
    return R"({"links": [{"from": [3], "to": [{"fap": 5, "numerator": )" + std::string(numerator) + "}]}]}";
}

TEST(Fit, ReadsWhatItSays) {
    const FapInterpolation expected{
        {{{3, 14},
          {{5, {{-0.5, {1, 0}, {}}}, {}},
           {18, {{40, {}, FitImpulse{14, -2}}, {0.001, {2, 1}, {}}}, {{1, {}, {}}, {0.1, {0, 2}, {}}}}}},
         {{5}, {{52, {{1, {1}, {}}}, {}}}}}};
    EXPECT_EQ(parse(forms), expected);
}

// -0.5 FAP3 / (1 + 0.00001 FAP14^2), as the document has it.
TEST(Fit, TheExampleOfTheDocumentMeansWhatItSays) {
    std::ifstream file(MIEN_SOURCE "/docs/mpeg4.md");
    const std::string document(std::istreambuf_iterator<char>(file), {});
    const std::size_t begin = document.find("```json\n");
    ASSERT_NE(begin, std::string::npos);
    const FapInterpolation fit =
        parse(std::string_view(document).substr(begin + 8, document.find("```", begin + 8) - begin - 8));
    std::array<std::int32_t, fap_count> value{};
    value[fap_index(3)] = 500;
    value[fap_index(14)] = 300;
    EXPECT_EQ(interpolated_value(fit.links.at(0), fit.links.at(0).to.at(0), value), std::lround(-250 / 1.9));
    EXPECT_EQ(interpolated_faps(fit).size(), 4U);
}

TEST(Fit, WhatIsWrittenReadsBackEqual) {
    FapInterpolation fit = parse(forms);
    fit.links[0].to[0].numerator[0].coefficient = 1.0 / 3;
    fit.links[1].to[0].numerator[0].coefficient = -5e-324;
    const std::string text = format_fit(fit);
    EXPECT_EQ(parse(text), fit);
    EXPECT_EQ(format_fit(parse(text)), text);
}

TEST(Fit, RefusesWhatBreaksItsPromiseAndNamesThePointer) {
    EXPECT_THAT(refusal("[]"), HasSubstr("expected an object outside"));
    EXPECT_THAT(refusal("{"), HasSubstr("fit byte"));
    EXPECT_THAT(refusal(std::string(100000, '[')), HasSubstr("64 levels"));
    EXPECT_THAT(refusal("{}"), HasSubstr("fit: expected the key links, found none"));
    EXPECT_THAT(refusal(R"({"links": []})"), HasSubstr("expected links, found none"));
    EXPECT_THAT(refusal(R"({"links": {}})"), HasSubstr("fit /links: expected an array, found an object"));
    EXPECT_THAT(refusal(R"({"links": [3]})"), HasSubstr("fit /links/0: expected an object, found '3'"));
    EXPECT_THAT(refusal(R"({"links": [{"from": [3], "to": [], "form": 1}]})"), HasSubstr("fit /links/0/form: "));
    EXPECT_THAT(refusal(R"({"links": [{"from": [3], "to": [], "to": []}]})"), HasSubstr("each key once"));
    EXPECT_THAT(refusal(R"({"links": [{"from": [69], "to": [{"fap": 5, "numerator": [{"coefficient": 1}]}]}]})"),
                HasSubstr("fit /links/0/from/0: expected an amplitude, FAP 3 to 68, found 69"));
    EXPECT_THAT(refusal(with_numerator(R"([{"coefficient": "1"}])")),
                HasSubstr("fit /links/0/to/0/numerator/0/coefficient: expected a number, found '\"1\"'"));
    EXPECT_THAT(refusal(with_numerator(R"([{"coefficient": 1e999}])")), HasSubstr("range of a double"));
    EXPECT_THAT(refusal(with_numerator(R"([{"coefficient": null}])")), HasSubstr("found 'null'"));
    EXPECT_THAT(
        refusal(with_numerator(R"([{"coefficient": 1, "exponents": [1.5]}])")),
        HasSubstr("fit /links/0/to/0/numerator/0/exponents/0: expected a whole number of 32 bits, found '1.5'"));
    for (const char* large : {"2147483648", "-2147483649", "18446744073709551615", "-9223372036854775808"})
        EXPECT_THAT(refusal(with_numerator(R"([{"coefficient": 1, "impulse": {"fap": 3, "value": )" +
                                           std::string(large) + "}}]")),
                    HasSubstr("/impulse/value: expected a whole number of 32 bits"));
    std::string many = "[0";
    for (int i = 0; i < 2000; ++i) many += ",0";
    EXPECT_THAT(refusal(with_numerator(many + "]")), HasSubstr("at most 1024 elements, found 2001"));
}

TEST(Fit, AChainThatLeadsBackIsRefused) {
    EXPECT_THAT(refusal(R"({"links": [{"from": [31], "to": [{"fap": 32, "numerator": [{"coefficient": 1}]}]},
                                      {"from": [32], "to": [{"fap": 31, "numerator": [{"coefficient": 1}]}]}]})"),
                HasSubstr("31 -> 32 -> 31"));
}

TEST(Fit, NumbersDoNotDependOnTheLocale) {
    const hostile::CommaLocale locale;
    if (!locale.there) GTEST_SKIP() << "no locale with a decimal comma is installed";
    const FapInterpolation fit = parse(forms);
    EXPECT_EQ(fit.links[0].to[0].numerator[0].coefficient, -0.5);
    EXPECT_EQ(parse(format_fit(fit)), fit);
}

TEST(Fit, SurvivesEveryPrefixAndEveryChangedByte) {
    hostile::sweep(parse_fit, forms, [](const FapInterpolation& fit) {
        return !fit.links.empty() && !interpolated_faps(fit).empty() && parse(format_fit(fit)) == fit;
    });
}

}  // namespace
}  // namespace mien
