// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/io/fap_text.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iterator>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "io/fap_samples.hpp"
#include "io/hostile.hpp"

namespace mien {
namespace {

using testing::HasSubstr;

// A mask line with ones at the given parameters.
std::string mask(std::initializer_list<int> sent, std::size_t columns = fap_count) {
    std::string line;
    for (std::size_t i = 0; i < columns; ++i)
        line += std::find(sent.begin(), sent.end(), static_cast<int>(i) + 1) == sent.end() ? "0 " : "1 ";
    line.back() = '\n';
    return line;
}

FapStream parse(std::string_view text) {
    return parse_fap_text(hostile::Copy(text).bytes());
}

std::string refusal(std::string_view text) {
    return hostile::refusal([](auto bytes) { return parse_fap_text(bytes); }, text);
}

TEST(FapText, AFrameHasOneValueForEveryOneInItsMask) {
    const FapStream stream = parse("2.1 smile.fap 25 2\n" + mask({3, 53, 68}) + "0 10 -20 30\n" + mask({4}) + "1 7\n");
    EXPECT_EQ(stream.version, "2.1");
    EXPECT_EQ(stream.name, "smile.fap");
    EXPECT_EQ(stream.rate, 25);
    ASSERT_EQ(stream.frames.size(), 2U);
    EXPECT_EQ(stream.frames[0].mask.count(), 3U);
    EXPECT_EQ(stream.frames[0].value[fap_index(3)], 10);
    EXPECT_EQ(stream.frames[0].value[fap_index(53)], -20);
    EXPECT_EQ(stream.frames[0].value[fap_index(68)], 30);
    EXPECT_TRUE(stream.frames[1].mask[fap_index(4)]);
    EXPECT_EQ(stream.frames[1].mask.count(), 1U);
    EXPECT_EQ(stream.frames[1].value[fap_index(4)], 7);
}

TEST(FapText, TheLastTwoWordsOfTheHeaderAreRateAndCountTheRestIsTheName) {
    const std::string frame = mask({3}) + "0 1\n";
    EXPECT_EQ(parse("2.1 AU Interpolation 1130.fap 25 1\n" + frame).name, "AU Interpolation 1130.fap");
    EXPECT_EQ(parse("2.1\tC#\t29.97\t1\r\n" + frame).name, "C#");
    EXPECT_EQ(parse("2.1\tC#\t29.97\t1\r\n" + frame).rate, 29.97);
    EXPECT_EQ(parse("2.1 25 1\n" + frame).name, "");
}

TEST(FapText, SpareColumnsAreReadOver) {
    const FapStream one = parse("2.1 x 25 1\n" + mask({19, 69}, 69) + "0 5 99\n");
    EXPECT_EQ(one.frames.at(0).mask.count(), 1U);
    EXPECT_EQ(one.frames.at(0).value[fap_index(19)], 5);
    EXPECT_EQ(parse("2.1 x 25 1\n" + mask({19}, 69) + "0 5\n").frames.at(0), one.frames[0]);
    const FapStream late = parse("2.1 x 25 1\n" + mask({19}) + "0 5\n" + mask({19, 69}, 69) + "1 6 99\n");
    EXPECT_EQ(late.frames.at(1).value[fap_index(19)], 6);
}

TEST(FapText, VisemesAreFourNumbersAndExpressionsSix) {
    const FapFrame frame = parse("2.1 x 25 1\n" + mask({1, 2, 3}) + "0 4 14 40 1 6 63 2 31 1 0 9\n").frames.at(0);
    EXPECT_EQ(frame.viseme, (Viseme{4, 14, 40, true}));
    EXPECT_EQ(frame.expression, (Expression{6, 63, 2, 31, true, false}));
    EXPECT_EQ(frame.value[fap_index(3)], 9);
}

TEST(FapText, OneNumberForAVisemeIsReadWhenAskedFor) {
    const std::string text = "2.1 x 25 1\n" + mask({1, 2, 3}) + "0 4 6 9\n";
    const FapFrame frame = parse_fap_text(hostile::Copy(text).bytes(), {.single_numbers = true}).frames.at(0);
    EXPECT_EQ(frame.viseme, (Viseme{4, 0, 63, false}));
    EXPECT_EQ(frame.expression, (Expression{6, 63, 0, 0, false, false}));
    EXPECT_EQ(frame.value[fap_index(3)], 9);
    EXPECT_THAT(refusal(text), HasSubstr("viseme_def"));
}

TEST(FapText, CommentsBlankLinesTabsAndLineEndsMakeNoDifference) {
    const FapStream plain = parse("2.1 x 25 2\n" + mask({3, 4}) + "0 1 2\n" + mask({3, 4}) + "1 3 4\n");
    std::string tabs = "\xef\xbb\xbf# made by hand\n\n2.1 x 25 2\n# first\n" + mask({3, 4}) +
                       "0\t1\t\t2 \n  # then\n\n" + mask({3, 4}) + "1 3\n4 # end";
    EXPECT_EQ(parse(tabs).frames, plain.frames);
    std::string windows;
    for (const char c : tabs) windows += c == '\n' ? "\r\n" : std::string(1, c);
    EXPECT_EQ(parse(windows).frames, plain.frames);
    EXPECT_EQ(parse("# joined\n\xef\xbb\xbf"
                    "2.1 x 25 1\n" +
                    mask({3}) + "0 1\n")
                  .version,
              "2.1");
    EXPECT_THAT(refusal("\xef\xbb\xbf x 25 1\n"), HasSubstr("fap"));
}

TEST(FapText, AMaskMayGoOverSeveralLines) {
    std::string text = "2.1 x 25 2\n";
    for (int frame = 0; frame < 2; ++frame) {
        for (int i = 0; i < 68; ++i) text += i % 17 == 16 ? "1\n" : "0 ";
        text += std::to_string(frame) + " 1 2\n3 4\n";
    }
    const FapStream stream = parse(text);
    ASSERT_EQ(stream.frames.size(), 2U);
    for (const FapFrame& frame : stream.frames) {
        EXPECT_EQ(frame.value[fap_index(17)], 1);
        EXPECT_EQ(frame.value[fap_index(68)], 4);
    }
}

TEST(FapText, ValuesAreRoundedAndMayHaveExponentsAndManyDigits) {
    const FapStream stream = parse("2.1 x 25 1\n" + mask({3, 4, 5, 6, 7}) + "0 1.6 -2.5 1e3 +8 -0000000012\n");
    EXPECT_THAT(std::vector(stream.frames[0].value.begin() + 2, stream.frames[0].value.begin() + 7),
                testing::ElementsAre(2, -3, 1000, 8, -12));
    EXPECT_EQ(parse("2.1 x 25 1\n" + mask({3}) + "0 2147483647").frames[0].value[2], 2147483647);
    EXPECT_THAT(refusal("2.1 x 25 1\n" + mask({3}) + "0 2147483648"), HasSubstr("within 32 bits"));
    EXPECT_THAT(refusal("2.1 x 25 1\n" + mask({3}) + "0 nan"), HasSubstr("within 32 bits"));
    EXPECT_THAT(refusal("2.1 x 25 1\n" + mask({3}) + "0 1e999"), HasSubstr("within 32 bits"));
}

TEST(FapText, FrameNumbersBeginAnywhereLeaveSomeOutAndRise) {
    const std::string m = mask({3});
    const FapStream stream = parse("2.1 x 25 3\n" + m + "1 5\n" + m + "2 5\n" + m + "7 5\n");
    EXPECT_EQ(stream.frames[0].number, 1U);
    EXPECT_EQ(stream.frames[2].number, 7U);
    EXPECT_THAT(refusal("2.1 x 25 2\n" + m + "1 5\n" + m + "1 5\n"),
                HasSubstr("line 5: expected a frame number from 2"));
    EXPECT_THAT(refusal("2.1 x 25 2\n" + m + "-1 5\n"), HasSubstr("expected a frame number from 0, found -1"));
}

TEST(FapText, APromisedCountAllocatesNothing) {
    EXPECT_EQ(parse("2.1 x 25 999999999999\n" + mask({3}) + "0 1\n").frames.size(), 1U);
    EXPECT_EQ(parse("2.1 x 25 0\n" + mask({3}) + "0 1\n").frames.size(), 1U);
}

TEST(FapText, WhatIsWrongIsNamedWithItsLine) {
    const std::string header = "2.1 x 25 1\n";
    EXPECT_THAT(refusal(""), HasSubstr("empty file"));
    EXPECT_THAT(refusal("2.1 x zero 1\n"), HasSubstr("line 1: expected 'version name fps frames'"));
    EXPECT_THAT(refusal("2.1 x 0 1\n"), HasSubstr("fps above 0"));
    EXPECT_THAT(refusal("2.1 x 25 -1\n"), HasSubstr("number of frames"));
    EXPECT_THAT(refusal(header), HasSubstr("found none"));
    EXPECT_THAT(refusal(header + "0 1 2"), HasSubstr("line 2: expected 0 or 1 in the mask, found '2'"));
    EXPECT_THAT(refusal(header + "0 1 0"), HasSubstr("expected 68 mask columns, found 3"));
    EXPECT_THAT(refusal(header + mask({3, 4}) + "0 1"), HasSubstr("found the end of the file"));
    EXPECT_THAT(refusal(header + mask({3, 4}) + "0 1 x"), HasSubstr("line 3: expected the value of a parameter"));
    EXPECT_THAT(refusal(header + mask({3}) + "0 1 2"), HasSubstr("found '2' behind them"));
    EXPECT_THAT(refusal(header + mask({1}) + "0 15 0 0 0"), HasSubstr("viseme_select1 from 0 to 14, found 15"));
    EXPECT_THAT(refusal(header + mask({2}) + "0 1 64 0 0 0 0"), HasSubstr("expression_intensity1 from 0 to 63"));
    EXPECT_THAT(refusal(header + std::string(1, '\0')), HasSubstr("NUL"));
}

TEST(FapText, TheDecimalPointIsNoMatterOfTheLocale) {
    const hostile::CommaLocale locale;
    if (!locale.there) GTEST_SKIP() << "no such locale here";
    const FapStream stream = parse("2.1 x 12.5 1\n" + mask({3}) + "0 1.6\n");
    EXPECT_EQ(stream.rate, 12.5);
    EXPECT_THAT(format_fap_text(stream), testing::StartsWith("2.1 x 12.5 1\n"));
}

TEST(FapText, WhatIsWrittenReadsBackEqual) {
    std::mt19937 random(7);
    for (int k = 0; k < 300; ++k) {
        const FapStream stream = random_stream(random, 1 + k % 9);
        const std::string text = format_fap_text(stream);
        const FapStream again = parse(text);
        EXPECT_EQ(again.version, stream.version);
        EXPECT_EQ(again.name, stream.name);
        EXPECT_EQ(again.rate, stream.rate);
        ASSERT_EQ(again.frames, stream.frames);
        EXPECT_EQ(format_fap_text(again), text);
    }
}

TEST(FapText, AHeaderThatWouldNotReadBackIsRefused) {
    FapStream stream = parse("2.1 x 25 1\n" + mask({3}) + "0 1\n");
    stream.version = "2 1";
    EXPECT_THROW(format_fap_text(stream), Error);
    stream.version = "2.1", stream.name = "two\nlines";
    EXPECT_THROW(format_fap_text(stream), Error);
    stream.name = "x", stream.rate = 0;
    EXPECT_THROW(format_fap_text(stream), Error);
}

// Word by word, but for the spare mask column that Greta writes.
TEST(FapText, RealFilesComeBackWordByWord) {
    const auto samples = fap_samples();
    if (samples.empty()) GTEST_SKIP() << "the real files are not there";
    EXPECT_EQ(samples.size(), 8U);
    for (const auto& [name, text] : samples) {
        std::istringstream before(text), after(format_fap_text(parse(text)));
        std::string line, ours;
        std::size_t number = 0;
        while (std::getline(before, line)) {
            if (line.find_first_not_of(" \r\t") == std::string::npos) continue;
            ASSERT_TRUE(std::getline(after, ours)) << name;
            std::istringstream line_words(line), our_words(ours);
            std::vector<std::string> words{std::istream_iterator<std::string>(line_words), {}};
            const std::vector<std::string> our{std::istream_iterator<std::string>(our_words), {}};
            if (number % 2 == 1 && words.size() == 69) words.pop_back();
            EXPECT_EQ(words, our) << name << " line " << number + 1;
            ++number;
        }
        EXPECT_FALSE(std::getline(after, ours)) << name;
    }
}

TEST(FapText, RealFilesHoldWhatTheirWritersSay) {
    const auto samples = fap_samples();
    if (samples.empty()) GTEST_SKIP() << "the real files are not there";
    const FapStream jag = parse(samples.at("jag.fap"));
    ASSERT_EQ(jag.frames.size(), 169U);
    EXPECT_EQ(jag.rate, 5);
    const auto extremes = [&](int fap) {
        std::vector<int> values;
        for (const FapFrame& frame : jag.frames) values.push_back(frame.value[fap_index(fap)]);
        const auto [low, high] = std::minmax_element(values.begin(), values.end());
        return std::pair(*low, *high);
    };
    EXPECT_EQ(extremes(5), std::pair(-1146, 172));
    EXPECT_EQ(extremes(14), std::pair(-1242, 186));
    EXPECT_EQ(extremes(49), std::pair(-46594, 56298));
    EXPECT_EQ(parse(samples.at("eyes.fap")).frames.at(0).number, 1U);
    EXPECT_EQ(parse(samples.at("eyes.fap")).frames.size(), 52U);
    const FapStream lids = parse(samples.at("AU Interpolation_1187.fap"));
    EXPECT_EQ(lids.name, "AU Interpolation_1187.fap");
    EXPECT_EQ(lids.frames.at(0).value[fap_index(19)], 940);
    EXPECT_EQ(lids.frames.at(0).value[fap_index(22)], 200);
}

TEST(FapText, AnyChangedByteIsRefusedOrReadWhole) {
    const std::string text = "2.1 a b 25 2\r\n#c\n" + mask({1, 2, 3, 69}, 69) + "0 4 14 40 1 6 63 2 31 1 0 -9 8\n" +
                             mask({3, 4}) + "3 1.5\t2e1\n";
    hostile::sweep([](auto bytes) { return parse_fap_text(bytes); }, text, keeps_promise);
}

}  // namespace
}  // namespace mien
