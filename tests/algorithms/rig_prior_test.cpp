// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/rig_prior.hpp"

#include <algorithm>
#include <gmock/gmock.h>
#include <limits>
#include <tbb/global_control.h>

#include "refusal.hpp"
#include "shapes.hpp"

#include "mien/algorithms/deform.hpp"
#include "mien/algorithms/rig_biharmonic.hpp"
#include "mien/error.hpp"

namespace mien {
namespace {

using Moves = std::vector<Vec3f>;

// A soft bump of motion round a place of the mask.
MorphTarget bump(const Mesh& mesh, const std::string& name, Vec3f centre, Vec3f motion, float radius = 0.6F) {
    MorphTarget shape{name, {}, {}};
    for (std::uint32_t v = 0; v < vertex_count(mesh); ++v) {
        const float d = length(mesh.positions[v] - centre) / radius;
        if (d > 2) continue;
        shape.vertices.push_back(v);
        shape.deltas.push_back(std::exp(-2 * d * d) * motion);
    }
    return shape;
}

std::vector<MorphTarget> examples(const Mesh& mesh) {
    return {bump(mesh, "smile_L", {0.4F, -0.8F, 0}, {0.1F, 0.12F, 0.02F}),
            bump(mesh, "smile_R", {-0.4F, -0.8F, 0}, {-0.1F, 0.12F, 0.02F}),
            bump(mesh, "jaw", {0, -1.4F, -0.3F}, {0, -0.3F, -0.05F}, 0.9F),
            bump(mesh, "brow_L", {0.25F, 0.4F, 0}, {0, 0.15F, 0.03F}),
            bump(mesh, "brow_R", {-0.25F, 0.4F, 0}, {0, 0.15F, 0.03F})};
}

Moves dense(const MorphTarget& shape, std::size_t vertices) {
    Moves moves(vertices);
    for (std::size_t i = 0; i < shape.vertices.size(); ++i) moves[shape.vertices[i]] = shape.deltas[i];
    return moves;
}

Moves at_points(const Rig& rig, const Moves& moves) {
    Moves result;
    for (const FeaturePoint& point : rig.points) result.push_back(moves[point.vertex]);
    return result;
}

Moves deformed(const Rig& rig, const Moves& points) {
    Moves positions(vertex_count(rig));
    deform(rig, points, positions);
    for (std::size_t v = 0; v < positions.size(); ++v) positions[v] -= rig.rest[v];
    return positions;
}

double distance_between(const Moves& a, const Moves& b) {
    double sum = 0;
    for (std::size_t v = 0; v < a.size(); ++v) sum += dot(to_double(a[v] - b[v]), to_double(a[v] - b[v]));
    return std::sqrt(sum);
}

double size_of(const Moves& a) {
    return distance_between(a, Moves(a.size()));
}

double largest_difference(const Moves& a, const Moves& b) {
    double largest = 0;
    for (std::size_t v = 0; v < a.size(); ++v) largest = std::max(largest, double{length(a[v] - b[v])});
    return largest;
}

// A motion of the mask's points that is none of the examples.
Moves some_motion() {
    Moves moves;
    for (int i = 0; i < 14; ++i) {
        const auto t = static_cast<float>(i);
        moves.push_back({0.05F * std::sin(t), 0.08F * std::cos(2 * t), 0.03F * std::sin(3 * t)});
    }
    return moves;
}

class RigPrior : public testing::Test {
protected:
    Face face = shapes::mask();
    Examples known{examples(face.mesh), {}};
    Rig rig = rig_prior(face, known);
};

TEST_F(RigPrior, IsARigWithShapesThatNoPointsVertexHas) {
    EXPECT_EQ(rig.method, "prior");
    ASSERT_TRUE(rig.prior);
    EXPECT_TRUE(is_one_sided(*rig.prior));
    ASSERT_EQ(rig.prior->shapes.size(), 5U);
    EXPECT_EQ(rig.prior->response.size(), 5 * 14U);
    EXPECT_EQ(rig.prior->stiffness.size(), 25U);
    for (const MorphTarget& shape : rig.prior->shapes) {
        EXPECT_TRUE(std::is_sorted(shape.vertices.begin(), shape.vertices.end()));
        EXPECT_EQ(shape.deltas.size(), shape.vertices.size());
        for (const FeaturePoint& point : face.points)
            EXPECT_FALSE(std::binary_search(shape.vertices.begin(), shape.vertices.end(), point.vertex)) << point.id;
    }
}

TEST_F(RigPrior, PointsThatKeepStillLeaveTheFaceStill) {
    EXPECT_EQ(deformed(rig, Moves(14)), Moves(vertex_count(rig)));
}

TEST_F(RigPrior, AVertexAtAPointFollowsIt) {
    const Moves motion = some_motion(), moved = deformed(rig, motion);
    for (std::size_t i = 0; i < motion.size(); ++i)
        EXPECT_LT(length(moved[face.points[i].vertex] - motion[i]), 1e-6) << face.points[i].id;
}

TEST_F(RigPrior, AnExampleComesBackFromItsPointsAlone) {
    const Rig without = rig_biharmonic(face);
    for (const MorphTarget& shape : known.own) {
        const Moves truth = dense(shape, vertex_count(rig)), points = at_points(rig, truth);
        const double error = distance_between(deformed(rig, points), truth) / size_of(truth);
        EXPECT_LT(error, 0.1) << shape.name;
        EXPECT_LT(error, 0.5 * distance_between(deformed(without, points), truth) / size_of(truth)) << shape.name;
    }
}

TEST_F(RigPrior, AnExampleShowsMostlyAsItself) {
    for (std::size_t k = 0; k < known.own.size(); ++k) {
        std::vector<float> weights(5);
        shape_weights(*rig.prior, at_points(rig, dense(known.own[k], vertex_count(rig))), weights);
        for (std::size_t j = 0; j < 5; ++j) EXPECT_NEAR(weights[j], j == k ? 1 : 0, 0.25) << k << " " << j;
    }
}

TEST_F(RigPrior, AnExampleBackwardsIsNeverTakenAwayUnlessTheRigIsLinear) {
    const Rig linear = rig_prior(face, known, {.one_sided = false});
    Moves points = at_points(rig, dense(known.own[2], vertex_count(rig)));
    for (Vec3f& d : points) d = -1.0F * d;
    std::vector<float> one_sided(5), both(5);
    shape_weights(*rig.prior, points, one_sided);
    shape_weights(*linear.prior, points, both);
    EXPECT_EQ(one_sided[2], 0);
    EXPECT_LT(both[2], -0.5F);
}

TEST_F(RigPrior, AMirroredMotionMovesTheMirroredVertices) {
    const auto mirrored = [](const Vec3f& p) { return Vec3f{-p.x, p.y, p.z}; };
    const Moves motion = some_motion();
    Moves other(14);
    for (std::size_t i = 0; i < 14; ++i) {
        const auto partner = std::find_if(face.points.begin(), face.points.end(), [&](const FeaturePoint& p) {
            return p.position == Vec3{-face.points[i].position.x, face.points[i].position.y, face.points[i].position.z};
        });
        other[static_cast<std::size_t>(partner - face.points.begin())] = mirrored(motion[i]);
    }
    const Moves a = deformed(rig, motion), b = deformed(rig, other);
    for (std::uint32_t v = 0; v < 625; ++v) EXPECT_LT(length(mirrored(a[v]) - b[v / 25 * 25 + 24 - v % 25]), 2e-5) << v;
}

TEST_F(RigPrior, SizeAndPlaceOfTheHeadDoNotMatter) {
    Face other = face;
    for (Vec3f& p : other.mesh.positions) p = 64.0F * p + Vec3f{16, -128, 32};
    for (FeaturePoint& p : other.points) p.position = to_double(other.mesh.positions[p.vertex]);
    Examples larger = known;
    for (MorphTarget& shape : larger.own)
        for (Vec3f& d : shape.deltas) d = 64.0F * d;
    Moves motion = some_motion();
    const Moves once = deformed(rig, motion);
    for (Vec3f& d : motion) d = 64.0F * d;
    Moves moved = deformed(rig_prior(other, larger), motion);
    for (Vec3f& d : moved) d = (1 / 64.0F) * d;
    EXPECT_LT(largest_difference(moved, once), 1e-4);
}

TEST_F(RigPrior, HowLargeTheExamplesAreDoesNotMatter) {
    Examples larger = known;
    for (MorphTarget& shape : larger.own)
        for (Vec3f& d : shape.deltas) d = 3.0F * d;
    EXPECT_LT(largest_difference(deformed(rig, some_motion()), deformed(rig_prior(face, larger), some_motion())), 1e-5);
}

TEST_F(RigPrior, TheNumberOfThreadsDoesNotMatter) {
    for (const std::size_t threads : {1U, 8U}) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
        const Rig again = rig_prior(face, known);
        EXPECT_EQ(again.weights, rig.weights);
        EXPECT_EQ(again.prior->response, rig.prior->response);
        EXPECT_EQ(again.prior->stiffness, rig.prior->stiffness);
        for (std::size_t k = 0; k < 5; ++k) EXPECT_EQ(again.prior->shapes[k].deltas, rig.prior->shapes[k].deltas);
    }
}

TEST_F(RigPrior, TwiceTheFrameRateHalvesTheLargestStepOfEveryVertex) {
    const Moves forth = some_motion();
    const auto largest_steps = [&](int rows) {
        std::vector<double> largest(vertex_count(rig));
        Moves before = deformed(rig, Moves(14));
        for (int r = 1; r <= rows; ++r) {
            const double t = 6.283185307179586 * r / rows;
            Moves motion;
            for (std::size_t i = 0; i < 14; ++i)
                motion.push_back(static_cast<float>(std::sin(t + 0.3 * static_cast<double>(i))) * forth[i]);
            const Moves now = deformed(rig, motion);
            for (std::size_t v = 0; v < now.size() && r > 1; ++v)
                largest[v] = std::max(largest[v], double{length(now[v] - before[v])});
            before = now;
        }
        return largest;
    };
    const std::vector<double> slow = largest_steps(120), fast = largest_steps(240);
    for (std::size_t v = 0; v < slow.size(); ++v) EXPECT_LE(fast[v], 0.52 * slow[v] + 1e-6) << v;
}

TEST_F(RigPrior, APieceThatAnExampleMovesFollowsItAndOneThatNoneMovesFollowsTheSkin) {
    const auto lash = static_cast<std::uint32_t>(vertex_count(face.mesh));
    shapes::append(face.mesh, shapes::grid(4, 1, 0.05F), {0.2F, 0.41F, 0.01F});
    const auto tongue = static_cast<std::uint32_t>(vertex_count(face.mesh));
    shapes::append(face.mesh, shapes::grid(2, 2, 0.1F), {-0.1F, -0.9F, -0.6F});
    for (std::uint32_t v = tongue; v < vertex_count(face.mesh); ++v) {
        known.own[2].vertices.push_back(v);
        known.own[2].deltas.push_back({0, -0.2F, 0.1F});
    }
    const Rig with = rig_prior(face, known);
    const Moves jaw = deformed(with, at_points(with, dense(known.own[2], vertex_count(with))));
    EXPECT_LT(length(jaw.back() - Vec3f{0, -0.2F, 0.1F}), 0.03);
    const Moves brow = deformed(with, at_points(with, dense(known.own[3], vertex_count(with))));
    const std::uint32_t below = 19 * 25 + 14;  // the skin at the brow's point
    EXPECT_LT(length(brow[lash] - brow[below]), 0.03);
    EXPECT_GT(length(brow[lash]), 0.1);
}

TEST_F(RigPrior, APointHasNoSayAlongAnAxisItIsHeldIn) {
    face.points[0].moves = {true, false, true};
    const Rig held = rig_prior(face, known);
    Moves motion(14);
    motion[0] = {0, 1, 0};
    EXPECT_EQ(deformed(held, motion), Moves(vertex_count(held)));
}

TEST_F(RigPrior, ShapesOfOthersAloneMakeALinearRig) {
    const Rig carried = rig_prior(face, {{}, known.own});
    ASSERT_TRUE(carried.prior);
    EXPECT_FALSE(is_one_sided(*carried.prior));
    Moves motion = some_motion();
    const Moves once = deformed(carried, motion);
    for (Vec3f& d : motion) d = -1.0F * d;
    Moves back = deformed(carried, motion);
    for (Vec3f& d : back) d = -1.0F * d;
    EXPECT_LT(largest_difference(once, back), 1e-5);
}

TEST_F(RigPrior, ShapesOfOthersBesideOwnOnesAreNoShapesOfTheRig) {
    const Rig helped = rig_prior(face, {{known.own[0], known.own[1]}, known.own});
    ASSERT_EQ(helped.prior->shapes.size(), 2U);
    EXPECT_EQ(helped.prior->shapes[0].name, "smile_L");
}

TEST_F(RigPrior, ExamplesThatTeachNothingOrNonsenseAreRefused) {
    const auto refusal = [&](const MorphTarget& shape) {
        return mien::refusal([&] { rig_prior(face, {{shape}, {}}); });
    };
    EXPECT_THAT(refusal({"none", {}, {}}), testing::HasSubstr("expected an example shape that moves the skin"));
    EXPECT_THAT(refusal({"far", {625}, {{1, 0, 0}}}), testing::HasSubstr("\"far\": expected vertices below 625"));
    EXPECT_THAT(refusal({"half", {1, 2}, {{1, 0, 0}}}), testing::HasSubstr("\"half\": expected a motion for each"));
    EXPECT_THAT(refusal({"odd", {1}, {{std::numeric_limits<float>::quiet_NaN(), 0, 0}}}),
                testing::HasSubstr("finite numbers"));
    EXPECT_THROW(rig_prior(face, {}), Error);
    EXPECT_THROW(rig_prior(face, {std::vector<MorphTarget>(257, known.own[0]), {}}), Error);
    EXPECT_THROW(rig_prior({face.mesh, {}}, known), Error);
}

TEST_F(RigPrior, AShapeThatMovesNoSkinIsLeftOut) {
    known.own.push_back({"tongue out", {}, {}});
    EXPECT_EQ(rig_prior(face, known).prior->shapes.size(), 5U);
}

}  // namespace
}  // namespace mien
