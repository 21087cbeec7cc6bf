// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/carry_shapes.hpp"

#include <algorithm>
#include <gmock/gmock.h>
#include <tbb/global_control.h>

#include "algorithms/nearest_places.hpp"
#include "shapes.hpp"

#include "mien/error.hpp"

namespace mien {
namespace {

// A soft motion round the left mouth corner of the mask, as a field of space.
Vec3f field(const Vec3f& p) {
    const Vec3f off = p - Vec3f{0.4F, -0.8F, -0.2F};
    return std::exp(-3 * dot(off, off)) * Vec3f{0.1F, 0.15F, 0.05F};
}

MorphTarget shape_on(const Mesh& mesh) {
    MorphTarget shape{"smile", {}, {}};
    for (std::uint32_t v = 0; v < vertex_count(mesh); ++v) {
        shape.vertices.push_back(v);
        shape.deltas.push_back(field(mesh.positions[v]));
    }
    return shape;
}

// The dome of the mask from 35 x 29 quads that are cut into triangles, with the mask's points at the nearest vertices.
Face other_topology() {
    Face face;
    const Mesh fine = shapes::grid(35, 29, 1);
    face.mesh.positions = fine.positions;
    for (Vec3f& p : face.mesh.positions) {
        p = {p.x * 3 / 35 - 1.5F, p.y * 3 / 29 - 2.0F, 0};
        p.z = -0.3F * (p.x * p.x + 0.5F * p.y * p.y);
    }
    for (std::size_t f = 0; f < face_count(fine); ++f) {
        const auto c = mien::face(fine, f);
        add_face(face.mesh, std::array{c[0], c[1], c[2]});
        add_face(face.mesh, std::array{c[0], c[2], c[3]});
    }
    for (const FeaturePoint& point : shapes::mask().points) {
        const auto nearest = std::min_element(
            face.mesh.positions.begin(), face.mesh.positions.end(), [&](const Vec3f& a, const Vec3f& b) {
                return distance(to_double(a), point.position) < distance(to_double(b), point.position);
            });
        face.points.push_back(
            shapes::point_at(face.mesh, point.id, static_cast<std::uint32_t>(nearest - face.mesh.positions.begin())));
    }
    return face;
}

std::vector<Vec3f> dense(const MorphTarget& shape, std::size_t vertices) {
    std::vector<Vec3f> moves(vertices);
    for (std::size_t i = 0; i < shape.vertices.size(); ++i) moves[shape.vertices[i]] = shape.deltas[i];
    return moves;
}

// RMS distance of a carried shape to the field on the target, as a share of the field's own.
double error(const MorphTarget& carried, const std::vector<Vec3f>& truth) {
    const std::vector<Vec3f> moves = dense(carried, truth.size());
    double off = 0, size = 0;
    for (std::size_t v = 0; v < truth.size(); ++v) {
        off += dot(to_double(moves[v] - truth[v]), to_double(moves[v] - truth[v]));
        size += dot(to_double(truth[v]), to_double(truth[v]));
    }
    return std::sqrt(off / size);
}

std::vector<Vec3f> truth_on(const Mesh& mesh) {
    std::vector<Vec3f> truth;
    for (const Vec3f& p : mesh.positions) truth.push_back(field(p));
    return truth;
}

TEST(CarryShapes, ToItselfAHeadGivesItsShapes) {
    const Face mask = shapes::mask();
    const auto carried = carry_shapes(mask, std::vector{shape_on(mask.mesh)}, mask);
    ASSERT_EQ(carried.size(), 1U);
    EXPECT_EQ(carried[0].name, "smile");
    EXPECT_LT(error(carried[0], truth_on(mask.mesh)), 0.01);
}

TEST(CarryShapes, AnotherTopologyOfTheSameHeadGetsTheSameMotion) {
    const Face mask = shapes::mask(), other = other_topology();
    const auto carried = carry_shapes(mask, std::vector{shape_on(mask.mesh)}, other);
    EXPECT_LT(error(carried[0], truth_on(other.mesh)), 0.1);
    const auto back = carry_shapes(other, carried, mask);
    EXPECT_LT(error(back[0], truth_on(mask.mesh)), 0.15);
}

TEST(CarryShapes, ALargerHeadElsewhereGetsALargerMotion) {
    const Face mask = shapes::mask();
    Face large = mask;
    for (Vec3f& p : large.mesh.positions) p = 16.0F * p + Vec3f{8, 64, -32};
    for (FeaturePoint& p : large.points) p.position = to_double(large.mesh.positions[p.vertex]);
    auto carried = carry_shapes(mask, std::vector{shape_on(mask.mesh)}, large);
    for (Vec3f& d : carried[0].deltas) d = (1 / 16.0F) * d;
    EXPECT_LT(error(carried[0], truth_on(mask.mesh)), 0.01);
}

TEST(CarryShapes, ATallerHeadMovesFartherUp) {
    const Face mask = shapes::mask();
    Face wide = mask;
    for (Vec3f& p : wide.mesh.positions) p.y *= 1.5F;
    for (FeaturePoint& p : wide.points) p.position = to_double(wide.mesh.positions[p.vertex]);
    const auto carried = carry_shapes(mask, std::vector{shape_on(mask.mesh)}, wide);
    std::vector<Vec3f> truth = truth_on(mask.mesh);
    for (Vec3f& d : truth) d.y *= 1.5F;
    EXPECT_LT(error(carried[0], truth), 0.05);
}

// Two sheets, one close over the other: lips. `wave`: how far the upper one dips through the lower between its points.
Face lips(float wave) {
    Face face{shapes::grid(10, 6, 0.25F), {}};
    const auto upper = static_cast<std::uint32_t>(vertex_count(face.mesh));
    shapes::append(face.mesh, shapes::grid(10, 6, 0.25F), {0, 0, 0.02F});
    for (std::uint32_t v = upper; v < vertex_count(face.mesh); ++v)
        face.mesh.positions[v].z -= wave * std::pow(std::cos(6.283F * face.mesh.positions[v].x), 2.0F);
    for (const std::uint32_t v : {12U, 16U, 20U, 34U, 38U, 42U, 56U, 60U, 64U})
        for (const std::uint32_t first : {0U, upper})
            face.points.push_back(shapes::point_at(face.mesh, std::to_string(first + v), first + v));
    return face;
}

// Only the lower lip moves. Places of the upper one that lie below it do not follow.
TEST(CarryShapes, WhatTouchesOnlyInSpaceStaysApart) {
    const Face source = lips(0), target = lips(0.04F);
    const auto upper = static_cast<std::uint32_t>(vertex_count(source.mesh)) / 2;
    MorphTarget only_lower{"lower", {}, {}};
    for (std::uint32_t v = 0; v < upper; ++v) {
        only_lower.vertices.push_back(v);
        only_lower.deltas.push_back({0, -1, 0});
    }
    const auto moves = dense(carry_shapes(source, std::vector{only_lower}, target)[0], 2 * std::size_t{upper});
    for (std::uint32_t v = 0; v < upper; ++v) {
        EXPECT_NEAR(moves[v].y, -1, 0.1) << v;
        EXPECT_NEAR(moves[upper + v].y, 0, 0.1) << v;
    }
}

TEST(CarryShapes, SkinThatTheSourceLacksKeepsStill) {
    const Face mask = shapes::mask();
    Face tall = mask;
    MorphTarget lift{"lift", {}, {}};
    for (std::uint32_t v = 0; v < 625; ++v) {
        lift.vertices.push_back(v);
        lift.deltas.push_back({0, 0.1F, 0});
    }
    // The target's lowest row goes on downwards by three eye distances.
    for (int k = 1; k <= 24; ++k) {
        const auto first = static_cast<std::uint32_t>(vertex_count(tall.mesh));
        for (std::uint32_t i = 0; i < 25; ++i)
            tall.mesh.positions.push_back(tall.mesh.positions[i] - Vec3f{0, 0.125F * static_cast<float>(k), 0});
        const std::uint32_t above = k == 1 ? 0 : first - 25;
        for (std::uint32_t i = 0; i < 24; ++i)
            add_face(tall.mesh, std::array{first + i, first + i + 1, above + i + 1, above + i});
    }
    const auto moves = dense(carry_shapes(mask, std::vector{lift}, tall)[0], vertex_count(tall.mesh));
    EXPECT_NEAR(moves[12 * 25 + 12].y, 0.1, 1e-3);
    EXPECT_EQ(moves.back(), Vec3f{});
}

TEST(CarryShapes, TheNumberOfThreadsDoesNotMatter) {
    const Face mask = shapes::mask(), other = other_topology();
    const auto with_threads = [&](std::size_t threads) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
        return carry_shapes(mask, std::vector{shape_on(mask.mesh)}, other)[0].deltas;
    };
    EXPECT_EQ(with_threads(1), with_threads(8));
}

TEST(CarryShapes, HeadsThatShareTooFewPointsAreRefused) {
    Face few = shapes::mask();
    few.points.resize(3);
    EXPECT_THAT([&] { carry_shapes(shapes::mask(), {}, few); },
                testing::ThrowsMessage<Error>(testing::HasSubstr("at least 4 feature points")));
    const MorphTarget outside{"far", {625}, {{1, 0, 0}}};
    EXPECT_THAT([&] { carry_shapes(shapes::mask(), std::vector{outside}, shapes::mask()); },
                testing::ThrowsMessage<Error>(testing::HasSubstr("\"far\": expected vertices below 625")));
}

TEST(NearestPlaces, AreThoseThatALookAtAllOfThemFinds) {
    std::vector<Vec3> points;
    points.reserve(520);
    for (int i = 0; i < 500; ++i)
        points.push_back({std::fmod(i * 0.618, 1), std::fmod(i * 0.414, 1), std::fmod(i * 0.732, 1)});
    points.insert(points.end(), points.begin(), points.begin() + 20);  // some twice
    const NearestPlaces tree(points);
    for (const Vec3& p : {Vec3{0.5, 0.5, 0.5}, Vec3{-3, 2, 0}, points[7]}) {
        std::vector<std::uint32_t> all(points.size());
        for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
        std::stable_sort(all.begin(), all.end(), [&](std::uint32_t a, std::uint32_t b) {
            return distance(p, points[a]) < distance(p, points[b]);
        });
        all.resize(24);
        EXPECT_EQ(tree.nearest(p, 24), all);
    }
    EXPECT_EQ(tree.nearest({}, 1000).size(), 520U);
    EXPECT_TRUE(tree.nearest({}, 0).empty());
    EXPECT_TRUE(NearestPlaces({}).nearest({}, 3).empty());
}

}  // namespace
}  // namespace mien
