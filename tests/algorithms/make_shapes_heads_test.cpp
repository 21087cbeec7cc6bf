// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Shapes of real heads, among them a creature, closed eye sockets and a coarse mannequin whose lips have no slit. What
// must be true of them is judged on their edges and faces, not by how they were made.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <iostream>

#include "retarget_faces.hpp"

#include "mien/algorithms/check_shapes.hpp"
#include "mien/algorithms/make_shapes.hpp"
#include "mien/algorithms/rig_biharmonic.hpp"
#include "mien/io/read.hpp"

namespace mien {
namespace {

struct Place {
    std::string_view id;
    Vec3 position;
};

// Points of the mannequin, by eye: the midline and the subject's left, which is +z; it looks along -x.
constexpr Place mannequin_places[] = {
    {"2.1", {-6.33, 5.75, 0}},      {"2.2", {-6.65, 8.98, 0}},    {"2.3", {-6.59, 8.58, 0}},
    {"2.10", {-6.73, 6.76, 0}},     {"8.1", {-6.75, 9.3, 0}},     {"8.2", {-6.63, 8.09, 0}},
    {"9.3", {-7.29, 11.07, 0}},     {"9.12", {-6.58, 11.94, 0}},  {"9.15", {-6.41, 10.08, 0}},
    {"11.1", {-3.4, 15.9, 0}},      {"2.4", {-5.77, 8.61, 1.54}}, {"2.6", {-6.46, 8.92, 0.6}},
    {"2.8", {-6.44, 8.55, 0.57}},   {"2.11", {-6.0, 6.5, 1.3}},   {"2.13", {-2.2, 7.0, 3.6}},
    {"3.1", {-4.10, 13.06, 2.0}},   {"3.3", {-4.31, 12.3, 2.08}}, {"3.7", {-3.87, 12.5, 2.9}},
    {"3.11", {-4.12, 12.59, 1.13}}, {"3.9", {-4.3, 11.9, 2.1}},   {"3.13", {-4.3, 13.4, 2.0}},
    {"4.1", {-4.9, 13.7, 0.9}},     {"4.3", {-4.6, 14.0, 2.0}},   {"4.5", {-3.7, 13.6, 3.1}},
    {"5.1", {-4.7, 9.0, 2.9}},      {"5.3", {-4.6, 11.0, 2.8}},   {"8.3", {-5.5, 8.46, 2.03}},
    {"8.5", {-6.57, 9.22, 0.65}},   {"8.7", {-6.5, 8.12, 0.62}},  {"8.10", {-6.73, 9.43, 0.29}},
    {"9.1", {-5.9, 10.6, 1.05}},    {"9.5", {-6.2, 10.2, 0.55}},  {"9.7", {-5.2, 12.6, 0.5}},
    {"9.13", {-6.2, 11.6, 0.5}},    {"10.7", {-0.6, 10.3, 4.2}},
};

std::string mannequin_points() {
    nlohmann::json points;
    for (const auto& [id, p] : mannequin_places) {
        points[std::string(id)] = {p.x, p.y, p.z};
        if (p.z != 0) points[std::string(mirror_point(id))] = {p.x, p.y, -p.z};
    }
    return points.dump();
}

struct Head {
    const char *name, *file, *points;  // no file of points: those above
};

std::ostream& operator<<(std::ostream& out, const Head& head) {
    return out << head.name;
}

class ShapesOfRealHeads : public ::testing::TestWithParam<Head> {};

TEST_P(ShapesOfRealHeads, CloseTheEyesOpenTheJawAndTurnNoSkinOver) {
    const std::filesystem::path file = faces::folder() / GetParam().file;
    if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
    Face face{read_mesh(file), {}};
    const std::string points = GetParam().points == nullptr ? mannequin_points() : faces::contents(GetParam().points);
    const PointsFile parsed = parse_points(std::as_bytes(std::span(points)), face.mesh);
    EXPECT_TRUE(parsed.warnings.empty());
    face.points = parsed.points;
    BiharmonicOptions every_influence;
    every_influence.influences = 0;
    const Rig rig = rig_biharmonic(with_points(face, shape_points(face)), every_influence);
    const ShapesCheck check = check_shapes(face, make_shapes(face, rig).shapes);
    ASSERT_TRUE(check.blink_left && check.blink_right && check.upper_lip);
    std::cout << fmt::format("{}: blink {:.4f} {:.4f}, upper lip {:.4f}, flipped {:.5f}\n", GetParam().name,
                             check.blink_left->most, check.blink_right->most, *check.upper_lip, check.flipped);
    for (const Openness& blink : {*check.blink_left, *check.blink_right}) {
        EXPECT_LE(blink.most, 0.05);
        EXPECT_GE(blink.least, -0.05);
    }
    EXPECT_LE(*check.upper_lip, 0.03);
    EXPECT_LE(check.flipped, 0.003);
}

INSTANTIATE_TEST_SUITE_P(
    All, ShapesOfRealHeads,
    ::testing::Values(Head{"Mannequin", "cgal-head/head.off", nullptr},
                      Head{"Suzanne", "suzanne/suzi.glb", "suzanne/points.json"},
                      Head{"Woman", "mh-caucasian/mh-caucasian-female.obj", "mh-caucasian/points-obj.json"},
                      Head{"Man", "mh-caucasian/mh-caucasian-male.obj", "mh-caucasian/points-obj.json"}),
    [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace mien
