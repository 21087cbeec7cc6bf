// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/check_mesh.hpp"

#include <array>
#include <gtest/gtest.h>

#include "shapes.hpp"

namespace mien {
namespace {

TEST(CheckMesh, an_empty_mesh_has_nothing_to_count) {
    const MeshCheck check = check_mesh({});
    EXPECT_EQ(check.places, 0U);
    EXPECT_EQ(check.islands, 0U);
    EXPECT_EQ(check.border_edges, 0U);
}

TEST(CheckMesh, the_rim_of_a_grid_is_its_perimeter) {
    const MeshCheck check = check_mesh(shapes::grid(3, 2));
    EXPECT_EQ(check.border_edges, 2U * (3 + 2));
    EXPECT_EQ(check.quads, 6U);
    EXPECT_EQ(check.islands, 1U);
    EXPECT_EQ(check.nonmanifold_edges + check.mixed_edges + check.flat_faces + check.repeated_faces, 0U);
}

TEST(CheckMesh, two_grids_apart_are_two_islands_and_side_by_side_one) {
    Mesh apart = shapes::grid(1, 1);
    shapes::append(apart, shapes::grid(1, 1), {5, 0, 0});
    EXPECT_EQ(check_mesh(apart).islands, 2U);
    Mesh touching = shapes::grid(1, 1);
    shapes::append(touching, shapes::grid(1, 1), {1, 0, 0});
    EXPECT_EQ(check_mesh(touching).islands, 1U);
    EXPECT_EQ(check_mesh(touching).places, 6U);
    EXPECT_EQ(check_mesh(touching).border_edges, 6U);
}

TEST(CheckMesh, finds_a_fin_a_turned_face_a_flat_face_and_a_repeated_face) {
    Mesh fin = shapes::grid(2, 1);
    fin.positions.push_back({1, 0.5F, 1});
    add_face(fin, std::array{1U, 4U, 6U});
    EXPECT_EQ(check_mesh(fin).nonmanifold_edges, 1U);

    Mesh turned = shapes::grid(1, 1);
    turned.positions.push_back({2, 0, 0});
    add_face(turned, std::array{1U, 3U, 4U});
    EXPECT_EQ(check_mesh(turned).mixed_edges, 1U);

    Mesh flat = shapes::grid(2, 1);
    add_face(flat, std::array{0U, 1U, 2U});
    EXPECT_EQ(check_mesh(flat).flat_faces, 1U);

    Mesh twice = shapes::grid(1, 1);
    add_face(twice, std::array{1U, 3U, 2U, 0U});
    EXPECT_EQ(check_mesh(twice).repeated_faces, 1U);
}

TEST(CheckMesh, an_unused_vertex_is_counted_and_is_no_island) {
    Mesh mesh = shapes::grid(1, 1);
    mesh.positions.push_back({9, 9, 9});
    EXPECT_EQ(check_mesh(mesh).unused_vertices, 1U);
    EXPECT_EQ(check_mesh(mesh).islands, 1U);
}

}  // namespace
}  // namespace mien
