// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/io/points.hpp"

#include <gtest/gtest.h>

#include "io/hostile.hpp"
#include "shapes.hpp"

namespace mien {
namespace {

using testing::HasSubstr;

PointsFile parse(std::string_view text, const Mesh& mesh = shapes::grid(2, 2)) {
    return parse_points(hostile::Copy(text).bytes(), mesh);
}

std::string refusal(std::string_view text) {
    return hostile::refusal([](std::span<const std::byte> bytes) { return parse_points(bytes, shapes::grid(2, 2)); },
                            text);
}

TEST(Points, refuses_what_breaks_its_promise_and_names_the_pointer) {
    EXPECT_THAT(refusal("{}"), HasSubstr("expected feature points, found none"));
    EXPECT_THAT(refusal("{\"2.1\": 9}"), HasSubstr("points /2.1: expected a vertex index from 0, below 9, found '9'"));
    EXPECT_THAT(refusal("{\"points\": {\"2.1\": -1}}"), HasSubstr("points /points/2.1: "));
    EXPECT_THAT(refusal("{\"2.1\": 1.5}"), HasSubstr("found '1.5'"));
    EXPECT_THAT(refusal("{\"2.1\": " + std::string(400, '9') + "}"), HasSubstr("range of a double"));
    EXPECT_THAT(refusal("{\"2.1\": 1, \"2.1\": 2}"), HasSubstr("points /2.1: expected each key once"));
    EXPECT_THAT(refusal("{\"2.1\": 1, \"2.2\": 1}"), HasSubstr("found the place of '2.1'"));
    EXPECT_THAT(refusal("{\"2.\xff"
                        "1\": 3}"),
                HasSubstr("UTF-8"));
    EXPECT_THAT(refusal("{\"2.1\": "), HasSubstr("points byte"));
    EXPECT_THAT(refusal(std::string(100000, '[')), HasSubstr("64 levels"));
    EXPECT_THAT(refusal("[1]"), HasSubstr("expected an object outside"));
    EXPECT_THAT(refusal("{\"2.1\": [1, 2]}"), HasSubstr("three numbers"));
    EXPECT_THAT(refusal("{\"2.1\": [1, 2, 1e300]}"), HasSubstr("finite coordinate"));
    EXPECT_THAT(refusal("{\"2.1\": {\"vertex\": 1, \"position\": [0, 0, 0]}}"),
                HasSubstr("either a vertex or a position"));
    EXPECT_THAT(refusal("{\"2.1\": {\"vertex\": 1, \"move\": \"x\"}}"), HasSubstr("/2.1/move: "));
    EXPECT_THAT(refusal("{\"2.1\": {\"vertex\": 1, \"moves\": \"xx\"}}"), HasSubstr("/2.1/moves: "));
    EXPECT_THAT(refusal("{\"2.1\": {\"vertex\": 1, \"mesh\": 0}}"), HasSubstr("/2.1/mesh: "));
    EXPECT_THAT(refusal("{\"\": {\"a\": 1}, \"points\": []}"), HasSubstr("points /points: expected an object"));
}

TEST(Points, two_points_on_equal_positions_of_different_vertices_are_refused) {
    Mesh mesh = shapes::grid(1, 1);
    mesh.positions.push_back(mesh.positions[0]);
    EXPECT_THROW(parse("{\"2.1\": 0, \"2.2\": 4}", mesh), Error);
}

TEST(Points, keeps_file_order_and_passes_over_underscores) {
    const PointsFile file =
        parse("{\"_about\": [\"2.1\"], \"points\": {\"2.10\": 3, \"_\": {\"x\": 1}, \"2.2\": 1}, \"9.3\": 0}");
    ASSERT_EQ(file.points.size(), 2U);
    EXPECT_EQ(file.points[0].id, "2.10");
    EXPECT_EQ(file.points[1].vertex, 1U);
    EXPECT_EQ(file.points[1].position, (Vec3{1, 0, 0}));
    EXPECT_TRUE(file.warnings.empty());
}

TEST(Points, ids_that_mpeg4_does_not_have_are_kept_with_a_warning) {
    for (const char* id : {"42.7", "2.15", "7.2", "02.1", "2.0", "chin"}) {
        const PointsFile file = parse("{\"" + std::string(id) + "\": 3}");
        EXPECT_EQ(file.points.size(), 1U);
        EXPECT_EQ(file.warnings.size(), 1U) << id;
    }
}

TEST(Points, a_position_snaps_to_the_nearest_vertex_of_a_face) {
    Mesh mesh = shapes::grid(2, 2);
    mesh.positions.push_back({1.1F, 1, 0.1F});  // nearer, but on no face
    const PointsFile file =
        parse("{\"9.3\": [1.1, 1, 0.1], \"2.1\": {\"position\": [0, 0, 3], \"moves\": \"yz\"}}", mesh);
    EXPECT_EQ(file.points[0].vertex, 4U);
    EXPECT_NEAR(file.points[0].snapped, std::sqrt(0.02), 1e-12);
    EXPECT_EQ(file.points[1].snapped, 3);
    EXPECT_EQ(file.points[1].moves, (Axes{false, true, true}));
    ASSERT_EQ(file.warnings.size(), 1U);
    EXPECT_THAT(file.warnings[0], HasSubstr("2.1"));
}

TEST(Points, an_index_counts_through_the_primitives_of_the_mesh_it_names) {
    Mesh mesh = shapes::grid(2, 2);
    mesh.parts = {{"eye", 0, 0, 0, 3, 0, 1}, {"head", 1, 0, 3, 2, 1, 1}, {"head", 1, 1, 5, 4, 2, 2}};
    const PointsFile file =
        parse(R"({"2.1": {"mesh": "head", "vertex": 3}, "2.2": {"mesh": 0, "vertex": 2}, "2.3": 7})", mesh);
    EXPECT_EQ(file.points[0].vertex, 6U);
    EXPECT_EQ(file.points[1].vertex, 2U);
    EXPECT_EQ(file.points[2].vertex, 7U);
    EXPECT_THROW(parse(R"({"2.1": {"mesh": "head", "vertex": 6}})", mesh), Error);
    mesh.parts[0].name = "head";
    EXPECT_THROW(parse(R"({"2.1": {"mesh": "head", "vertex": 3}})", mesh), Error);
}

TEST(Points, what_is_written_reads_back_equal) {
    const Mesh mesh = shapes::grid(2, 2);
    std::vector<FeaturePoint> points{shapes::point_at(mesh, "8.4", 2), shapes::point_at(mesh, "my \"own\"", 5)};
    points[1].moves = {true, false, true};
    const PointsFile again = parse(format_points(points));
    ASSERT_EQ(again.points.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(again.points[i].id, points[i].id);
        EXPECT_EQ(again.points[i].vertex, points[i].vertex);
        EXPECT_EQ(again.points[i].moves, points[i].moves);
    }
}

TEST(Points, numbers_do_not_depend_on_the_locale) {
    const hostile::CommaLocale locale;
    if (!locale.there) GTEST_SKIP() << "no locale with a decimal comma is installed";
    EXPECT_EQ(parse("{\"2.1\": [0.25, 0, 0]}").points[0].snapped, 0.25);
}

TEST(Points, survives_every_prefix_and_every_changed_byte) {
    const Mesh mesh = shapes::grid(2, 2);
    hostile::sweep([&](std::span<const std::byte> bytes) { return parse_points(bytes, mesh); },
                   R"({"points": {"2.1": 3, "a": {"vertex": 1, "moves": "xz"}, "8.4": [0, 1, 0.5]}, "_": [{}]})",
                   [&](const PointsFile& file) {
                       return !file.points.empty() &&
                              std::all_of(file.points.begin(), file.points.end(), [&](const auto& p) {
                                  return p.vertex < mesh.positions.size() && std::isfinite(p.snapped) && !p.id.empty();
                              });
                   });
}

}  // namespace
}  // namespace mien
