// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/surface_distance.hpp"

#include <cmath>
#include <gmock/gmock.h>

#include "shapes.hpp"

namespace mien {
namespace {

using testing::ElementsAre;

constexpr double infinity = std::numeric_limits<double>::infinity();

EdgeGraph graph_of(const Mesh& mesh) {
    return edge_graph(mesh, weld(mesh));
}

TEST(EdgeGraph, IsEmptyForNoVertices) {
    EXPECT_THAT(graph_of(Mesh{}).starts, ElementsAre(0));
}

TEST(EdgeGraph, RunsAlongPolygonSidesOnlyInBothDirections) {
    const EdgeGraph graph = graph_of(shapes::grid(1, 1));
    EXPECT_THAT(graph.starts, ElementsAre(0, 2, 4, 6, 8));
    EXPECT_THAT(graph.neighbours, ElementsAre(1, 2, 0, 3, 0, 3, 1, 2));
    EXPECT_THAT(graph.lengths, testing::Each(1.0));
}

TEST(EdgeGraph, IsUnharmedByRepeatedFlippedAndFlatFaces) {
    Mesh mesh = shapes::strip(3);
    const EdgeGraph clean = graph_of(mesh);
    add_face(mesh, std::array{0U, 1U, 5U, 4U});
    add_face(mesh, std::array{4U, 5U, 1U, 0U});
    add_face(mesh, std::array{2U, 2U, 2U});
    add_face(mesh, std::array{1U, 2U, 1U});
    const EdgeGraph same = graph_of(mesh);
    EXPECT_EQ(same.starts, clean.starts);
    EXPECT_EQ(same.neighbours, clean.neighbours);
}

TEST(SurfaceDistance, IsTheTaxicabDistanceOnAGridOfQuads) {
    constexpr std::uint32_t n = 7;
    const auto distances = surface_distances(graph_of(shapes::grid(n, n, 0.5F)), 2 * (n + 1) + 3);
    for (std::uint32_t j = 0; j <= n; ++j)
        for (std::uint32_t i = 0; i <= n; ++i)
            EXPECT_DOUBLE_EQ(distances[j * (n + 1) + i], 0.5 * (std::abs(int(i) - 3) + std::abs(int(j) - 2)));
}

TEST(SurfaceDistance, IsInfiniteWhereNoPathLeads) {
    Mesh mesh = shapes::strip(1);
    shapes::append(mesh, shapes::strip(1), {0, 0, 1e-3F});
    EXPECT_THAT(surface_distances(graph_of(mesh), 0), ElementsAre(0, 1, 1, 2, infinity, infinity, infinity, infinity));
}

TEST(SurfaceDistance, CrossesSeamsOfSplitVertices) {
    Mesh mesh = shapes::strip(1);
    shapes::append(mesh, shapes::strip(1), {1, 0, 0});
    const Weld w = weld(mesh);
    EXPECT_DOUBLE_EQ(surface_distances(edge_graph(mesh, w), 0)[w.place[5]], 2);
}

TEST(SurfaceDistance, GoesRoundASlit) {
    // Two strips that lie on each other and share only their left edge: the right ends touch in space, but the way
    // between them leads round the corner.
    Mesh mesh = shapes::strip(4);
    const std::uint32_t upper = 10;
    for (std::uint32_t i = 1; i <= 4; ++i) mesh.positions.push_back({static_cast<float>(i), 0, 1e-4F});
    for (std::uint32_t i = 1; i <= 4; ++i) mesh.positions.push_back({static_cast<float>(i), 1, 1e-4F});
    add_face(mesh, std::array{0U, upper, upper + 4, 5U});
    for (std::uint32_t i = 0; i < 3; ++i)
        add_face(mesh, std::array{upper + i, upper + i + 1, upper + i + 5, upper + i + 4});
    EXPECT_NEAR(surface_distances(graph_of(mesh), 4)[upper + 3], 8, 1e-6);
}

TEST(SurfaceDistance, IsSymmetricAndKeepsTheTriangleInequality) {
    Mesh mesh = shapes::grid(9, 9);
    for (std::size_t v = 0; v < vertex_count(mesh); ++v)
        mesh.positions[v].z = std::sin(1.7F * static_cast<float>(v)) + 0.1F * mesh.positions[v].x;
    const EdgeGraph graph = graph_of(mesh);
    const auto from_0 = surface_distances(graph, 0);
    const auto from_57 = surface_distances(graph, 57);
    EXPECT_NEAR(from_0[57], from_57[0], 1e-12);
    for (std::size_t p = 0; p < from_0.size(); ++p) {
        EXPECT_LE(from_0[57], from_0[p] + from_57[p] + 1e-12);
        EXPECT_GE(from_0[p], distance(mesh.positions[0], mesh.positions[p]) - 1e-5);
    }
}

TEST(SurfaceDistance, LeavesWhatLiesBeyondTheLimit) {
    EXPECT_THAT(surface_distances(graph_of(shapes::strip(3)), 0, 2),
                ElementsAre(0, 1, 2, infinity, 1, 2, infinity, infinity));
}

}  // namespace
}  // namespace mien
