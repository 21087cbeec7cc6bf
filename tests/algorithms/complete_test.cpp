// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/complete.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>

#include "shapes.hpp"

#include "mien/algorithms/deform.hpp"
#include "mien/algorithms/rig_biharmonic.hpp"
#include "mien/error.hpp"

namespace mien {
namespace {

// A square skin with four corner-ward points, which the eye distance hangs on, and one in the middle.
Face skin() {
    Face face{shapes::grid(12, 12), {}};
    const auto at = [](std::uint32_t i, std::uint32_t j) { return j * 13 + i; };
    face.points = {shapes::point_at(face.mesh, "3.8", at(3, 3)), shapes::point_at(face.mesh, "3.7", at(9, 3)),
                   shapes::point_at(face.mesh, "3.12", at(3, 9)), shapes::point_at(face.mesh, "3.11", at(9, 9)),
                   shapes::point_at(face.mesh, "middle", at(6, 6))};
    return face;
}

Take corners_move(const Face& face) {
    Take take;
    take.times = {0, 1};
    take.points = {"3.8", "3.7", "3.12", "3.11"};
    const Vec3 moves[2][4] = {{}, {{0, 0, 1}, {0, 0, 2}, {0.5, 0, 0}, {0, 0.25, -1}}};
    for (const auto& row_moves : moves)
        for (std::size_t k = 0; k < 4; ++k) take.samples.push_back(face.points[k].position + row_moves[k]);
    return take;
}

TEST(Complete, refuses_a_take_that_drives_no_point) {
    Take take = corners_move(skin());
    take.points = {"e", "f", "g", "h"};
    EXPECT_THROW(complete(skin(), take), Error);
}

TEST(Complete, leaves_a_whole_take_as_it_is) {
    const Face face = skin();
    const std::vector<std::string> corners = {"3.8", "3.7", "3.12", "3.11"};
    EXPECT_EQ(complete(with_points(face, corners), corners_move(face)).samples, corners_move(face).samples);
}

TEST(Complete, keeps_the_driven_columns_and_the_neutral_row) {
    const Face face = skin();
    const Take all = complete(face, corners_move(face));
    ASSERT_EQ(all.points.size(), 5U);
    EXPECT_EQ(all.points.back(), "middle");
    EXPECT_EQ(row(all, 0)[4], face.points[4].position);
    EXPECT_EQ(row(all, 1)[1], row(corners_move(face), 1)[1]);
}

TEST(Complete, carries_a_driven_point_along_axes_on_which_it_does_not_move) {
    Face face = skin();
    Take take = corners_move(face);
    take.points.emplace_back("middle");
    for (std::size_t r = 0; r < 2; ++r)
        take.samples.insert(take.samples.begin() + static_cast<std::ptrdiff_t>(5 * r + 4),
                            face.points[4].position + static_cast<double>(r) * Vec3{3, 3, 3});
    EXPECT_EQ(complete(face, take).samples, take.samples);
    const Take without = complete(face, corners_move(face));  // all of it carried
    face.points[4].moves = {true, true, false};
    const Vec3 place = row(complete(face, take), 1)[4];
    EXPECT_EQ(place.x, row(take, 1)[4].x);
    EXPECT_EQ(place.y, row(take, 1)[4].y);
    EXPECT_NEAR(place.z, row(without, 1)[4].z, 1e-6);
    EXPECT_GT(std::abs(place.z - row(take, 1)[4].z), 1);
}

TEST(Complete, a_rig_of_all_points_then_moves_the_skin_like_a_rig_of_the_driven_ones) {
    const Face face = skin();
    const Take driven = corners_move(face);
    BiharmonicOptions all_influences;
    all_influences.influences = 0;
    const Rig few = rig_biharmonic(with_points(face, driven.points), all_influences);
    const Rig many = rig_biharmonic(face, all_influences);
    const MeshSequence by_few = deform(few, face.mesh, driven);
    const MeshSequence by_many = deform(many, face.mesh, complete(face, driven));
    std::vector<Vec3f> a(vertex_count(face.mesh)), b(vertex_count(face.mesh));
    by_few.positions(1, a);
    by_many.positions(1, b);
    double moved = 0;
    for (std::size_t v = 0; v < a.size(); ++v) {
        EXPECT_LT(distance(a[v], b[v]), 1e-4) << "vertex " << v;
        moved = std::max<double>(moved, distance(a[v], face.mesh.positions[v]));
    }
    EXPECT_GT(moved, 1);
}

}  // namespace
}  // namespace mien
