// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/play_shapes.hpp"

#include <algorithm>
#include <gtest/gtest.h>

#include "slit_mask.hpp"

#include "mien/error.hpp"

namespace mien {
namespace {

struct Played {
    Face face;
    ShapePlayer player;
    std::vector<Vec3f> moves;
};

Played play(std::initializer_list<std::pair<std::string_view, float>> shapes) {
    Played played{shapes::slit_mask(), {}, {}};
    played.player = fit_shape_player(played.face);
    std::vector<float> weights(played.player.motions.size());
    for (const auto& [name, weight] : shapes) {
        const auto all = named_shapes();
        const auto at =
            std::find_if(all.begin(), all.end(), [&, n = name](const NamedShape& s) { return s.name == n; });
        weights[static_cast<std::size_t>(at - all.begin())] = weight;
    }
    std::vector<Vec3> sums(2 * played.player.points.size());
    played.moves.resize(played.player.points.size());
    play_shapes(played.player, weights, sums, played.moves);
    return played;
}

Vec3f at(const Played& played, const char* id) {
    const auto& ids = played.player.points;
    return played.moves[static_cast<std::size_t>(std::find(ids.begin(), ids.end(), id) - ids.begin())];
}

// How far two points are apart, as a share of what they are at rest.
double apart(const Played& played, const char* upper, const char* lower) {
    const auto place = [&](const char* id) { return played.face.points[*find_point(played.face.points, id)].position; };
    const double rest = place(upper).y - place(lower).y;
    return (rest + static_cast<double>(at(played, upper).y - at(played, lower).y)) / rest;
}

TEST(PlayShapes, no_weights_are_rest) {
    for (const Vec3f& move : play({}).moves) EXPECT_LT(length(move), 1e-6F);
}

TEST(PlayShapes, a_blink_shuts_the_eye_and_half_a_blink_half) {
    EXPECT_NEAR(apart(play({{"eyeBlinkLeft", 1}}), "3.1", "3.3"), 0.1, 0.1);
    EXPECT_NEAR(apart(play({{"eyeBlinkLeft", 0.5F}}), "3.1", "3.3"), 0.55, 0.1);
}

TEST(PlayShapes, lids_that_are_told_to_cross_stop_where_they_meet) {
    const Played played = play({{"eyeBlinkLeft", 1}, {"eyeSquintLeft", 1}, {"eyeLookDownLeft", 1}});
    EXPECT_GT(apart(played, "3.1", "3.3"), -0.02);
    EXPECT_LT(apart(played, "3.1", "3.3"), 0.1);
}

TEST(PlayShapes, the_mouth_closes_whatever_else_the_face_does) {
    for (const float smile : {0.0F, 0.7F}) {
        const Played open = play({{"jawOpen", 1}, {"mouthSmileLeft", smile}});
        const Played closed = play({{"jawOpen", 1}, {"mouthClose", 1}, {"mouthSmileLeft", smile}});
        const float way = at(open, "2.2").y - at(open, "2.3").y;
        EXPECT_GT(way, 0.2F);
        EXPECT_NEAR((at(closed, "2.2").y - at(closed, "2.3").y) / way, 0, 0.05);
    }
}

TEST(PlayShapes, refuses_points_that_the_table_does_not_know) {
    Face face = shapes::slit_mask();
    for (FeaturePoint& point : face.points) point.id = "mine " + point.id;
    EXPECT_THROW((void)fit_shape_player(face), Error);
}

}  // namespace
}  // namespace mien
