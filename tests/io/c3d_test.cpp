// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/io/c3d.hpp"

#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <string>
#include <tuple>

#include "io/c3d_file.hpp"
#include "io/hostile.hpp"

#include "mien/io/read.hpp"

namespace mien {
namespace {

using c3d::Contents;
using c3d::Machine;
using testing::HasSubstr;

Take parse(const std::string& bytes) {
    return parse_c3d(hostile::Copy(bytes).bytes());
}

std::string refusal(const std::string& bytes) {
    return hostile::refusal(parse_c3d, bytes);
}

std::string changed(std::string bytes, std::size_t at, int value) {
    bytes[at] = static_cast<char>(value);
    return bytes;
}

TEST(C3d, ReadsEveryNumberFormatAlike) {
    for (const Machine machine : {Machine::pc, Machine::dec, Machine::sgi})
        for (const bool real : {false, true}) {
            Contents contents;
            contents.machine = machine;
            contents.real = real;
            const Take take = parse(c3d::file(contents));
            EXPECT_EQ(take.points, (std::vector<std::string>{"chin", "brow"}));
            EXPECT_EQ(take.times, (std::vector<double>{0, 0.02}));
            EXPECT_EQ(take.unit, "mm");
            EXPECT_EQ(take.missing_rows, 0U);
            ASSERT_EQ(take.samples.size(), 4U);
            EXPECT_EQ(take.samples[0], (Vec3{1, 2, 3})) << static_cast<int>(machine) << real;
            EXPECT_EQ(take.samples[1], (Vec3{4, -5, 6}));
            EXPECT_EQ(take.samples[2], (Vec3{1.5, 2, 3}));
            EXPECT_TRUE(std::isnan(take.samples[3].y));
        }
}

TEST(C3d, RealNumbersOfTheVaxComeBackToTheLastBit) {
    Contents contents;
    contents.machine = Machine::dec;
    contents.labels = {"chin"};
    contents.last = 4;
    contents.frames = {{{0.1F, -1e-30F, 1e30F, 0}}, {{123.456F, -0.5F, 2, 0}}, {{1, 0, 8388609, 0}}, {{3, 4, 5, 0}}};
    contents.frames[2][0].x = std::nextafter(1.0F, 2.0F);
    const Take take = parse(c3d::file(contents));
    EXPECT_TRUE(std::isnan(take.samples[0].x));  // 1e30 is no place
    EXPECT_EQ(take.samples[1], (Vec3{123.456F, -0.5, 2}));
    EXPECT_EQ(take.samples[2], (Vec3{std::nextafter(1.0F, 2.0F), 0, 8388609}));
}

Contents long_take(std::size_t frames) {
    Contents contents;
    contents.real = false;
    contents.labels = {"chin"};
    contents.analog = 0;
    contents.frames.assign(frames, {{1, 1, 1, 0}});
    contents.frames.back() = {{2, 2, 2, 0}};
    contents.last = 65535;
    return contents;
}

TEST(C3d, MoreFramesThanTheHeaderCanCountAreReadWhole) {
    Contents contents = long_take(70000);
    contents.actual_end = 70000;
    const Take take = parse(c3d::file(contents));
    ASSERT_EQ(row_count(take), 70000U);
    EXPECT_EQ(take.samples.back(), (Vec3{2, 2, 2}));
    EXPECT_NEAR(take.times.back(), 69999 / 50.0, 1e-9);
    // Without a word on their number the rest of the file counts, in whole blocks.
    contents.actual_end = 0;
    EXPECT_GE(row_count(parse(c3d::file(contents))), 70000U);
    EXPECT_LT(row_count(parse(c3d::file(contents))), 70000U + 64);
}

TEST(C3d, LabelsBeyondTheTwoHundredAndFiftyFifthAreFound) {
    Contents contents;
    contents.labels.clear();
    for (int i = 0; i < 300; ++i) contents.labels.push_back(fmt::format("m{}", i));
    contents.frames.assign(2, std::vector<c3d::Sample>(300, {1, 2, 3, 0}));
    EXPECT_EQ(parse(c3d::file(contents)).points, contents.labels);
}

TEST(C3d, APointWithoutALabelIsCalledByItsNumber) {
    Contents contents;
    contents.labels = {"chin", ""};
    EXPECT_EQ(parse(c3d::file(contents)).points, (std::vector<std::string>{"chin", "point 2"}));
}

TEST(C3d, ACutFileGivesItsWholeFramesAndSaysWhatIsMissing) {
    Contents contents;
    contents.last = 100;
    contents.frames.assign(100, {{1, 2, 3, 0}, {4, 5, 6, 0}});
    const std::string whole = c3d::file(contents);
    constexpr std::size_t frame = 36;
    const std::size_t data = whole.size() - (100 * frame + 511) / 512 * 512;
    const Take take = parse(whole.substr(0, data + 60 * frame + 17));
    EXPECT_EQ(row_count(take), 60U);
    EXPECT_EQ(take.missing_rows, 40U);
    EXPECT_THAT(refusal(whole.substr(0, data + 20)), HasSubstr("found no whole one"));
}

TEST(C3d, RefusesWhatItCannotReadAndSaysWhatItFound) {
    const std::string good = c3d::file({});
    EXPECT_THAT(refusal(""), HasSubstr("expected a header of 512 bytes, found 0"));
    EXPECT_THAT(refusal(changed(good, 1, 0x51)), HasSubstr("found 81"));
    EXPECT_THAT(refusal(changed(good, 0, 9)), HasSubstr("expected parameters in a block from 2 to 3, found block 9"));
    EXPECT_THAT(refusal(changed(good, 0, 0)), HasSubstr("found block 0"));
    EXPECT_THAT(refusal(changed(good, 512 + 3, 99)), HasSubstr("84 (PC), 85 (DEC) or 86 (SGI), found 99"));
    EXPECT_THAT(refusal(changed(good, 2, 0)), HasSubstr("expected points, found none"));
    EXPECT_THAT(refusal(changed(good, 8, 0)), HasSubstr("expected frames, found none: from 1 to 0"));
    EXPECT_THAT(refusal(changed(good, 16, 77)), HasSubstr("expected frames in a block from 2 to 3, found block 77"));
    EXPECT_THAT(refusal(changed(changed(good, 14, 0xff), 15, 0xff)), HasSubstr("scale"));
    Contents contents;
    contents.rate = -1;
    EXPECT_THAT(refusal(c3d::file(contents)), HasSubstr("expected a rate above 0, found -1"));
    contents = {};
    contents.labels = {"chin", "chin"};
    EXPECT_THAT(refusal(c3d::file(contents)), HasSubstr("'chin' twice"));
    contents = {};
    contents.frames.assign(2, std::vector<c3d::Sample>(2, {1, 2, 3, -1}));
    EXPECT_THAT(refusal(c3d::file(contents)), HasSubstr("no sample at all"));
}

TEST(C3d, SurvivesEveryPrefixAndEveryChangedByte) {
    Contents contents;
    contents.real = false;
    for (const Machine machine : {Machine::pc, Machine::sgi}) {
        contents.machine = machine;
        hostile::sweep(parse_c3d, c3d::file(contents), [](const Take& take) { return hostile::keeps_promise(take); });
    }
}

std::filesystem::path samples() {
    return std::filesystem::path(MIEN_SHARED) / "data/malformed/mocap/c3d";
}

struct Seen {
    std::size_t lost = 0;
    double mean_x = 0;
};

Seen seen_in(const Take& take) {
    Seen seen;
    double sum = 0;
    for (const Vec3& p : take.samples)
        if (is_finite(p))
            sum += p.x;
        else
            ++seen.lost;
    seen.mean_x = sum / static_cast<double>(take.samples.size() - seen.lost);
    return seen;
}

TEST(C3d, RealCapturesHaveTheFiguresThatAnotherReaderGives) {
    if (!std::filesystem::exists(samples())) GTEST_SKIP() << "the samples are not there";
    for (const char* name : {"pc_int", "pc_real", "DEC_INT", "Dec_real", "sgi_int", "sgi_real"}) {
        const Take take = read_take(samples() / ("sample02_" + std::string(name) + ".c3d"));
        EXPECT_EQ(row_count(take), 89U) << name;
        EXPECT_EQ(take.points.size(), 36U) << name;
        EXPECT_NEAR(frame_rate(take), 50, 1e-9) << name;
        EXPECT_EQ(seen_in(take).lost, 228U) << name;
        EXPECT_NEAR(seen_in(take).mean_x, 252.58, 0.005) << name;
    }
    const Take cube = read_take(samples() / "MyCube.c3d");
    EXPECT_EQ(row_count(cube), 1U);
    EXPECT_EQ(cube.points.size(), 14U);
    EXPECT_EQ(seen_in(cube).lost, 0U);
    EXPECT_NEAR(seen_in(cube).mean_x, -13.872, 0.0005);
}

// The file of integers of the DEC differs in itself: 155 of its 18,512 words are one more or less than on the others.
TEST(C3d, TheSameCaptureFromThreeMachinesIsEqual) {
    if (!std::filesystem::exists(samples())) GTEST_SKIP() << "the samples are not there";
    constexpr double step = 0.2812;
    for (const auto& [pc, other, most] :
         {std::tuple("pc_int", "sgi_int", 0.0), std::tuple("pc_int", "DEC_INT", step),
          std::tuple("pc_real", "sgi_real", 0.0), std::tuple("pc_real", "Dec_real", 0.0)}) {
        const Take a = read_take(samples() / ("sample02_" + std::string(pc) + ".c3d"));
        const Take b = read_take(samples() / ("sample02_" + std::string(other) + ".c3d"));
        EXPECT_EQ(a.points, b.points);
        ASSERT_EQ(a.samples.size(), b.samples.size());
        for (std::size_t i = 0; i < a.samples.size(); ++i) {
            ASSERT_EQ(is_finite(a.samples[i]), is_finite(b.samples[i])) << other;
            if (!is_finite(a.samples[i])) continue;
            const Vec3 d = a.samples[i] - b.samples[i];
            for (const double difference : {d.x, d.y, d.z}) EXPECT_LE(std::abs(difference), most) << other;
        }
    }
}

}  // namespace
}  // namespace mien
