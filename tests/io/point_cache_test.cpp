// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/io/point_cache.hpp"

#include <gtest/gtest.h>
#include <sstream>

#include "io/text.hpp"
#include "shapes.hpp"

#include "mien/io/obj.hpp"

namespace mien {
namespace {

using namespace std::string_literals;

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
