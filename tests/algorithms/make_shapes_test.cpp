// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/make_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "refusal.hpp"
#include "slit_mask.hpp"

#include "mien/algorithms/check_shapes.hpp"
#include "mien/algorithms/rig_biharmonic.hpp"
#include "mien/error.hpp"

namespace mien {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::SizeIs;

BiharmonicOptions every_influence() {
    BiharmonicOptions options;
    options.influences = 0;
    return options;
}

FaceShapes make(const Face& face, const ShapesOptions& options = {}) {
    return make_shapes(face, rig_biharmonic(with_points(face, shape_points(face)), every_influence()), options);
}

// The plain mask's shapes: several tests look at them.
const FaceShapes& made() {
    static const FaceShapes shapes = make(shapes::slit_mask());
    return shapes;
}

const MorphTarget& shape(const FaceShapes& all, std::string_view name) {
    return *std::find_if(all.shapes.begin(), all.shapes.end(), [&](const MorphTarget& s) { return s.name == name; });
}

std::vector<Vec3f> dense(const MorphTarget& shape, const Mesh& mesh) {
    std::vector<Vec3f> moves(mesh.positions.size());
    for (std::size_t i = 0; i < shape.vertices.size(); ++i) moves[shape.vertices[i]] = shape.deltas[i];
    return moves;
}

Vec3f at(const FaceShapes& all, std::string_view name, const Face& face, std::string_view point) {
    return dense(shape(all, name), face.mesh)[face.points[*find_point(face.points, point)].vertex];
}

// The vertex on the other half of the mask.
std::vector<std::uint32_t> partners(const Mesh& mesh) {
    std::vector<std::uint32_t> partner;
    for (const Vec3f& p : mesh.positions) {
        const auto found = std::min_element(mesh.positions.begin(), mesh.positions.end(), [&](Vec3f a, Vec3f b) {
            return distance(a, {-p.x, p.y, p.z}) < distance(b, {-p.x, p.y, p.z});
        });
        partner.push_back(static_cast<std::uint32_t>(found - mesh.positions.begin()));
    }
    return partner;
}

TEST(MakeShapes, every_shape_of_every_standard_is_there_in_order) {
    const auto all = named_shapes();
    ASSERT_THAT(made().shapes, SizeIs(all.size()));
    for (std::size_t s = 0; s < all.size(); ++s) EXPECT_EQ(made().shapes[s].name, all[s].name);
}

TEST(MakeShapes, only_the_sets_asked_for_are_made) {
    ShapesOptions options;
    options.sets = {ShapeSet::visemes};
    EXPECT_THAT(make(shapes::slit_mask(), options).shapes, SizeIs(15));
}

TEST(MakeShapes, all_but_rest_and_the_tongue_of_a_head_without_one_move_something) {
    for (const MorphTarget& s : made().shapes) {
        const bool still = s.name == "viseme_sil" || s.name == "neutral" || s.name == "tongueOut";
        EXPECT_EQ(s.vertices.empty(), still) << s.name;
    }
    EXPECT_THAT(made().notes, Contains(HasSubstr("no tongue")));
    EXPECT_THAT(made().notes, Contains(HasSubstr("no eyeballs")));
}

TEST(MakeShapes, left_and_right_are_mirrors_to_the_last_bit_on_a_symmetric_head) {
    const Face face = shapes::slit_mask();
    const std::vector<std::uint32_t> partner = partners(face.mesh);
    ASSERT_TRUE(made().symmetric);
    for (const MorphTarget& s : made().shapes) {
        if (s.name.starts_with("look")) continue;  // gaze left and right, of both eyes
        const std::vector<Vec3f> here = dense(s, face.mesh);
        const std::vector<Vec3f> there = dense(shape(made(), mirror_shape(s.name)), face.mesh);
        for (std::size_t v = 0; v < here.size(); ++v) {
            const Vec3f other = there[partner[v]];
            ASSERT_EQ(here[v], (Vec3f{-other.x, other.y, other.z})) << s.name << " at " << v;
        }
    }
}

TEST(MakeShapes, a_blink_closes_the_lids_all_along) {
    const ShapesCheck check = check_shapes(shapes::slit_mask(), made().shapes);
    for (const auto& blink : {check.blink_left, check.blink_right}) {
        ASSERT_TRUE(blink);
        EXPECT_LT(blink->most, 0.05);
        EXPECT_GT(blink->least, -0.05);
    }
}

TEST(MakeShapes, mouth_close_shuts_the_mouth_that_the_jaw_opens) {
    const ShapesCheck check = check_shapes(shapes::slit_mask(), made().shapes);
    ASSERT_TRUE(check.closed_jaw);
    EXPECT_LT(check.closed_jaw->most, 0.01);
    EXPECT_GT(check.closed_jaw->least, -0.01);
}

TEST(MakeShapes, the_jaw_leaves_the_upper_lip_alone) {
    const Face face = shapes::slit_mask();
    EXPECT_LT(length(at(made(), "jawOpen", face, "2.2")), 0.03 * length(at(made(), "jawOpen", face, "2.3")));
    EXPECT_LT(at(made(), "jawOpen", face, "2.3").y, -0.2F);
}

TEST(MakeShapes, shapes_do_what_they_are_called) {
    const Face face = shapes::slit_mask();
    EXPECT_GT(at(made(), "mouthSmileLeft", face, "2.4").y, 0.05F);
    EXPECT_GT(at(made(), "mouthSmileLeft", face, "2.4").x, 0.05F);
    EXPECT_LT(at(made(), "mouthFrownLeft", face, "2.4").y, -0.02F);
    EXPECT_GT(at(made(), "jawLeft", face, "2.10").x, 0.05F);
    EXPECT_GT(at(made(), "jawForward", face, "2.10").z, 0.05F);
    EXPECT_GT(at(made(), "mouthPucker", face, "2.2").z, 0.05F);
    EXPECT_GT(at(made(), "browInnerUp", face, "4.1").y, 0.03F);
    EXPECT_LT(at(made(), "browDownRight", face, "4.4").y, -0.02F);
    EXPECT_LT(at(made(), "eyeBlinkLeft", face, "3.1").y, -0.05F);
    EXPECT_EQ(at(made(), "eyeBlinkLeft", face, "3.2"), Vec3f{});
    EXPECT_GT(at(made(), "eyeWideRight", face, "3.2").y, 0.02F);
}

TEST(MakeShapes, a_viseme_is_the_sum_of_its_parts) {
    const Mesh mesh = shapes::slit_mask().mesh;
    std::vector<Vec3f> sum(mesh.positions.size());
    for (const NamedShape& named : named_shapes()) {
        if (named.name != "viseme_O") continue;
        for (const ShapePart& part : named.parts) {
            const std::vector<Vec3f> moves = dense(shape(made(), part.shape), mesh);
            for (std::size_t v = 0; v < sum.size(); ++v) sum[v] += static_cast<float>(part.weight) * moves[v];
        }
    }
    const std::vector<Vec3f> found = dense(shape(made(), "viseme_O"), mesh);
    for (std::size_t v = 0; v < sum.size(); ++v) EXPECT_LT(distance(sum[v], found[v]), 5e-4F);
}

TEST(MakeShapes, the_size_and_place_of_the_head_do_not_matter) {
    Face far = shapes::slit_mask();
    for (Vec3f& p : far.mesh.positions) p = 8.0F * p + Vec3f{64, 16, 0};
    for (FeaturePoint& point : far.points) point.position = 8.0 * point.position + Vec3{64, 16, 0};
    const FaceShapes there = make(far);
    for (std::size_t s = 0; s < made().shapes.size(); ++s) {
        const std::vector<Vec3f> a = dense(made().shapes[s], far.mesh), b = dense(there.shapes[s], far.mesh);
        for (std::size_t v = 0; v < a.size(); ++v)
            ASSERT_LT(distance(8.0F * a[v], b[v]), 8 * 2e-3F) << made().shapes[s].name;
    }
}

TEST(MakeShapes, a_gain_makes_a_shape_stronger) {
    ShapesOptions options;
    options.gains = {{"browInnerUp", 2}};
    const Face face = shapes::slit_mask();
    const FaceShapes strong = make(face, options);
    EXPECT_NEAR(at(strong, "browInnerUp", face, "4.1").y, 2 * at(made(), "browInnerUp", face, "4.1").y, 1e-5);
    EXPECT_EQ(at(strong, "jawOpen", face, "2.3"), at(made(), "jawOpen", face, "2.3"));
}

// An artist whose every motion is twice ours, and who made three shapes.
ShapesOptions twice() {
    ShapesOptions options;
    for (const char* name : {"mouthSmileLeft", "jawOpen", "mouthFrownLeft"}) {
        options.examples.push_back(shape(made(), name));
        for (Vec3f& delta : options.examples.back().deltas) delta = 2.0F * delta;
    }
    return options;
}

TEST(MakeShapes, an_artists_shapes_are_kept_as_they_are) {
    const ShapesOptions options = twice();
    const FaceShapes follows = make(shapes::slit_mask(), options);
    EXPECT_THAT(follows.kept, SizeIs(3));
    for (const MorphTarget& example : options.examples) {
        EXPECT_EQ(shape(follows, example.name).vertices, example.vertices);
        EXPECT_EQ(shape(follows, example.name).deltas, example.deltas);
    }
}

TEST(MakeShapes, beside_an_artists_left_shape_stands_its_mirror_image) {
    const Face face = shapes::slit_mask();
    const FaceShapes follows = make(face, twice());
    const Vec3f left = at(follows, "mouthSmileLeft", face, "2.4"), right = at(follows, "mouthSmileRight", face, "2.5");
    EXPECT_EQ(right, (Vec3f{-left.x, left.y, left.z}));
}

TEST(MakeShapes, shapes_that_the_artist_did_not_make_follow_the_artist) {
    const Face face = shapes::slit_mask();
    const FaceShapes follows = make(face, twice());
    const float ours = at(made(), "mouthPucker", face, "2.2").z, theirs = at(follows, "mouthPucker", face, "2.2").z;
    EXPECT_NEAR(theirs / ours, 2, 0.2);
    const ShapesCheck check = check_shapes(face, follows.shapes);
    EXPECT_LT(check.blink_left->most, 0.05);
    EXPECT_LT(check.closed_jaw->most, 0.01);
}

TEST(MakeShapes, examples_of_other_names_are_told) {
    ShapesOptions options;
    options.examples = {{"smirk", {0}, {Vec3f{0, 1, 0}}}};
    EXPECT_THAT(make(shapes::slit_mask(), options).unknown, Contains("smirk"));
}

TEST(MakeShapes, the_two_sides_of_a_shape_that_has_none_are_added_up) {
    ShapesOptions options;
    options.examples = {{"browInnerUp_L", {3}, {Vec3f{0, 1, 0}}}, {"browInnerUp_R", {5}, {Vec3f{0, 2, 0}}}};
    const FaceShapes all = make(shapes::slit_mask(), options);
    EXPECT_EQ(shape(all, "browInnerUp").vertices, (std::vector<std::uint32_t>{3, 5}));
    EXPECT_THAT(all.kept, Contains("browInnerUp"));
}

// The mask with eyeballs and a tongue behind it.
Face with_eyes_and_tongue() {
    Face face = shapes::slit_mask();
    const float z = face.mesh.positions[face.points[*find_point(face.points, "3.1")].vertex].z;
    for (const float x : {0.5F, -0.5F}) shapes::append(face.mesh, shapes::ball({x, 0, z - 0.27F}, 0.25F));
    Mesh tongue = shapes::ball({0, -1.06F, -0.5F}, 0.2F);
    const auto first_face = static_cast<std::uint32_t>(face_count(face.mesh));
    const auto first = static_cast<std::uint32_t>(face.mesh.positions.size());
    shapes::append(face.mesh, tongue);
    face.mesh.parts = {{"face", 0, 0, 0, first, 0, first_face},
                       {"Tongue", 1, 0, first, static_cast<std::uint32_t>(tongue.positions.size()), first_face,
                        static_cast<std::uint32_t>(face_count(tongue))}};
    return face;
}

TEST(MakeShapes, eyeballs_turn_where_their_side_looks) {
    const Face face = with_eyes_and_tongue();
    const FaceShapes all = make(face);
    const auto pupil = static_cast<std::uint32_t>(shapes::slit_mask().mesh.positions.size());  // pole of the left ball
    const auto moved = [&](const char* name) { return dense(shape(all, name), face.mesh)[pupil]; };
    EXPECT_NEAR(moved("eyeLookOutLeft").x, 0.25 * std::sin(30 * 3.14159265 / 180), 0.005);
    EXPECT_NEAR(moved("eyeLookInLeft").x, -0.25 * std::sin(30 * 3.14159265 / 180), 0.005);
    EXPECT_GT(moved("eyeLookUpLeft").y, 0.08F);
    EXPECT_LT(moved("eyeLookDownLeft").y, -0.1F);
    EXPECT_EQ(moved("eyeLookOutRight"), Vec3f{});
    EXPECT_EQ(moved("eyeBlinkLeft"), Vec3f{});
}

TEST(MakeShapes, a_tongue_comes_out_and_its_root_stays) {
    const Face face = with_eyes_and_tongue();
    const FaceShapes all = make(face);
    const MorphTarget& out = shape(all, "tongueOut");
    ASSERT_FALSE(out.vertices.empty());
    const std::vector<Vec3f> moves = dense(out, face.mesh);
    const std::uint32_t tip = face.mesh.parts[1].first_vertex;
    EXPECT_GT(moves[tip].z, 0.2F);
    for (std::uint32_t v = 0; v < tip; ++v) EXPECT_EQ(moves[v], Vec3f{});
    EXPECT_LT(length(moves.back()), 0.01F);
}

// The mask with a bag sewn to the edges of the left lids: 6 rings, each 0.06 farther back, and an end that is closed.
Face with_pocket() {
    Face face = shapes::slit_mask();
    const std::uint32_t lower = face.points[*find_point(face.points, "3.3")].vertex - 3;
    std::vector<std::uint32_t> ring;
    for (std::uint32_t i = 28; i <= 36; ++i) ring.push_back(32 * 49 + i);
    for (std::uint32_t i = 7; i-- > 0;) ring.push_back(lower + i);
    for (int k = 0; k < 6; ++k) {
        const auto first = static_cast<std::uint32_t>(face.mesh.positions.size());
        for (const std::uint32_t v : ring) face.mesh.positions.push_back(face.mesh.positions[v] - Vec3f{0, 0, 0.06F});
        for (std::uint32_t i = 0; i < 16; ++i) {
            const std::uint32_t next = (i + 1) % 16;
            add_face(face.mesh, std::array{ring[i], ring[next], first + next, first + i});
        }
        for (std::uint32_t i = 0; i < 16; ++i) ring[i] = first + i;
    }
    add_face(face.mesh, ring);
    return face;
}

TEST(MakeShapes, a_socket_that_is_closed_behind_the_eye_follows_the_lids_at_its_rim_and_keeps_still_behind) {
    const Face face = with_pocket();
    const FaceShapes all = make(face);
    const std::vector<Vec3f> moves = dense(shape(all, "eyeBlinkLeft"), face.mesh);
    const auto bag = static_cast<std::uint32_t>(shapes::slit_mask().mesh.positions.size());
    const auto largest = [&](std::uint32_t ring) {
        float most = 0;
        for (std::uint32_t i = 0; i < 16; ++i) most = std::max(most, length(moves[bag + 16 * ring + i]));
        return most;
    };
    const float lid = length(moves[face.points[*find_point(face.points, "3.1")].vertex]);
    EXPECT_GT(largest(0), 0.4F * lid);
    EXPECT_LT(largest(0), lid);
    EXPECT_LT(largest(1), largest(0));
    for (std::uint32_t ring = 2; ring < 6; ++ring) EXPECT_EQ(largest(ring), 0) << ring;
    EXPECT_LT(check_shapes(face, all.shapes).blink_left->most, 0.05);
}

TEST(MakeShapes, lids_slide_over_the_eyeballs_and_do_not_sink_into_them) {
    constexpr float radius = 0.25F;
    Face face = shapes::slit_mask();
    const auto skin = face.mesh.positions.size();
    const float z = face.mesh.positions[face.points[*find_point(face.points, "3.1")].vertex].z;
    const Vec3f centre{0.5F, 0, z - 0.19F};
    for (const float x : {centre.x, -centre.x})
        shapes::append(face.mesh, shapes::ball({x, centre.y, centre.z}, radius, 24, 32));
    const FaceShapes all = make(face);
    for (const char* name : {"eyeBlinkLeft", "eyeLookDownLeft", "eyeSquintLeft"}) {
        const std::vector<Vec3f> moves = dense(shape(all, name), face.mesh);
        for (std::size_t v = 0; v < skin; ++v) {
            const float before = distance(face.mesh.positions[v], centre);
            if (before < 0.88F * radius || before > radius * 1.5F) continue;
            EXPECT_GT(distance(face.mesh.positions[v] + moves[v], centre), 0.985F * std::min(before, radius))
                << name << " " << v;
        }
    }
}

TEST(MakeShapes, refuses_points_that_the_table_does_not_know) {
    Face face = shapes::slit_mask();
    const Rig rig = rig_biharmonic(face);
    for (FeaturePoint& point : face.points) point.id = "mine " + point.id;
    EXPECT_THAT(refusal([&] { (void)make_shapes(face, rig); }), HasSubstr("three or more of the feature points"));
}

TEST(MakeShapes, refuses_options_out_of_range) {
    const Face face = shapes::slit_mask();
    const Rig rig = rig_biharmonic(face);
    ShapesOptions options;
    options.gains = {{"smirk", 2}};
    EXPECT_THAT(refusal([&] { (void)make_shapes(face, rig, options); }), HasSubstr("found smirk"));
    options.gains = {{"jawOpen", std::nan("")}};
    EXPECT_THAT(refusal([&] { (void)make_shapes(face, rig, options); }), HasSubstr("finite gain of jawOpen"));
    options.gains.clear();
    options.look_up = 90;
    EXPECT_THAT(refusal([&] { (void)make_shapes(face, rig, options); }), HasSubstr("0 to 60 degrees, found 90"));
    options.look_up = 25;
    options.examples = {{"jawOpen", {1U << 20}, {Vec3f{}}}};
    EXPECT_THAT(refusal([&] { (void)make_shapes(face, rig, options); }), HasSubstr("expected vertices below"));
}

}  // namespace
}  // namespace mien
