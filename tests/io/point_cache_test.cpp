// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/io/point_cache.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <sstream>

#include "io/hostile.hpp"
#include "io/text.hpp"
#include "shapes.hpp"

#include "mien/io/obj.hpp"

namespace mien {
namespace {

using namespace std::string_literals;
using testing::ElementsAre;
using testing::HasSubstr;

// One triangle that is at x = row.
MeshSequence sequence() {
    MeshSequence result;
    result.mesh.positions.resize(3);
    add_face(result.mesh, std::array<std::uint32_t, 3>{0, 1, 2});
    result.times = {0, 0.5};
    result.positions = [](std::size_t row, std::span<Vec3f> positions) {
        for (Vec3f& p : positions) p = {static_cast<float>(row), 0, -2};
    };
    return result;
}

TEST(PointCache, mdd_is_big_endian_with_times_in_seconds) {
    std::ostringstream out;
    format_mdd(sequence(), out);
    const std::string bytes = out.str();
    ASSERT_EQ(bytes.size(), 8U + 4 * 2 + 12 * 2 * 3);
    EXPECT_EQ(bytes.substr(0, 16), "\0\0\0\2\0\0\0\3\0\0\0\0\x3f\0\0\0"s);
    EXPECT_EQ(bytes.substr(16 + 36, 12), "\x3f\x80\0\0\0\0\0\0\xc0\0\0\0"s);
}

TEST(PointCache, pc2_is_little_endian_with_one_sample_a_frame) {
    std::ostringstream out;
    format_pc2(sequence(), out);
    const std::string bytes = out.str();
    ASSERT_EQ(bytes.size(), 32U + 12 * 2 * 3);
    EXPECT_EQ(bytes.substr(0, 32), "POINTCACHE2\0\1\0\0\0\3\0\0\0\0\0\0\0\0\0\x80\x3f\2\0\0\0"s);
    EXPECT_EQ(bytes.substr(32 + 36, 12), "\0\0\x80\x3f\0\0\0\0\0\0\0\xc0"s);
}

std::string mdd() {
    std::ostringstream out;
    format_mdd(sequence(), out);
    return out.str();
}

std::string pc2() {
    std::ostringstream out;
    format_pc2(sequence(), out);
    return out.str();
}

MeshSequence read_mdd(std::span<const std::byte> bytes) {
    return parse_mdd({bytes.begin(), bytes.end()}, sequence().mesh);
}

MeshSequence read_pc2(std::span<const std::byte> bytes) {
    return parse_pc2({bytes.begin(), bytes.end()}, sequence().mesh, 25);
}

std::string with(std::string bytes, std::size_t at, const std::string& other) {
    return bytes.replace(at, other.size(), other);
}

TEST(PointCache, both_read_back_as_they_were_written) {
    for (const MeshSequence& read : {read_mdd(as_bytes(mdd())), read_pc2(as_bytes(pc2()))}) {
        ASSERT_EQ(read.times.size(), 2U);
        EXPECT_EQ(read.mesh.positions, sequence().mesh.positions);
        for (const std::size_t row : {1U, 0U}) {
            std::vector<Vec3f> positions(3), written(3);
            read.positions(row, positions);
            sequence().positions(row, written);
            EXPECT_EQ(positions, written);
        }
    }
}

TEST(PointCache, times_are_those_of_the_mdd_or_of_the_rate) {
    EXPECT_THAT(read_mdd(as_bytes(mdd())).times, ElementsAre(0, 0.5));
    EXPECT_THAT(read_mdd(as_bytes(with(mdd(), 8, "\x3e\x80\0\0"s))).times, ElementsAre(0, 0.25));
    const auto rated = [](const std::string& text) {
        const auto bytes = as_bytes(text);
        return parse_mdd({bytes.begin(), bytes.end()}, sequence().mesh, 10).times;
    };
    EXPECT_THAT(rated(mdd()), ElementsAre(0, 0.1));
    EXPECT_THAT(rated(with(mdd(), 12, "\0\0\0\0"s)), ElementsAre(0, 0.1));
    EXPECT_THAT(read_pc2(as_bytes(pc2())).times, ElementsAre(0, 0.04));
    EXPECT_THAT(read_pc2(as_bytes(with(pc2(), 24, "\0\0\0\x40"s))).times, ElementsAre(0, 0.08));
}

TEST(PointCache, what_is_wrong_is_told_with_its_byte) {
    const auto mdd_refusal = [](const std::string& text) { return hostile::refusal(read_mdd, text); };
    EXPECT_EQ(mdd_refusal(with(mdd(), 4, "\0\0\0\6\0\0\0\0\x3f"s).substr(0, 16) + std::string(144, '\0')),
              "mdd byte 4: expected 3 vertices as the head has, found 6");
    EXPECT_EQ(mdd_refusal(with(mdd(), 0, "\xff"s)), "mdd byte 0: expected one row or more, found -16777214");
    EXPECT_EQ(mdd_refusal(with(mdd(), 3, "\3"s)),
              "mdd byte 88: expected the end after 3 rows of 3 vertices from byte 20 on, found a file of 88 bytes");
    EXPECT_EQ(mdd_refusal(with(mdd(), 0, "\x7f\xff\xff\xff"s)),
              "mdd byte 88: expected the end after 2147483647 rows of 3 vertices from byte 8589934596 on, found a file "
              "of 88 bytes");
    const std::string row(36, '\0');
    EXPECT_EQ(mdd_refusal(mdd() + row),
              "mdd byte 124: expected the end after 2 rows of 3 vertices from byte 16 on, found a file of 124 bytes");
    EXPECT_THAT(mdd_refusal(mdd() + "x"), HasSubstr("found a file of 89 bytes"));
    EXPECT_EQ(mdd_refusal(with(mdd(), 20, "\x7f\xc0\0\0"s)), "mdd byte 20: expected a finite number, found nan");
    EXPECT_EQ(mdd_refusal(with(mdd(), 12, "\0\0\0\0"s)),
              "mdd byte 12: expected a time above that of the row before, or rows per second given, found 0");
    EXPECT_EQ(mdd_refusal("abc"), "mdd byte 3: expected a header of 8 bytes, found the end");
    const auto pc2_refusal = [](const std::string& text) { return hostile::refusal(read_pc2, text); };
    EXPECT_EQ(pc2_refusal(with(pc2(), 0, "p")), "pc2 byte 0: expected \"POINTCACHE2\", found 'pOINTCACHE2?'");
    EXPECT_EQ(pc2_refusal(with(pc2(), 12, "\2")), "pc2 byte 12: expected version 1, found 2");
    EXPECT_EQ(pc2_refusal(with(pc2(), 24, "\0\0\0\0"s)),
              "pc2 byte 24: expected a number of frames per row above 0, found 0");
    EXPECT_THAT(pc2_refusal(with(pc2(), 24, "\xff\xff\x7f\xff"s)), HasSubstr("frames per row above 0, found -"));
    EXPECT_THAT(pc2_refusal(with(pc2(), 24, "\0\0\xc0\x7f"s)), HasSubstr("frames per row above 0, found nan"));
    EXPECT_THAT(pc2_refusal(pc2() + row), HasSubstr("found a file of 140 bytes"));
    EXPECT_THAT(pc2_refusal(pc2().substr(0, 50)), HasSubstr("found a file of 50 bytes"));
}

TEST(PointCache, a_cache_says_what_it_holds_without_a_head) {
    const auto bytes_of = [](const std::string& text) {
        return std::vector<std::byte>(as_bytes(text).begin(), as_bytes(text).end());
    };
    const PointCacheContent of_mdd = check_mdd(bytes_of(mdd())), of_pc2 = check_pc2(bytes_of(pc2()));
    EXPECT_EQ(of_mdd.rows, 2U);
    EXPECT_EQ(of_pc2.rows, 2U);
    EXPECT_EQ(of_mdd.vertices, 3U);
    EXPECT_EQ(of_pc2.vertices, 3U);
    EXPECT_THAT(of_mdd.times, ElementsAre(0, 0.5));
    EXPECT_THAT(of_pc2.times, testing::IsEmpty());
}

TEST(PointCache, a_rate_is_needed_where_the_file_has_none_and_has_to_be_one) {
    const auto refused = [](double rate) {
        return hostile::refusal(
            [&](std::span<const std::byte> bytes) {
                return parse_pc2({bytes.begin(), bytes.end()}, sequence().mesh, rate);
            },
            pc2());
    };
    EXPECT_THAT(refused(0), HasSubstr("expected the frames per second to be given"));
    EXPECT_THAT(refused(-1), HasSubstr("above 0, found -1"));
    EXPECT_THAT(refused(std::numeric_limits<double>::infinity()), HasSubstr("above 0, found inf"));
}

TEST(PointCache, every_prefix_and_every_changed_byte_is_refused_or_read_whole) {
    hostile::sweep(read_mdd, mdd(), [](const MeshSequence& read) { return hostile::keeps_promise(read); });
    hostile::sweep(read_pc2, pc2(), [](const MeshSequence& read) { return hostile::keeps_promise(read); });
}

TEST(PointCache, an_obj_reads_back_with_polygons_groups_and_texture_coordinates) {
    Mesh mesh = shapes::grid(2, 1, 0.1F);
    mesh.parts = {{"left", 0, 0, 0, 5, 0, 1}, {"right", 1, 0, 1, 5, 1, 1}};
    for (std::size_t c = 0; c < 8; ++c) mesh.corner_uvs.push_back({0.125F * static_cast<float>(c), 0.25F});
    std::ostringstream out;
    format_obj(mesh, mesh.positions, out);
    const Mesh again = parse_obj(as_bytes(out.str()));
    EXPECT_EQ(again.positions, mesh.positions);
    EXPECT_EQ(again.face_starts, mesh.face_starts);
    EXPECT_EQ(again.face_vertices, mesh.face_vertices);
    EXPECT_EQ(again.corner_uvs, mesh.corner_uvs);
    ASSERT_EQ(again.parts.size(), 2U);
    EXPECT_EQ(again.parts[1].name, "right");
    EXPECT_EQ(again.parts[1].first_vertex, 1U);
}

}  // namespace
}  // namespace mien
