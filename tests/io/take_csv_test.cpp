// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/io/take_csv.hpp"

#include <gtest/gtest.h>

#include "io/hostile.hpp"

namespace mien {
namespace {

using testing::HasSubstr;

std::string refusal(std::string_view text) {
    return hostile::refusal(parse_take_csv, text);
}

Take parse(std::string_view text) {
    return parse_take_csv(hostile::Copy(text).bytes());
}

const std::string heading = "time,2.1.x,2.1.y,2.1.z,8.4_x,8.4_y,8.4_z\n";
const std::string table = heading + "0,1,2,3,4,5,6\n0.5,7,8,9,10,11,12\n";

TEST(TakeCsv, refuses_what_breaks_its_promise_and_names_the_place) {
    EXPECT_THAT(refusal(""), HasSubstr("empty file"));
    EXPECT_THAT(refusal("0,1,2\n"), HasSubstr("csv line 1: column 1: expected time"));
    EXPECT_THAT(refusal("time;a_x;a_y\n"), HasSubstr("not semicolons"));
    EXPECT_THAT(refusal("time\n0\n"), HasSubstr("expected columns <point>.x"));
    EXPECT_THAT(refusal("time,a .x,a .y\n0,1,2\n"), HasSubstr("on one line"));
    EXPECT_THAT(refusal("a.x,a.y\n"), HasSubstr("expected a column time"));
    EXPECT_THAT(refusal("time,a.x\n"), HasSubstr("expected a column y of point 'a'"));
    EXPECT_THAT(refusal("time,a.x,a.y,a.z,b.x,b.y\n"), HasSubstr("expected a column z of point 'b'"));
    EXPECT_THAT(refusal("time,a.x,a_x,a.y\n"), HasSubstr("twice"));
    EXPECT_THAT(refusal(heading), HasSubstr("expected rows"));
    EXPECT_THAT(refusal(heading + "0,1,2\n"), HasSubstr("csv line 2: expected 7 cells, found 3"));
    EXPECT_THAT(refusal(heading + "0,1,2,3,4,5,6,7\n"), HasSubstr("found 8"));
    EXPECT_THAT(refusal(heading + "x,1,2,3,4,5,6\n"), HasSubstr("expected a time in seconds, found 'x'"));
    EXPECT_THAT(refusal(heading + "0,1,2,3,4,5x,6\n"), HasSubstr("coordinate y of '8.4'"));
    EXPECT_THAT(refusal(heading + "0,1,2,3,4,5,1e16\n"), HasSubstr("within 1e15"));
    EXPECT_THAT(refusal(heading + "1,1,2,3,4,5,6\n0,1,2,3,4,5,6\n"), HasSubstr("csv line 3: expected a time from 1"));
    EXPECT_THAT(refusal(heading + "0,,,,nan,5,6\n"), HasSubstr("no sample at all"));
    EXPECT_THAT(refusal(heading + "0,\"1,2,3,4,5,6\n"), HasSubstr("closing quote"));
    EXPECT_THAT(refusal(table + std::string(1, '\0')), HasSubstr("NUL"));
}

TEST(TakeCsv, reads_ids_with_dots_either_suffix_any_order_bom_and_quotes) {
    const Take plain = parse(table);
    EXPECT_EQ(plain.points, (std::vector<std::string>{"2.1", "8.4"}));
    EXPECT_EQ(plain.samples, (std::vector<Vec3>{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {10, 11, 12}}));
    const Take other = parse(
        "\xef\xbb\xbf"
        "\"2.1_z\", 2.1.x,time,\"2.1_y\"\r\n3,\"1\",0,2\r\n\r\n");
    EXPECT_EQ(other.samples, (std::vector<Vec3>{{1, 2, 3}}));
}

TEST(TakeCsv, without_z_the_take_is_planar) {
    const Take take = parse("time,a.x,a.y\n0,1,2\n1,0,0\n");
    EXPECT_TRUE(take.planar);
    EXPECT_EQ(take.samples[0], (Vec3{1, 2, 0}));
    EXPECT_TRUE(std::isnan(take.samples[1].x));
    EXPECT_EQ(format_take_csv(take), "time,a.x,a.y\n0,1,2\n1,,\n");
}

TEST(TakeCsv, one_lost_coordinate_loses_the_sample) {
    const Take take = parse(heading + "0,1,,3,0,0,0\n1,NaN,1,1,4,5,6\n");
    for (const std::size_t lost : {0U, 1U, 2U}) EXPECT_TRUE(std::isnan(take.samples[lost].z)) << lost;
    EXPECT_EQ(take.samples[3], (Vec3{4, 5, 6}));
}

TEST(TakeCsv, epoch_times_keep_their_differences) {
    const Take take = parse("time,a.x,a.y\n1448841600.000000,1,1\n1448841600.033333,1,1\n");
    EXPECT_NEAR(take.times[1] - take.times[0], 0.033333, 3e-7);
}

TEST(TakeCsv, the_later_of_two_rows_at_one_time_stands) {
    const Take take = parse("time,a.x,a.y\n0,1,1\n0,2,2\n1,3,3\n");
    EXPECT_EQ(take.times, (std::vector<double>{0, 1}));
    EXPECT_EQ(take.samples[0], (Vec3{2, 2, 0}));
    EXPECT_EQ(take.repeated_rows, 1U);
}

TEST(TakeCsv, what_is_written_reads_back_equal) {
    const Take take{
        {"2.1", "a,\"b"}, {-0.1, 1e9 + 1.0 / 3}, {{0.1, 1e-300, -3}, lost_sample, {}, {1.0 / 3, 0, 0}}, {}, ""};
    const Take again = parse(format_take_csv(take));
    EXPECT_EQ(again.points, take.points);
    EXPECT_EQ(again.times, take.times);
    for (const std::size_t s : {0U, 2U, 3U}) EXPECT_EQ(again.samples[s], take.samples[s]);
    EXPECT_TRUE(std::isnan(again.samples[1].x));
}

TEST(TakeCsv, survives_every_prefix_and_every_changed_byte) {
    hostile::sweep(parse_take_csv, table + "1,\"1\",2,3,,,\n",
                   [](const Take& take) { return hostile::keeps_promise(take); });
}

}  // namespace
}  // namespace mien
