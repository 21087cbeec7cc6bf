// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/io/trc.hpp"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>

#include "io/hostile.hpp"

namespace mien {
namespace {

using testing::HasSubstr;

std::string refusal(std::string_view text) {
    return hostile::refusal(parse_trc, text);
}

Take parse(std::string_view text) {
    return parse_trc(hostile::Copy(text).bytes());
}

std::string file(const std::string& facts, const std::string& names, const std::string& rows) {
    return "PathFileType\t4\t(X/Y/Z)\ta.trc\r\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\r\n" + facts +
           "\r\nFrame#\tTime\t" + names + "\r\n\t\tX1\tY1\tZ1\tX2\tY2\tZ2\r\n\r\n" + rows;
}

const std::string facts = "60\t60\t2\t2\tcm";
const std::string names = "chin\t\t\tbrow\t\t";
const std::string rows = "1\t0.0\t1\t2\t3\t4\t5\t6\r\n2\t0.5\t7\t8\t9\t10\t11\t12\t\r\n";

TEST(Trc, refuses_what_breaks_its_promise_and_names_the_line) {
    EXPECT_THAT(refusal(""), HasSubstr("trc line 1: expected PathFileType"));
    EXPECT_THAT(refusal(file("0\t60\t2\t2\tcm", names, rows)), HasSubstr("trc line 3: expected a DataRate above 0"));
    EXPECT_THAT(refusal(file("60\t60\t2\t2\tparsec", names, rows)), HasSubstr("found 'parsec'"));
    EXPECT_THAT(refusal(file("60\t60\t2\t3\tcm", names, rows)),
                HasSubstr("expected 3 marker names as NumMarkers says, found 2"));
    EXPECT_THAT(refusal(file("60\t60\t2\t1\tcm", names, rows)), HasSubstr("expected 1 marker names"));
    EXPECT_THAT(refusal(file(facts, names, "1\t0\t1\t2\t3\t4\t5\n")), HasSubstr("expected 8 cells, found 7"));
    EXPECT_THAT(refusal(file(facts, "chin\t\t\tchin\t\t", rows)), HasSubstr("'chin' twice"));
    EXPECT_THAT(refusal(file(facts, "ch\rin\t\t\tbrow\t\t", rows)), HasSubstr("on one line"));
    EXPECT_THAT(refusal(file(facts, names, "")), HasSubstr("expected rows of samples, found none"));
    EXPECT_THAT(refusal(file(facts, names, "1\t0\t1\t2\t3\n")), HasSubstr("expected 8 cells, found 5"));
    EXPECT_THAT(refusal(file(facts, names, "1\t0\t1\t2\t3\t4\t5\t6\t7\n")), HasSubstr("found '7' in column 9"));
    EXPECT_THAT(refusal(file(facts, names, "1\t0\t1\t2,5\t3\t4\t5\t6\n")),
                HasSubstr("trc line 7: expected a coordinate y of 'chin'"));
    EXPECT_THAT(refusal(file(facts, names, "1\t0\t1\tinf\t3\t4\t5\t6\n")), HasSubstr("found 'inf'"));
    EXPECT_THAT(refusal(file(facts, names, "1\t1\t1\t2\t3\t4\t5\t6\n2\t0\t1\t2\t3\t4\t5\t6\n")),
                HasSubstr("expected a time from 1"));
    EXPECT_THAT(refusal(file(facts, names, "1\t0\t\t\t\t0\t0\t0\n")), HasSubstr("no sample at all"));
}

TEST(Trc, reads_names_times_samples_and_unit) {
    const Take take = parse(file(facts, names, rows));
    EXPECT_EQ(take.points, (std::vector<std::string>{"chin", "brow"}));
    EXPECT_EQ(take.times, (std::vector<double>{0, 0.5}));
    EXPECT_EQ(take.samples, (std::vector<Vec3>{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {10, 11, 12}}));
    EXPECT_EQ(take.unit, "cm");
    EXPECT_FALSE(take.planar);
}

TEST(Trc, names_may_stand_once_per_axis) {
    EXPECT_EQ(parse(file(facts, "chin_x\tchin_y\tchin_z\tb_X\tb_Y\tb_Z", rows)).points,
              (std::vector<std::string>{"chin", "b"}));
}

TEST(Trc, the_number_of_frames_may_lie) {
    EXPECT_EQ(row_count(parse(file("60\t60\t1000000000\t2\tcm", names, rows))), 2U);
}

TEST(Trc, blank_nan_and_zero_samples_are_lost_whole) {
    const Take take =
        parse(file(facts, names, "1\t0\t\t\t\t0\t0\t0\n2\t1\tNaN\t1\t2\t0\t0\t1\n3\t2\t1\t\t2\t-0\t0\t0\n"));
    for (const std::size_t lost : {0U, 1U, 2U, 4U}) EXPECT_TRUE(std::isnan(take.samples[lost].y)) << lost;
    EXPECT_EQ(take.samples[3], (Vec3{0, 0, 1}));
    EXPECT_EQ(take.samples[5], Vec3{});
}

TEST(Trc, the_later_of_two_rows_at_one_time_stands) {
    const Take take = parse(file(facts, names, "1\t0\t1\t1\t1\t1\t1\t1\n2\t0\t2\t2\t2\t2\t2\t2\n"));
    EXPECT_EQ(take.samples, (std::vector<Vec3>{{2, 2, 2}, {2, 2, 2}}));
    EXPECT_EQ(take.repeated_rows, 1U);
}

TEST(Trc, what_is_written_reads_back_equal) {
    Take take{{"a b", "c"}, {-0.1, 1e9 + 1.0 / 3}, {{0.1, 1e-300, -3}, lost_sample, {}, {1.0 / 3, 0, 0}}, {}, "m"};
    const Take again = parse(format_trc(take));
    EXPECT_EQ(again.points, take.points);
    EXPECT_EQ(again.times, take.times);
    EXPECT_EQ(again.unit, "m");
    for (const std::size_t s : {0U, 2U, 3U}) EXPECT_EQ(again.samples[s], take.samples[s]);
    EXPECT_TRUE(std::isnan(again.samples[1].x));
    take.points[0] = "a\tb";
    EXPECT_THROW(format_trc(take), Error);
    take.points[0] = "a b";
    take.unit = "ft";
    EXPECT_THROW(format_trc(take), Error);
}

TEST(Trc, times_too_close_for_a_rate_are_written_and_read_back) {
    const Take take{{"a"}, {0, 1e-320}, {{1, 2, 3}, {4, 5, 6}}, {}, "mm"};
    EXPECT_TRUE(hostile::equal(take, parse(format_trc(take))));
}

TEST(Trc, real_markers_read_with_their_counts) {
    const std::filesystem::path path = std::filesystem::path(MIEN_SHARED) / "data/markers-41/jaw.trc";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is absent";
    std::ifstream in(path, std::ios::binary);
    const Take take = parse(std::string(std::istreambuf_iterator<char>(in), {}));
    EXPECT_EQ(take.points.size(), 41U);
    EXPECT_EQ(row_count(take), 1590U);
    EXPECT_EQ(take.samples[0], (Vec3{14.123840, 84.155664, 3.480625}));
}

TEST(Trc, survives_every_prefix_and_every_changed_byte) {
    hostile::sweep(parse_trc, file(facts, names, rows), [](const Take& take) { return hostile::keeps_promise(take); });
}

}  // namespace
}  // namespace mien
