// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/io/fba.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>
#include <string>
#include <vector>

#include "io/fap_samples.hpp"
#include "io/hostile.hpp"

#include "mien/io/fap_text.hpp"

namespace mien {
namespace {

using testing::HasSubstr;

DecodedFaps parse(std::string_view bytes) {
    return parse_fba(hostile::Copy(bytes).bytes());
}

FapStream read_sample(const std::string& text) {
    return parse_fap_text(hostile::Copy(text).bytes());
}

// The bits of a text of 0 and 1 (blanks are for the eye) as bytes, the last filled up with zeros.
std::string bytes_of(std::string_view bits) {
    std::string bytes;
    int count = 0;
    for (const char bit : bits) {
        if (bit == ' ') continue;
        if (count % 8 == 0) bytes += '\0';
        const int set = bit == '1' ? 0x80 >> (count % 8) : 0;
        bytes.back() = static_cast<char>(static_cast<unsigned char>(bytes.back()) | set);
        ++count;
    }
    return bytes;
}

std::string repeated(std::string_view text, int times) {
    std::string all;
    for (int i = 0; i < times; ++i) all += text;
    return all;
}

const std::string object = "00000000 00000000 00000001 10111010", plane = "00000000 00000000 00000001 10111011",
                  end = "00000000 00000000 00000001 10110001";

// The bits with what goes before a start code behind them: a zero, and ones up to the byte.
std::string padded(const std::string& bits) {
    const auto count = bits.size() - static_cast<std::size_t>(std::count(bits.begin(), bits.end(), ' '));
    return count % 8 == 0 ? bits : bits + "0" + std::string(7 - count % 8, '1');
}

FapStream one_frame(std::initializer_list<int> sent) {
    FapStream stream;
    stream.frames.emplace_back();
    for (const int fap : sent) stream.frames[0].mask.set(fap_index(fap));
    return stream;
}

void expect_reads_back(const FapStream& stream, const FbaOptions& options) {
    const EncodedFaps encoded = format_fba(stream, options);
    const DecodedFaps decoded = parse(encoded.bytes);
    EXPECT_EQ(decoded.cut, "");
    EXPECT_EQ(decoded.stream.rate, encoded.decoded.rate);
    ASSERT_EQ(decoded.stream.frames, encoded.decoded.frames);
    EXPECT_TRUE(keeps_promise(decoded.stream));
}

// Nearest level of the step, or the end of what 1860 steps reach.
void expect_quantised(const FapStream& before, const EncodedFaps& encoded) {
    ASSERT_EQ(encoded.decoded.frames.size(), before.frames.size());
    std::size_t clamped = 0;
    for (std::size_t f = 0; f < before.frames.size(); ++f) {
        const FapFrame &in = before.frames[f], &out = encoded.decoded.frames[f];
        ASSERT_EQ(in.mask, out.mask);
        ASSERT_EQ(in.number, out.number);
        EXPECT_EQ(in.viseme.select1, out.viseme.select1);
        EXPECT_EQ(in.expression.select2, out.expression.select2);
        EXPECT_EQ(in.viseme.define, out.viseme.define);
        EXPECT_EQ(in.expression.init_face, out.expression.init_face);
        EXPECT_LE(std::abs(in.viseme.blend - out.viseme.blend), std::max(encoded.quant, 1) / 2);
        EXPECT_LE(std::abs(in.expression.intensity1 - out.expression.intensity1), std::max(encoded.quant, 1) / 2);
        for (std::size_t i = 2; i < fap_count; ++i) {
            const int step = encoded.quant == 0 ? 1 : encoded.quant * faps[i].quant_step;
            const int reach = 1860 / std::max(encoded.quant, 1) * step;
            EXPECT_EQ(out.value[i] % step, 0);
            const int nearest = std::clamp(in.value[i], -reach, reach);
            EXPECT_LE(std::abs(nearest - out.value[i]), step / 2) << faps[i].name << " " << encoded.quant;
            clamped += nearest != in.value[i] ? 1U : 0U;
        }
    }
    EXPECT_EQ(encoded.clamped, clamped);
}

TEST(Fba, AFrameThatSendsNothingIsWrittenAsTheStandardSays) {
    const std::string masks = repeated("1 00", 10);
    const std::string markers = repeated(repeated("1", 4 + 3 + 2 + 1 + 2 + 1 + 3 + 1 + 1), 4);
    // intra, a face; rate 25, no time code; nothing skipped; quantiser 1; masks; no gender; predictive; limits
    const std::string bits = object + plane + "1 01 1 00011001 0000 0 0 0 00001" + masks + "0 0 1111" + markers;
    EXPECT_EQ(format_fba(one_frame({})).bytes, bytes_of(padded(bits) + end));
}

TEST(Fba, OneParameterIsWrittenAsTheStandardSays) {
    FapStream stream = one_frame({48});
    stream.frames[0].number = 17;
    stream.frames[0].interpolated.set(6);
    stream.frames[0].value[fap_index(48)] = 170 * 61;
    stream.rate = 30000.0 / 1001;
    const std::string masks = repeated("1 00", 6) + "1 10 100" + repeated("1 00", 3);
    const auto limits = [](const char* of_48) {
        return repeated("1", 4 + 3 + 2 + 1 + 2) + "1" + of_48 + repeated("1", 3 + 1 + 1);
    };
    // 17 skipped: 15 and 2. 61 levels of 170 fit below 2 * 60.
    const std::string bits = object + plane + "1 01 1 00011110 0000 1 0 1 1111 0010 00001" + masks + "0 0 1111" +
                             limits("00010") + limits("00000") + limits("00000") + limits("00000");
    // Of 121 symbols, equally likely, the 62nd from the top is 31955 to 32496 of 65536: both begin with 011111, what is
    // left of them lies around the middle, and 01 names its second quarter.
    const std::string bytes = format_fba(stream).bytes;
    EXPECT_EQ(bytes, bytes_of(padded(bits + "01111101") + end));
    const FapFrame frame = parse(bytes).stream.frames.at(0);
    EXPECT_EQ(frame.number, 17U);
    EXPECT_EQ(frame.value[fap_index(48)], 170 * 61);
    EXPECT_TRUE(frame.interpolated[6]);
    EXPECT_DOUBLE_EQ(parse(bytes).stream.rate, 30000.0 / 1001);
}

TEST(Fba, RandomStreamsOfAllMasksReadBackAsQuantised) {
    std::mt19937 random(11);
    for (int k = 0; k < 10000; ++k) {
        FapStream stream = random_stream(random, 1 + random() % 12);
        for (FapFrame& frame : stream.frames)
            if (random() % 16 == 0) frame.interpolated.set(random() % 10);
        const FbaOptions options{.quant = k % 32, .intra_every = random() % 4};
        expect_reads_back(stream, options);
        expect_quantised(stream, format_fba(stream, options));
        ASSERT_FALSE(HasFailure()) << "stream " << k;
    }
}

TEST(Fba, ALongStreamReadsBackThroughManyHalvingsOfItsCounts) {
    std::mt19937 random(12);
    FapStream stream;
    std::normal_distribution<double> step(0, 9);
    double value = 0;
    for (std::uint32_t f = 0; f < 40000; ++f) {
        FapFrame& frame = stream.frames.emplace_back();
        frame.number = f;
        frame.mask.set(2);
        frame.mask.set(fap_index(31));
        value = 0.99 * value + step(random);
        frame.value[2] = static_cast<int>(4 * value);
        frame.value[fap_index(31)] = static_cast<int>(2 * value);
    }
    expect_reads_back(stream, {.quant = 1});
}

TEST(Fba, RealFilesReadBackAsQuantised) {
    const auto samples = fap_samples();
    if (samples.empty()) GTEST_SKIP() << "the real files are not there";
    for (const auto& [name, text] : samples)
        for (int quant = 0; quant < 32; ++quant) {
            SCOPED_TRACE(name);
            const FapStream stream = read_sample(text);
            expect_reads_back(stream, {.quant = quant});
            expect_quantised(stream, format_fba(stream, {.quant = quant}));
        }
}

TEST(Fba, AVisemeAndAnExpressionKeepWhatTheySelect) {
    FapStream stream = one_frame({1, 2});
    stream.frames[0].viseme = {14, 3, 63, true};
    stream.frames[0].expression = {6, 63, 1, 0, true, false};
    stream.frames.push_back(stream.frames[0]);
    stream.frames[1].number = 1;
    stream.frames[1].viseme = {0, 14, 0, false};
    stream.frames[1].expression = {0, 0, 6, 63, false, true};
    EXPECT_EQ(parse(format_fba(stream).bytes).stream.frames, stream.frames);
    for (int quant = 2; quant < 32; ++quant) expect_reads_back(stream, {.quant = quant});
}

TEST(Fba, AHalfStepGoesToZeroAndOtherHalvesAwayFromIt) {
    // FAP 4 has a step of 2, so levels of 6 with quantiser 3. Each frame after the first codes a difference.
    FapStream stream = one_frame({4});
    const std::vector<int> values = {3, 6, 9, 21, 18, -3, -9}, expected = {0, 6, 6, 24, 18, -6, -6};
    for (std::size_t f = 0; f < values.size(); ++f) {
        if (f > 0) stream.frames.push_back(stream.frames[0]);
        stream.frames[f].number = static_cast<std::uint32_t>(f);
        stream.frames[f].value[fap_index(4)] = values[f];
    }
    const FapStream decoded = parse(format_fba(stream, {.quant = 3}).bytes).stream;
    // 3 - 0 is half a step: 0. 6 - 0: 6. 9 - 6 is half: 6. 21 - 6 is two and a half: 24. 18 - 24: 18. -3 - 18 is three
    // and a half: 18 - 24 = -6. -9 + 6 is half: -6.
    for (std::size_t f = 0; f < values.size(); ++f) EXPECT_EQ(decoded.frames[f].value[fap_index(4)], expected[f]) << f;
    // On its own, -9 is one and a half: two levels.
    FapStream alone = one_frame({4});
    alone.frames[0].value[fap_index(4)] = -9;
    EXPECT_EQ(parse(format_fba(alone, {.quant = 3}).bytes).stream.frames[0].value[fap_index(4)], -12);
}

TEST(Fba, StandingStillCostsNextToNothing) {
    FapStream stream = one_frame({3, 4, 5, 51, 52});
    for (std::uint32_t f = 1; f < 1000; ++f) {
        stream.frames.push_back(stream.frames[0]);
        stream.frames[f].number = f;
    }
    // A header of 4 bits and an empty run of 2.
    const std::size_t one = format_fba(one_frame({3, 4, 5, 51, 52})).bytes.size();
    EXPECT_NEAR(static_cast<double>(format_fba(stream).bytes.size() - one), 999 * 6 / 8.0, 2);
}

TEST(Fba, TheRateIsKeptAndTheQuantiserIsTheFinestThatKeepsIt) {
    std::mt19937 random(4);
    FapStream stream = one_frame({3, 5, 48, 51, 52});
    for (std::uint32_t f = 1; f < 200; ++f) {
        stream.frames.push_back(stream.frames[0]);
        stream.frames[f].number = f;
        for (const int fap : {3, 5, 48, 51, 52})
            stream.frames[f].value[fap_index(fap)] = static_cast<int>(random() % 400) * fap_info(fap).quant_step;
    }
    const double fine = format_fba(stream).kilobits_per_second;
    const EncodedFaps half = format_fba(stream, {.kilobits_per_second = 0.7 * fine});
    EXPECT_LE(half.kilobits_per_second, 0.7 * fine);
    EXPECT_GT(half.quant, 1);
    EXPECT_GT(format_fba(stream, {.quant = half.quant - 1}).kilobits_per_second, 0.7 * fine);
    EXPECT_NEAR(half.kilobits_per_second, 8.0 * static_cast<double>(half.bytes.size()) / (200 / 25.0) / 1000, 1e-9);
    EXPECT_THROW(format_fba(stream, {.kilobits_per_second = 0.001}), Error);
}

TEST(Fba, AStreamThatIsCutGivesTheFramesThatAreWhole) {
    std::mt19937 random(21);
    for (int k = 0; k < 40; ++k) {
        const FapStream stream = random_stream(random, 1 + random() % 6);
        const EncodedFaps encoded = format_fba(stream, {.quant = 1 + k % 31});
        std::size_t before = 0;
        for (std::size_t size = 0; size < encoded.bytes.size(); ++size) {
            const auto decoded = hostile::attempt(parse_fba, std::string_view(encoded.bytes).substr(0, size));
            const std::size_t frames = decoded ? decoded->stream.frames.size() : 0;
            EXPECT_GE(frames, before);
            before = frames;
            if (!decoded) continue;
            EXPECT_THAT(decoded->cut, HasSubstr("byte"));
            ASSERT_LE(frames, encoded.decoded.frames.size());
            EXPECT_TRUE(std::equal(decoded->stream.frames.begin(), decoded->stream.frames.end(),
                                   encoded.decoded.frames.begin()));
        }
        // But for the end code every frame is whole.
        EXPECT_EQ(before, encoded.decoded.frames.size());
    }
}

TEST(Fba, AFlippedBitGivesAnErrorOrFramesThatCouldBe) {
    std::mt19937 random(22);
    std::size_t refused = 0;
    for (int k = 0; k < 12; ++k) {
        const EncodedFaps encoded = format_fba(random_stream(random, 4), {.quant = 1 + k % 31});
        for (std::size_t bit = 0; bit < 8 * encoded.bytes.size(); ++bit) {
            std::string bytes = encoded.bytes;
            bytes[bit / 8] = static_cast<char>(static_cast<unsigned char>(bytes[bit / 8]) ^ (0x80 >> (bit % 8)));
            const auto decoded = hostile::attempt(parse_fba, bytes);
            EXPECT_TRUE(!decoded || keeps_promise(decoded->stream)) << bit;
            refused += !decoded || !decoded->cut.empty() ? 1U : 0U;
        }
    }
    EXPECT_GT(refused, 1000U);
}

TEST(Fba, AnyChangedByteIsRefusedOrReadWhole) {
    std::mt19937 random(23);
    const std::string bytes = format_fba(random_stream(random, 5)).bytes;
    hostile::sweep(parse_fba, bytes, [](const DecodedFaps& decoded) { return keeps_promise(decoded.stream); });
}

TEST(Fba, LimitsThatAreNotSentAreThoseOfTheStandard) {
    // FAP 3 alone, 0 to 1080 steps of 4. Of 1081 symbols, counted from the top, a quarter is the 271st: 810.
    const std::string masks = "1 00 1 01 1000000000000000" + repeated("1 00", 8);
    const std::string bits = object + plane + "1 01 1 00011001 0000 0 0 0 00001" + masks + "0 0 0000" + "01 0000000000";
    EXPECT_EQ(parse(bytes_of(padded(bits) + end)).stream.frames.at(0).value[2], 4 * 810);
    EXPECT_EQ(parse(bytes_of(padded(bits) + end)).cut, "");
}

TEST(Fba, WhatIsNotReadIsNamed) {
    const auto refusal = [](const std::string& bytes) { return hostile::refusal(parse_fba, bytes); };
    const std::string head = object + plane;
    EXPECT_THAT(refusal(""), HasSubstr("expected the start code 00 00 01 BA"));
    EXPECT_THAT(refusal(std::string("\0\0\1\1", 4)), HasSubstr("found 00000101"));
    EXPECT_THAT(refusal(bytes_of(object + end)), HasSubstr("at least one frame"));
    EXPECT_THAT(refusal(bytes_of(head + "1 11")), HasSubstr("body animation"));
    EXPECT_THAT(refusal(bytes_of(head + "0 01 0")), HasSubstr("expected an intra plane first"));
    const std::string masks = repeated("1 00", 10);
    EXPECT_THAT(refusal(bytes_of(head + "1 01 0 0 0 00001" + masks + "0 1 0000 0000")), HasSubstr("DCT"));
    EXPECT_THAT(refusal(bytes_of(head + "1 01 0 0 0 00001 0 00 0000")), HasSubstr("marker bit"));
    EXPECT_THAT(refusal(bytes_of(head + "1 01 1 00000000 0000 0 0 0")), HasSubstr("frame rate above 0"));
}

TEST(Fba, WhatCannotBeCodedIsRefused) {
    const FapStream good = one_frame({3});
    EXPECT_THROW(format_fba({}), Error);
    EXPECT_THROW(format_fba(good, {.quant = 32}), Error);
    EXPECT_THROW(format_fba(good, {.quant = -1}), Error);
    FapStream stream = good;
    for (const double rate : {0.0, -25.0, 300.0, std::nan("")}) {
        stream.rate = rate;
        EXPECT_THROW(format_fba(stream), Error) << rate;
    }
    stream = good;
    stream.frames.push_back(stream.frames[0]);
    EXPECT_THROW(format_fba(stream), Error);
    stream.frames[1].number = 2000000;
    EXPECT_THROW(format_fba(stream), Error);
    stream = one_frame({1});
    stream.frames[0].viseme.select1 = 15;
    EXPECT_THROW(format_fba(stream), Error);
}

}  // namespace
}  // namespace mien
