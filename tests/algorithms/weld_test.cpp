// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/weld.hpp"

#include <gmock/gmock.h>
#include <limits>

#include "shapes.hpp"

#include "mien/error.hpp"

namespace mien {
namespace {

using testing::ElementsAre;

Mesh vertices(std::vector<Vec3f> positions) {
    Mesh mesh;
    mesh.positions = std::move(positions);
    return mesh;
}

TEST(Weld, RefusesAToleranceThatWouldFuseLips) {
    const Mesh mesh = shapes::grid(1, 1);
    for (const double bad : {-1e-9, 1.1e-4, 1.0, std::numeric_limits<double>::quiet_NaN()})
        EXPECT_THROW((void)weld(mesh, {bad}), Error) << bad;
    EXPECT_NO_THROW((void)weld(mesh, {1e-4}));
}

TEST(Weld, HasNoPlacesWithoutVertices) {
    EXPECT_TRUE(weld(Mesh{}).vertex.empty());
    EXPECT_TRUE(islands(Mesh{}, Weld{}).empty());
}

TEST(Weld, NumbersPlacesByFirstAppearance) {
    const Weld w = weld(vertices({{0, 0, 0}, {1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {1, 0, 0}}));
    EXPECT_THAT(w.place, ElementsAre(0, 1, 0, 2, 1));
    EXPECT_THAT(w.vertex, ElementsAre(0, 1, 3));
}

TEST(Weld, JoinsWithinTheToleranceAcrossCellsOnEveryAxis) {
    // Height 1, tolerance 1e-4: pairs 0.9e-4 apart join wherever they lie in the grid, pairs 1.2e-4 apart never do.
    for (int axis = 0; axis < 3; ++axis)
        for (int k = 0; k < 40; ++k) {
            const float at = 0.1F + 1.7e-5F * static_cast<float>(k);
            const auto place_of = [&](float gap) {
                Vec3f near{at, at, at};
                (axis == 0 ? near.x : axis == 1 ? near.y : near.z) += gap;
                return weld(vertices({{0, 0, 0}, {0, 1, 0}, {at, at, at}, near}), {1e-4}).place[3];
            };
            EXPECT_EQ(place_of(0.9e-4F), 2U) << axis << " " << k;
            EXPECT_EQ(place_of(1.2e-4F), 3U) << axis << " " << k;
        }
}

TEST(Weld, JoinsEqualPositionsOnlyAtToleranceZero) {
    const float next = std::nextafter(1.0F, 2.0F);
    EXPECT_THAT(weld(vertices({{1, 0, 0}, {next, 0, 0}, {1, 0, -0.0F}, {1, 5, 0}}), {0}).place,
                ElementsAre(0, 1, 0, 2));
}

TEST(Weld, IsTheSameAtEveryScaleAndOffset) {
    Mesh mesh = shapes::grid(5, 5);
    shapes::append(mesh, shapes::grid(5, 5), {5, 0, 0});
    const Weld base = weld(mesh);
    EXPECT_EQ(base.vertex.size(), 36U + 30U);
    for (const float scale : {1e-30F, 1e-6F, 1e6F, 1e30F}) {
        Mesh other = mesh;
        for (Vec3f& p : other.positions) p = scale * p;
        EXPECT_EQ(weld(other).place, base.place) << scale;
    }
    Mesh moved = mesh;
    for (Vec3f& p : moved.positions) p += {1e5F, -1e5F, 1e5F};
    EXPECT_EQ(weld(moved).place, base.place);
}

TEST(Weld, TakesEqualPositionsInLinearTimeAndFlatMeshes) {
    EXPECT_EQ(weld(vertices(std::vector<Vec3f>(200000, {1, 2, 3}))).vertex.size(), 1U);
    Mesh flat = shapes::grid(300, 300);
    for (Vec3f& p : flat.positions) p = {p.x, 0, p.y};  // no height: equal positions only
    EXPECT_EQ(weld(flat).vertex.size(), vertex_count(flat));
}

TEST(Weld, DoesNotCollapseAChainOfNearVertices) {
    std::vector<Vec3f> chain{{0, 0, 0}, {0, 1, 0}};
    for (int k = 1; k <= 20; ++k) chain.push_back({6e-5F * static_cast<float>(k), 0, 0});
    const Weld w = weld(vertices(chain), {1e-4});
    for (std::size_t v = 0; v < chain.size(); ++v) EXPECT_LE(distance(chain[v], chain[w.vertex[w.place[v]]]), 1e-4F);
    EXPECT_GE(w.vertex.size(), 10U);
}

TEST(Islands, AreNumberedByFirstAppearanceAndCountUnusedVertices) {
    Mesh mesh = shapes::strip(2);
    mesh.positions.push_back({9, 9, 9});
    shapes::append(mesh, shapes::strip(1), {0, 5, 0});
    EXPECT_THAT(islands(mesh, weld(mesh)), ElementsAre(0, 0, 0, 0, 0, 0, 1, 2, 2, 2, 2));
}

TEST(Islands, AreJoinedThroughWeldedSeams) {
    Mesh mesh = shapes::strip(2);
    shapes::append(mesh, shapes::strip(2), {2, 0, 0});
    const Weld w = weld(mesh);
    EXPECT_THAT(islands(mesh, w), testing::Each(0U));
    EXPECT_THAT(islands(mesh, weld(mesh, {0})), testing::Each(0U));
}

}  // namespace
}  // namespace mien
