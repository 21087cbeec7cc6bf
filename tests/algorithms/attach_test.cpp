// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/attach.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <iterator>
#include <numeric>

#include "algorithms/eyeballs.hpp"
#include "algorithms/surface_tree.hpp"
#include "shapes.hpp"

#include "mien/algorithms/deform.hpp"
#include "mien/algorithms/rig_surface_distance.hpp"
#include "mien/io/obj.hpp"
#include "mien/io/points.hpp"

namespace mien {
namespace {

// A piece added to a head under a name; returns its first vertex.
std::uint32_t add_piece(Face& face, const std::string& name, const Mesh& piece, Vec3f offset = {}) {
    const auto first = static_cast<std::uint32_t>(vertex_count(face.mesh));
    const auto first_face = static_cast<std::uint32_t>(face_count(face.mesh));
    shapes::append(face.mesh, piece, offset);
    face.mesh.parts.push_back({name, 0, 0, first, static_cast<std::uint32_t>(vertex_count(piece)), first_face,
                               static_cast<std::uint32_t>(face_count(piece))});
    return first;
}

// An eyeball behind the mask's left eye, between 3.7 and 3.11.
constexpr Vec3f left_eye{0.5F, 0, -0.3F};
constexpr float eye_radius = 0.25F;

Rig rig_of(const Face& face) {
    return rig_surface_distance(face);
}

Vec3f weight(const Rig& rig, std::uint32_t vertex, std::string_view id) {
    for (std::uint32_t e = rig.row_starts[vertex]; e < rig.row_starts[vertex + 1]; ++e)
        if (rig.points[rig.row_points[e]].id == id) return rig.weights[e];
    return {};
}

std::size_t row_length(const Rig& rig, std::uint32_t vertex) {
    return rig.row_starts[vertex + 1] - rig.row_starts[vertex];
}

std::string how(const Rig& rig, const std::string& name) {
    for (const Attachment& attachment : rig.attachments)
        if (attachment.name == name) return attachment.how;
    return "not reported";
}

std::string how_a_small_box_goes(const std::string& name, Vec3f at) {
    Face face = shapes::mask();
    add_piece(face, name, shapes::ball({}, 0.05F), at);
    return how(rig_of(face), name);
}

std::vector<Vec3> on_sphere(const Vec3& centre, double radius, std::uint32_t open) {
    const Mesh mesh = shapes::ball({}, 1, 12, 16, open);
    std::vector<Vec3> points;
    for (const Vec3f& p : mesh.positions) points.push_back(centre + radius * to_double(p));
    return points;
}

TEST(FitSphere, FindsAWholeAndAHalfSphere) {
    for (const std::uint32_t open : {0U, 6U}) {
        const auto points = on_sphere({3, -2, 160}, 0.012, open);
        const Sphere sphere = fit_sphere(points, std::vector<double>(points.size(), 1));
        EXPECT_LT(distance(sphere.centre, {3, -2, 160}), 1e-8);
        EXPECT_NEAR(sphere.radius, 0.012, 1e-8);
        EXPECT_LT(sphere.roughness, 1e-6);
    }
}

TEST(FitSphere, IsNotPulledByTheBulgeOfACornea) {
    auto points = on_sphere({}, 1, 0);
    for (Vec3& p : points)
        if (p.z > 0.8) p = 1.15 * p;
    const Sphere sphere = fit_sphere(points, std::vector<double>(points.size(), 1));
    EXPECT_LT(length(sphere.centre), 1e-3);
    EXPECT_NEAR(sphere.radius, 1, 1e-3);
}

TEST(FitSphere, HasNoRadiusWhereThereIsNoSphere) {
    const std::vector<Vec3> flat{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.5, 0.2, 0}};
    EXPECT_EQ(fit_sphere(flat, std::vector<double>(5, 1)).radius, 0);
    EXPECT_EQ(fit_sphere(std::vector<Vec3>(3), std::vector<double>(3, 1)).radius, 0);
}

TEST(SurfaceTree, IsInfinitelyFarFromNothing) {
    const Mesh mesh = shapes::strip(1);
    const Weld w = weld(mesh);
    EXPECT_TRUE(std::isinf(SurfaceTree(mesh, w, std::vector<bool>(4, false)).nearest({0, 0, 0}).distance));
}

TEST(SurfaceTree, FindsFeetInsideOnSidesAndAtCorners) {
    const Mesh mesh = shapes::grid(20, 20, 0.5F);
    const Weld w = weld(mesh);
    const SurfaceTree tree(mesh, w, std::vector<bool>(vertex_count(mesh), true));
    const auto foot = [&](const Vec3& p) {
        const SurfacePoint s = tree.nearest(p);
        Vec3 sum;
        for (std::size_t k = 0; k < 3; ++k) sum += s.shares[k] * to_double(mesh.positions[w.vertex[s.places[k]]]);
        EXPECT_NEAR(distance(sum, p), s.distance, 1e-12);
        return sum;
    };
    EXPECT_LT(distance(foot({3.3, 4.6, 2}), {3.3, 4.6, 0}), 1e-12);
    EXPECT_LT(distance(foot({3.3, 12, -2}), {3.3, 10, 0}), 1e-12);
    EXPECT_LT(distance(foot({-1, -1, 0}), {0, 0, 0}), 1e-12);
}

TEST(SolvedPlaces, AreThoseOfIslandsWithPointsButNotOfEyeballs) {
    Face face = shapes::mask();
    const std::uint32_t eye = add_piece(face, "eye", shapes::ball(left_eye, eye_radius));
    const std::uint32_t hair = add_piece(face, "hair", shapes::strip(2), {0, 2, 0});
    face.points.push_back(shapes::point_at(face.mesh, "3.5", eye));
    const Weld w = weld(face.mesh);
    const std::vector<bool> solved = solved_places(face, w);
    for (std::uint32_t v = 0; v < vertex_count(face.mesh); ++v) EXPECT_EQ(solved[w.place[v]], v < eye) << v;
    EXPECT_GT(hair, eye);
}

TEST(AttachIslands, AnEyeballTurnsAboutItsCentreAndIsAimedByThePupil) {
    Face face = shapes::mask();
    const std::uint32_t eye = add_piece(face, "eye_left", shapes::ball(left_eye, eye_radius));
    face.points.push_back(shapes::point_at(face.mesh, "3.5", eye));
    const Rig rig = rig_of(face);
    ASSERT_EQ(rig.eyeballs.size(), 1U);
    EXPECT_LT(distance(rig.eyeballs[0].centre, to_double(left_eye)), 1e-6);
    EXPECT_EQ(rig.eyeballs[0].point, face.points.size() - 1);
    std::vector<std::uint32_t> all(vertex_count(face.mesh) - eye);
    std::iota(all.begin(), all.end(), eye);
    EXPECT_EQ(rig.eyeballs[0].vertices, all);
    for (const std::uint32_t v : all) EXPECT_EQ(row_length(rig, v), 0U);
    EXPECT_EQ(how(rig, "eye_left"), "turns about its centre");
}

TEST(AttachIslands, AnEyeballWithoutAPupilPointKeepsStill) {
    Face face = shapes::mask();
    add_piece(face, "ball", shapes::ball(left_eye, eye_radius, 12, 16, 5));
    const Rig rig = rig_of(face);
    ASSERT_EQ(rig.eyeballs.size(), 1U);
    EXPECT_EQ(rig.eyeballs[0].point, std::nullopt);
    EXPECT_LT(distance(rig.eyeballs[0].centre, to_double(left_eye)), 1e-6);
}

TEST(AttachIslands, WhatLiesInsideAnEyeballTurnsWithIt) {
    Face face = shapes::mask();
    const std::uint32_t iris = add_piece(face, "iris", shapes::ball(left_eye + Vec3f{0, 0, 0.1F}, 0.1F, 12, 16, 8));
    add_piece(face, "sclera", shapes::ball(left_eye, eye_radius));
    add_piece(face, "cornea", shapes::ball(left_eye, 1.04F * eye_radius));
    face.points.push_back(shapes::point_at(face.mesh, "3.5", iris));
    const Rig rig = rig_of(face);
    ASSERT_EQ(rig.eyeballs.size(), 1U);
    EXPECT_EQ(rig.eyeballs[0].vertices.size(), vertex_count(face.mesh) - iris);
    EXPECT_EQ(rig.eyeballs[0].point, face.points.size() - 1);
}

TEST(AttachIslands, ABallElsewhereOrUnderSkinPointsIsNoEyeball) {
    Face bead = shapes::mask();
    add_piece(bead, "bead", shapes::ball({0, 1.4F, 0.3F}, eye_radius));
    EXPECT_TRUE(rig_of(bead).eyeballs.empty());
    Face puppet = shapes::mask();
    const std::uint32_t ball = add_piece(puppet, "ball", shapes::ball(left_eye, eye_radius));
    puppet.points.push_back(shapes::point_at(puppet.mesh, "3.1", ball + 3));
    EXPECT_TRUE(rig_of(puppet).eyeballs.empty());
}

TEST(AttachIslands, TeethAndTongueAreToldApartByPlace) {
    EXPECT_EQ(how_a_small_box_goes("a", {0, -0.65F, -0.4F}), "follows the skull");
    EXPECT_EQ(how_a_small_box_goes("b", {0, -1, -0.4F}), "follows the jaw");
    EXPECT_EQ(how_a_small_box_goes("c", {0, -0.8F, -0.8F}), "follows the jaw");
}

TEST(AttachIslands, NamesGoBeforePlaces) {
    EXPECT_EQ(how_a_small_box_goes("Teeth_Upper", {0, -1, -0.4F}), "follows the skull");
    EXPECT_EQ(how_a_small_box_goes("Teeth_Lower", {0, 1, -0.4F}), "follows the jaw");
    EXPECT_EQ(how_a_small_box_goes("tongue01", {0, 1, -0.4F}), "follows the jaw");
    EXPECT_EQ(how_a_small_box_goes("Eyelashes", {0, -1, -0.4F}), "follows the skin");
}

TEST(AttachIslands, TheJawIsTheChinAndMovesWithItWhole) {
    Face face = shapes::mask();
    const std::uint32_t teeth = add_piece(face, "lower_teeth", shapes::strip(3), {-0.5F, -1, -0.5F});
    const Rig rig = rig_of(face);
    std::vector<Vec3f> moves(face.points.size()), positions(vertex_count(face.mesh));
    moves[*find_point(face.points, "2.10")] = {0.25F, -0.5F, 0.125F};
    moves[*find_point(face.points, "2.2")] = {1, 1, 1};
    deform(rig, moves, positions);
    for (std::uint32_t v = teeth; v < positions.size(); ++v)
        EXPECT_EQ(positions[v], rig.rest[v] + (Vec3f{0.25F, -0.5F, 0.125F}));
}

TEST(AttachIslands, WithoutAChinTheLowerLipLeadsAndWithoutBothTheSkull) {
    Face face = shapes::mask();
    const std::uint32_t teeth = add_piece(face, "lower_teeth", shapes::strip(3), {-0.5F, -1, -0.5F});
    std::erase_if(face.points, [](const FeaturePoint& p) { return p.id == "2.10"; });
    EXPECT_EQ(weight(rig_of(face), teeth, "2.3"), (Vec3f{1, 1, 1}));
    std::erase_if(face.points, [](const FeaturePoint& p) { return p.id == "2.3"; });
    EXPECT_EQ(how(rig_of(face), "lower_teeth"), "follows the skull");
    EXPECT_EQ(row_length(rig_of(face), teeth), 0U);
}

TEST(AttachIslands, AChinHeldAlongAnAxisLeavesThatAxisToTheLip) {
    Face face = shapes::mask();
    const std::uint32_t teeth = add_piece(face, "lower_teeth", shapes::strip(3), {-0.5F, -1, -0.5F});
    face.points[*find_point(face.points, "2.10")].moves = {false, true, true};
    const Rig rig = rig_of(face);
    EXPECT_EQ(weight(rig, teeth, "2.10"), (Vec3f{0, 1, 1}));
    EXPECT_EQ(weight(rig, teeth, "2.3"), (Vec3f{1, 0, 0}));
}

TEST(AttachIslands, WhatLiesOnTheSkinMovesLikeTheSkinUnderIt) {
    // A patch that repeats four quads of the mask a little before it.
    Face face = shapes::mask();
    Mesh patch = shapes::grid(2, 2);
    const auto under = [](std::uint32_t v) { return (15 + v / 3) * 25 + 13 + v % 3; };
    for (std::uint32_t v = 0; v < 9; ++v) patch.positions[v] = face.mesh.positions[under(v)] + Vec3f{0, 0, 1e-4F};
    const std::uint32_t first = add_piece(face, "patch", patch);
    const Rig rig = rig_of(face);
    EXPECT_EQ(how(rig, "patch"), "follows the skin");
    for (const FeaturePoint& point : face.points)
        for (std::uint32_t v = 0; v < 9; ++v)
            EXPECT_LT(length(weight(rig, first + v, point.id) - weight(rig, under(v), point.id)), 0.06F);
}

// Two lids, each with its own points, whose borders are 0.1 apart, and a lash on the upper one that hangs over the
// lower: its tip is nearer to the lower lid.
Face lids_and_lash() {
    Face face{shapes::grid(8, 4, 0.25F), {}};
    for (Vec3f& p : face.mesh.positions) p.y += 0.1F;
    const auto lower = static_cast<std::uint32_t>(vertex_count(face.mesh));
    shapes::append(face.mesh, shapes::grid(8, 4, 0.25F), {0, -1, 0});
    for (const std::uint32_t v : {4U, 38U, 42U})
        face.points.push_back(shapes::point_at(face.mesh, std::to_string(v), v));
    for (const std::uint32_t v : {40U, 2U, 6U})
        face.points.push_back(shapes::point_at(face.mesh, "low" + std::to_string(v), lower + v));
    Mesh lash = shapes::grid(4, 2, 0.125F);
    for (std::uint32_t v = 0; v < 15; ++v) {
        const std::uint32_t row = v / 5;
        lash.positions[v] = {0.75F + 0.125F * static_cast<float>(v % 5), 0.1F - 0.07F * static_cast<float>(row),
                             0.01F + 0.02F * static_cast<float>(row)};
    }
    add_piece(face, "lash", lash);
    return face;
}

TEST(AttachIslands, ALashFollowsItsRootAlthoughItsTipIsNearerToTheOtherLid) {
    const Face face = lids_and_lash();
    const Rig rig = rig_of(face);
    const auto first = static_cast<std::uint32_t>(vertex_count(face.mesh) - 15);
    EXPECT_EQ(how(rig, "lash"), "follows the skin");
    for (std::uint32_t v = first; v < first + 15; ++v) {
        for (const char* id : {"low40", "low2", "low6"}) EXPECT_EQ(weight(rig, v, id), Vec3f{});
        EXPECT_GT(weight(rig, v, "4").y, 0.1F) << v;
    }
}

TEST(AttachIslands, ALashIsNotTorn) {
    const Face face = lids_and_lash();
    const Rig rig = rig_of(face);
    std::vector<Vec3f> moves(6, Vec3f{0, 0.5F, 0}), positions(vertex_count(face.mesh));
    moves[0] = {0, -0.5F, 0};
    deform(rig, moves, positions);
    const auto first = static_cast<std::uint32_t>(positions.size() - 15);
    for (std::uint32_t v = first; v < first + 10; ++v)
        EXPECT_LT(distance(positions[v] - rig.rest[v], positions[v + 5] - rig.rest[v + 5]), 0.1F) << v;
}

TEST(AttachIslands, PiecesOfOneNameAreOneLineOfTheReport) {
    Face face = shapes::mask();
    for (int k = 0; k < 5; ++k) {
        add_piece(face, "hair", shapes::strip(1), {0, 4.0F + 2.0F * static_cast<float>(k), -3});
    }
    face.mesh.positions.push_back({9, 9, 9});
    const Rig rig = rig_of(face);
    ASSERT_EQ(rig.attachments.size(), 2U);
    EXPECT_EQ(rig.attachments[0].vertices, 20U);
    EXPECT_EQ(how(rig, "hair"), "follows the skull");
    EXPECT_EQ(how(rig, "loose vertices"), "follows the skull");
}

std::string bytes_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

TEST(AttachIslands, EveryPieceOfARealHeadGoesItsWay) {
    const std::filesystem::path heads = std::filesystem::path(MIEN_SHARED) / "data/mh-caucasian";
    if (!std::filesystem::exists(heads)) GTEST_SKIP() << heads << " is absent";
    const std::string obj = bytes_of(heads / "mh-caucasian-female.obj"), json = bytes_of(heads / "points-obj.json");
    Face face{parse_obj(std::as_bytes(std::span(obj))), {}};
    face.points = parse_points(std::as_bytes(std::span(json)), face.mesh).points;
    std::erase_if(face.points, [](const FeaturePoint& p) {
        return p.id.starts_with("6.") || p.id == "9.8" || p.id == "9.9" || p.id == "9.10" || p.id == "9.11";
    });
    const Rig rig = rig_of(face);
    EXPECT_EQ(how(rig, "eye_left"), "turns about its centre");
    EXPECT_EQ(how(rig, "eye_right"), "turns about its centre");
    EXPECT_EQ(how(rig, "teeth_upper"), "follows the skull");
    EXPECT_EQ(how(rig, "teeth_lower"), "follows the jaw");
    EXPECT_EQ(how(rig, "tongue"), "follows the jaw");
    ASSERT_EQ(rig.eyeballs.size(), 2U);
    EXPECT_EQ(rig.points[*rig.eyeballs[0].point].id, "3.5");
    EXPECT_EQ(rig.points[*rig.eyeballs[1].point].id, "3.6");
}

}  // namespace
}  // namespace mien
