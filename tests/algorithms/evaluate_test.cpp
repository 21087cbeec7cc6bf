// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/evaluate.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numeric>

#include "refusal.hpp"
#include "shapes.hpp"
#include "slit_mask.hpp"

#include "mien/algorithms/rig_biharmonic.hpp"
#include "mien/error.hpp"

namespace mien {
namespace {

using testing::HasSubstr;

// A shape that moves every vertex by what `move` gives for its position.
template <class Move>
MorphTarget shape(const Mesh& mesh, const std::string& name, Move move) {
    MorphTarget made{name, {}, {}};
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
        made.vertices.push_back(v);
        made.deltas.push_back(move(mesh.positions[v]));
    }
    return made;
}

Face mask_with(std::vector<MorphTarget> shapes) {
    Face face = shapes::mask();
    face.mesh.morph_targets = std::move(shapes);
    return face;
}

Face waving() {
    const Mesh mesh = shapes::mask().mesh;
    return mask_with({shape(mesh, "wave",
                            [](Vec3f p) {
                                return Vec3f{0, 0.05F * std::sin(3 * p.x), 0.02F * p.y};
                            }),
                      shape(mesh, "twist", [](Vec3f p) {
                          return Vec3f{0.1F * p.y, 0, 0.1F * p.x};
                      })});
}

// The rig of a head that nothing moves.
Rig frozen(const Face& face) {
    Rig rig = rig_biharmonic(face);
    for (Vec3f& weight : rig.weights) weight = {};
    return rig;
}

TEST(Evaluate, a_head_whose_shapes_are_the_rigs_own_has_no_error) {
    Face face = waving();
    const Rig rig = rig_biharmonic(face);
    face.mesh.morph_targets = reproduce_shapes(face, rig);
    const Evaluation evaluation = evaluate(face, rig);
    EXPECT_LT(evaluation.error, 1e-5);
    EXPECT_LT(evaluation.pooled, 1e-5);
    EXPECT_LT(evaluation.max, 1e-6);
    EXPECT_LT(evaluation.lip_gap, 1e-6);
    EXPECT_EQ(evaluation.flipped, 0);
}

TEST(Evaluate, a_head_that_does_not_move_is_all_error) {
    const Face face = waving();
    const Evaluation evaluation = evaluate(face, frozen(face));
    ASSERT_EQ(evaluation.shapes.size(), 2U);
    for (const ShapeFigures& figures : evaluation.shapes) {
        EXPECT_DOUBLE_EQ(figures.error, 1);
        for (const RegionFigures& region : figures.regions) EXPECT_DOUBLE_EQ(region.error, 1) << region.name;
    }
    EXPECT_DOUBLE_EQ(evaluation.error, 1);
    EXPECT_DOUBLE_EQ(evaluation.pooled, 1);
}

TEST(Evaluate, lengths_are_in_eye_distances) {
    const Mesh mesh = shapes::mask().mesh;
    const Face face = mask_with({shape(mesh, "forward", [](Vec3f) { return Vec3f{0, 0, 0.25F}; })});
    const double eyes = eye_distance(face.points);
    const Evaluation evaluation = evaluate(face, frozen(face));
    EXPECT_NEAR(evaluation.shapes[0].max, 0.25 / eyes, 1e-6);
    EXPECT_NEAR(evaluation.shapes[0].p95, 0.25 / eyes, 1e-6);
}

TEST(Evaluate, the_size_of_the_head_does_not_matter) {
    const Face face = waving();
    Face large = face;
    for (Vec3f& p : large.mesh.positions) p = 10.0F * p;
    for (FeaturePoint& point : large.points) point.position = 10.0 * point.position;
    for (MorphTarget& target : large.mesh.morph_targets)
        for (Vec3f& delta : target.deltas) delta = 10.0F * delta;
    const Evaluation a = evaluate(face, rig_biharmonic(face)), b = evaluate(large, rig_biharmonic(large));
    EXPECT_NEAR(a.error, b.error, 1e-4);
    EXPECT_NEAR(a.max, b.max, 1e-4);
    EXPECT_NEAR(a.p95, b.p95, 1e-4);
    EXPECT_NEAR(a.lip_gap, b.lip_gap, 1e-4);
}

TEST(Evaluate, a_head_turned_inside_out_is_flipped_all_over) {
    const Mesh mesh = shapes::mask().mesh;
    const Face face = mask_with({shape(mesh, "mirrored", [](Vec3f p) { return Vec3f{-2 * p.x, 0, 0}; })});
    EXPECT_EQ(evaluate(face, frozen(face)).flipped, 1);
}

TEST(Evaluate, lips_that_stay_closed_miss_the_opening) {
    Face face = shapes::slit_mask();
    const Vec3f mouth = to_float(face.points[*find_point(face.points, "2.3")].position);
    face.mesh.morph_targets = {shape(face.mesh, "open", [&](Vec3f p) {
        return p.y <= mouth.y ? Vec3f{0, -0.1F, 0} : Vec3f{};
    })};
    const Evaluation evaluation = evaluate(face, frozen(face));
    EXPECT_NEAR(evaluation.lip_gap, 0.1 / eye_distance(face.points), 0.01);
    EXPECT_EQ(evaluation.lid_gap, 0);
    EXPECT_EQ(evaluation.crossing, 0);
}

TEST(Evaluate, lids_that_pass_through_each_other_cross_by_what_is_too_much) {
    Face face = shapes::slit_mask();
    const auto close = [&](float far) {
        MorphTarget made{"blink", {}, {}};
        for (std::uint32_t i = 29; i < 36; ++i) {
            made.vertices.push_back(32 * 49 + i);
            made.deltas.push_back({0, -far, 0});
        }
        return made;
    };
    face.mesh.morph_targets = {close(0.05F)};
    Rig rig = rig_biharmonic(face);
    for (Vec3f& weight : rig.weights) weight = 4.0F * weight;
    EXPECT_NEAR(evaluate(face, rig).crossing, 0.1, 0.02);  // 0.1 open at its middle, moved by 0.2
}

TEST(Evaluate, every_vertex_is_in_one_region) {
    const Face face = waving();
    std::size_t vertices = 0;
    for (const RegionFigures& region : evaluate(face, rig_biharmonic(face)).regions) vertices += region.vertices;
    EXPECT_EQ(vertices, face.mesh.positions.size());
}

TEST(Evaluate, error_in_a_part_that_truly_keeps_still_is_infinite_there) {
    Face face = shapes::mask();
    const std::uint32_t brow = face.points[*find_point(face.points, "4.1")].vertex;
    MorphTarget twitch{"twitch", {brow}, {Vec3f{0, 0.2F, 0}}};
    face.mesh.morph_targets = {twitch};
    for (const RegionFigures& region : evaluate(face, rig_biharmonic(face)).regions)
        EXPECT_EQ(std::isinf(region.error), region.name != "brows") << region.name;
}

TEST(Evaluate, shapes_that_move_nothing_are_named_and_left_out) {
    Face face = waving();
    face.mesh.morph_targets.push_back({"sil", {}, {}});
    const Evaluation evaluation = evaluate(face, rig_biharmonic(face));
    EXPECT_EQ(evaluation.shapes.size(), 2U);
    EXPECT_EQ(evaluation.still, std::vector<std::string>{"sil"});
}

TEST(Evaluate, refuses_a_head_without_shapes) {
    const Face face = shapes::mask();
    const Rig rig = rig_biharmonic(face);
    EXPECT_THAT(refusal([&] { (void)evaluate(face, rig); }), HasSubstr("expected a head with shapes"));
}

TEST(Evaluate, refuses_the_rig_of_another_head) {
    const Face face = waving();
    Rig rig = rig_biharmonic(face);
    rig.rest.pop_back();
    EXPECT_THAT(refusal([&] { (void)evaluate(face, rig); }), HasSubstr("625 vertices, found one of 624"));
}

}  // namespace
}  // namespace mien
