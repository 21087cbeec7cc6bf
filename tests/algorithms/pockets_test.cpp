// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "algorithms/pockets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <limits>

#include "algorithms/fill_pockets.hpp"
#include "rig_figures.hpp"
#include "shapes.hpp"

#include "mien/algorithms/attach.hpp"
#include "mien/algorithms/rig_biharmonic.hpp"
#include "mien/algorithms/surface_distance.hpp"

namespace mien {
namespace {

struct Ring {
    float radius, height;
};

constexpr std::uint32_t sectors = 24;
constexpr std::uint32_t lip_ring = 9;  // the last ring that is seen

// A surface turned about z: a ball of radius 1 that its opening at the top, nearly closed, leads into. Without a floor
// the skin inside simply ends. Vertex of ring r, sector s: r * sectors + s.
Face purse(bool with_floor) {
    std::vector<Ring> rings;
    for (std::uint32_t i = 0; i <= lip_ring; ++i) {
        const double polar = 3.14159265358979 * (0.9 - 0.8995 * i / lip_ring);
        rings.push_back({static_cast<float>(std::sin(polar)), static_cast<float>(std::cos(polar))});
    }
    for (const Ring inside : {Ring{0.15F, 0.85F}, Ring{0.3F, 0.7F}, Ring{0.35F, 0.5F}, Ring{0.3F, 0.3F}})
        rings.push_back(inside);
    Face face;
    for (const Ring& ring : rings)
        for (std::uint32_t s = 0; s < sectors; ++s) {
            const double round = 2 * 3.14159265358979 * s / sectors;
            face.mesh.positions.push_back({ring.radius * static_cast<float>(std::cos(round)),
                                           ring.radius * static_cast<float>(std::sin(round)), ring.height});
        }
    for (std::uint32_t r = 0; r + 1 < rings.size(); ++r)
        for (std::uint32_t s = 0; s < sectors; ++s) {
            const std::uint32_t a = r * sectors, next = (s + 1) % sectors;
            add_face(face.mesh, std::array{a + s, a + next, a + sectors + next, a + sectors + s});
        }
    if (with_floor) {
        std::vector<std::uint32_t> floor;
        for (std::uint32_t s = 0; s < sectors; ++s)
            floor.push_back(static_cast<std::uint32_t>((rings.size() - 1) * sectors) + s);
        add_face(face.mesh, floor);
    }
    const auto add = [&](const char* id, std::uint32_t ring, std::uint32_t sector) {
        face.points.push_back(shapes::point_at(face.mesh, id, ring * sectors + sector));
    };
    add("8.1", lip_ring - 1, 6), add("8.2", lip_ring - 1, 18), add("3.1", 5, 0), add("3.2", 5, 12);
    return face;
}

std::vector<bool> pockets(const Face& face) {
    const Weld joined = weld(face.mesh);
    return closed_pockets(face, joined, std::vector<bool>(joined.vertex.size(), true));
}

std::size_t count(const std::vector<bool>& marked) {
    return static_cast<std::size_t>(std::count(marked.begin(), marked.end(), true));
}

TEST(Pockets, ABagBehindLipsIsOneAndTheFaceIsNot) {
    const std::vector<bool> marked = pockets(purse(true));
    for (std::uint32_t v = 0; v < marked.size(); ++v) EXPECT_EQ(marked[v], v >= (lip_ring + 1) * sectors) << v;
}

TEST(Pockets, SkinThatEndsBehindLipsIsNone) {
    EXPECT_EQ(count(pockets(purse(false))), 0U);
}

TEST(Pockets, ABagThatIsNotBehindALidOrLipIsNone) {
    Face face = purse(true);
    face.points[0].id = "9.3";
    face.points[1].id = "9.15";
    EXPECT_EQ(count(pockets(face)), 0U);
}

TEST(Pockets, AFaceThatIsInsideOutHasTheSameOnes) {
    Face face = purse(true);
    for (std::size_t f = 0; f < face_count(face.mesh); ++f)
        std::reverse(face.mesh.face_vertices.begin() + face.mesh.face_starts[f],
                     face.mesh.face_vertices.begin() + face.mesh.face_starts[f + 1]);
    EXPECT_EQ(pockets(face), pockets(purse(true)));
}

TEST(Pockets, WhatFillsABagHidesItsWallsFromAnOpenMouth) {
    Face face = purse(true);
    for (std::uint32_t v = 0; v < face.mesh.positions.size(); ++v)  // the mouth opens by a third of the head's width
        if (v / sectors == lip_ring) {
            Vec3f& p = face.mesh.positions[v];
            const float wide = 0.33F / std::hypot(p.x, p.y);
            p = {p.x * wide, p.y * wide, 0.9F};
        }
    face.points[0] = shapes::point_at(face.mesh, "8.1", lip_ring * sectors + 6);
    face.points[1] = shapes::point_at(face.mesh, "8.2", lip_ring * sectors + 18);
    EXPECT_EQ(count(pockets(face)), 0U);
    const Weld skin = weld(face.mesh);
    std::vector<bool> solved(skin.vertex.size(), true);
    shapes::append(face.mesh, shapes::ball({0, 0, 0.62F}, 0.3F));
    const Weld joined = weld(face.mesh);
    solved.resize(joined.vertex.size(), false);
    EXPECT_GT(count(closed_pockets(face, joined, solved)), 2 * sectors);
}

std::vector<bool> all_skin(const Weld& joined) {
    return std::vector<bool>(joined.vertex.size(), true);
}

Pockets lined(const Face& face, const Weld& joined) {
    return line_pockets(face, joined, all_skin(joined), pockets(face), 1);
}

TEST(Pockets, AreFilledBetweenTheMotionsOfTheirRim) {
    const Face face = purse(true);
    const Weld joined = weld(face.mesh);
    Pockets bag = lined(face, joined);
    bag.outside = bag.places;  // there is no flesh
    Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(std::ssize(joined.vertex), 1);
    for (std::uint32_t p = 0; p < joined.vertex.size(); ++p) weights(p, 0) = face.mesh.positions[p].y > 0 ? 0.75 : 0.25;
    const Eigen::MatrixXd filled = fill_pockets(face.mesh, joined, bag, weights);
    EXPECT_GT(filled.minCoeff(), 0.25);
    EXPECT_LT(filled.maxCoeff(), 0.75);
    EXPECT_NEAR(filled.mean(), 0.5, 0.02);
}

TEST(Pockets, HaveTheSkinOutsideBeyondTheFlesh) {
    const Face face = purse(true);
    const Weld joined = weld(face.mesh);
    const Pockets bag = lined(face, joined);
    for (std::size_t i = 0; i < bag.places.size(); ++i) {
        const Vec3 wall = to_double(face.mesh.positions[bag.places[i]]);
        const Vec3 skin = to_double(face.mesh.positions[bag.outside[i]]);
        EXPECT_LE(bag.outside[i], lip_ring * sectors + sectors - 1);
        EXPECT_GT(skin.x * wall.x + skin.y * wall.y, 0) << "not across the bag";
        EXPECT_GT(length(skin), length(wall));
        EXPECT_NEAR(bag.shares[i], std::exp(-std::pow(distance(wall, skin) / 0.4, 2)), 1e-12);
    }
}

// Of a head whose lips touch: how much nearer a place is to the inner edge of the upper lip than to that of the lower,
// along the surface.
std::vector<double> towards_upper_lip(const Face& face, const Weld& joined) {
    const EdgeGraph graph = edge_graph(face.mesh, joined);
    std::vector<double> ways[2];
    for (int lip = 0; lip < 2; ++lip) {
        ways[lip].assign(joined.vertex.size(), std::numeric_limits<double>::infinity());
        for (const char* id : lip == 0 ? std::array{"2.2", "2.6", "2.7"} : std::array{"2.3", "2.8", "2.9"}) {
            const FeaturePoint& point = face.points[find_point(face.points, id).value()];
            const auto way = surface_distances(graph, joined.place[point.vertex]);
            for (std::size_t p = 0; p < way.size(); ++p) ways[lip][p] = std::min(ways[lip][p], way[p]);
        }
    }
    std::vector<double> nearer(joined.vertex.size());
    for (std::size_t p = 0; p < nearer.size(); ++p) nearer[p] = ways[1][p] - ways[0][p];
    return nearer;
}

TEST(Pockets, BehindOneLipDoNotFollowTheOtherThatTouchesIt) {
    if (!std::filesystem::exists(figures::folder("mh-caucasian"))) GTEST_SKIP() << "no MakeHuman head";
    const Face face = figures::read_pocket_subject().face;
    const Weld joined = weld(face.mesh);
    const double eyes = eye_distance(face.points);
    const std::vector<bool> solved = solved_places(face, joined);
    const Pockets bag = line_pockets(face, joined, solved, closed_pockets(face, joined, solved), eyes);
    const std::vector<double> upper = towards_upper_lip(face, joined);
    std::size_t compared = 0;
    for (std::size_t i = 0; i < bag.places.size(); ++i) {
        const double wall = upper[bag.places[i]], skin = upper[bag.outside[i]];
        if (!(std::abs(wall) > 0.2 * eyes) || !(std::abs(skin) > 0.2 * eyes)) continue;
        ++compared;
        EXPECT_EQ(wall > 0, skin > 0) << joined.vertex[bag.places[i]];
    }
    EXPECT_GT(compared, 50U);
}

// Deep in a bag the walls go with the skin on the other side of the flesh, the less the thicker that is, whatever the
// rim does.
TEST(Pockets, FollowTheSkinOutsideDeepDown) {
    const Face face = purse(true);
    const Weld joined = weld(face.mesh);
    Pockets bag = lined(face, joined);
    Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(std::ssize(joined.vertex), 1);
    weights.topRows(lip_ring * sectors).setConstant(0.5);  // the rim alone keeps still
    bag.softness = 0.02;
    bag.shares.assign(bag.places.size(), 0.8);
    EXPECT_NEAR(fill_pockets(face.mesh, joined, bag, weights).bottomRows(sectors).minCoeff(), 0.4, 0.01);
    bag.softness = 20;
    EXPECT_LT(fill_pockets(face.mesh, joined, bag, weights).maxCoeff(), 0.01);
}

// What the rest of a face does must not depend on what is hidden behind its lips.
TEST(Pockets, TheFaceMovesAsIfTheyWereNotThere) {
    const Face whole = purse(true);
    Face outside{{}, whole.points};
    outside.mesh.positions = whole.mesh.positions;
    for (std::uint32_t f = 0; f < lip_ring * sectors; ++f) add_face(outside.mesh, face(whole.mesh, f));
    const BiharmonicOptions all{.influences = 0};
    const Rig with = rig_biharmonic(whole, all), without = rig_biharmonic(outside, all);
    constexpr std::uint32_t seen_vertices = (lip_ring + 1) * sectors;
    const std::uint32_t seen = with.row_starts[seen_vertices];
    ASSERT_EQ(without.row_starts[seen_vertices], seen);
    for (std::uint32_t e = 0; e < seen; ++e) EXPECT_EQ(with.weights[e], without.weights[e]);
    EXPECT_GT(with.weights.size(), seen);
}

}  // namespace
}  // namespace mien
