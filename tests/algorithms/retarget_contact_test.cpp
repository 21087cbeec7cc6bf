// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// What meets on the performer meets on the target: lids and lips of people, of a cartoon, of another topology and of a
// creature. Lengths are in eye distances of the face they are on.

#include <cmath>
#include <gtest/gtest.h>

#include "retarget_faces.hpp"

#include "mien/error.hpp"

namespace mien {
namespace {

using faces::Frames;
using faces::Points;

constexpr const char* lids[][2] = {{"3.1", "3.3"}, {"3.2", "3.4"}};
constexpr const char* inner_lips[][2] = {{"2.2", "2.3"}, {"2.6", "2.8"}, {"2.7", "2.9"}};

const RetargetOptions plain{RetargetMethod::local_affine, Reading::remedied, {}, false};
const RetargetOptions units{RetargetMethod::fapu, Reading::remedied, {}, true};

// A face of round numbers whose two halves are alike.
Points drawn_face(double lid_opening = 0.18, double lip_opening = 0.01) {
    const std::map<std::string, Vec3> left{{"3.1", {0.5, lid_opening / 2, 0.12}},
                                           {"3.3", {0.5, -lid_opening / 2, 0.11}},
                                           {"3.7", {0.72, 0.01, -0.04}},
                                           {"3.11", {0.28, -0.01, 0.04}},
                                           {"3.13", {0.5, lid_opening / 2 + 0.1, 0.12}},
                                           {"3.9", {0.5, -lid_opening / 2 - 0.07, 0.1}},
                                           {"4.1", {0.2, 0.42, 0.3}},
                                           {"4.3", {0.6, 0.46, 0.17}},
                                           {"4.5", {0.9, 0.3, -0.1}},
                                           {"9.5", {0.2, -0.7, 0.33}},
                                           {"2.4", {0.36, -1.07, 0.2}},
                                           {"8.3", {0.41, -1.08, 0.2}},
                                           {"2.6", {0.16, -1.05, 0.36}},
                                           {"2.8", {0.16, -1.05 - lip_opening, 0.35}},
                                           {"8.5", {0.2, -0.95, 0.41}},
                                           {"8.7", {0.2, -1.2, 0.38}},
                                           {"5.3", {0.76, -0.37, 0.02}}};
    Points face{{"9.3", {0, -0.47, 0.67}}, {"9.15", {0, -0.71, 0.43}},
                {"2.2", {0, -1.05, 0.38}}, {"2.3", {0, -1.05 - lip_opening, 0.37}},
                {"8.1", {0, -0.93, 0.46}}, {"8.2", {0, -1.22, 0.43}},
                {"2.1", {0, -1.74, 0.25}}, {"2.10", {0, -1.56, 0.33}}};
    for (const auto& [id, p] : left) {
        face[id] = p;
        face[std::string(mirror_point(id))] = {-p.x, p.y, p.z};
    }
    return face;
}

// Proportions of their own: large eyes, a small mouth.
Points drawn_creature(double lip_opening = 0.01) {
    Points face = drawn_face(0.4, lip_opening);
    for (auto& [id, p] : face) {
        if (id[0] == '2' || id[0] == '8') p.x *= 0.4;
        p = {1.2 * p.x, 0.8 * p.y, p.z + 0.1 * p.x * p.x};
    }
    return face;
}

// Both eyes close by a share of their opening: the upper lid goes the given part of the way, and both slip sideways.
Points closing(const Points& face, double share, double upper_part, double slip = 0) {
    Points frame;
    for (const auto& [upper, lower] : lids) {
        if (!face.contains(upper) || !face.contains(lower)) continue;
        const Vec3 opening = face.at(upper) - face.at(lower);
        const Vec3 aside{slip * faces::eyes(face), 0, 0};
        frame[upper] = -share * upper_part * opening + aside;
        frame[lower] = share * (1 - upper_part) * opening + aside;
    }
    return frame;
}

double opening(const Take& take, std::size_t r, const char* const (&pair)[2]) {
    return distance(row(take, r)[*find_column(take, pair[0])], row(take, r)[*find_column(take, pair[1])]);
}

// Along the way in which the pair is open at rest; for lips upwards.
double upright(const Take& take, std::size_t r, const char* const (&pair)[2]) {
    return (row(take, r)[*find_column(take, pair[0])] - row(take, r)[*find_column(take, pair[1])]).y;
}

TEST(Contact, lids_that_meet_on_the_source_meet_on_the_target_wherever_they_meet) {
    const Points source = drawn_face(), target = drawn_creature();
    const double size = faces::eyes(target);
    for (const double part : {0.0, 0.5, 1.0})
        for (const double slip : {-0.02, 0.0, 0.02}) {
            const Take take = faces::take_of(source, {closing(source, 1, part, slip)});
            const Take out = faces::performed(take, target);
            for (const auto& pair : lids) {
                EXPECT_LE(opening(out, 1, pair), 0.00051 * size);
                EXPECT_GT(opening(faces::performed(take, target, plain), 1, pair), 0.05 * size);
            }
        }
}

TEST(Contact, a_half_closed_eye_is_half_closed) {
    const Points source = drawn_face(), target = drawn_creature();
    const Take out = faces::performed(faces::take_of(source, {closing(source, 0.5, 0.8)}), target);
    for (const auto& pair : lids) EXPECT_NEAR(opening(out, 1, pair) / opening(out, 0, pair), 0.5, 1e-9);
}

TEST(Contact, the_lid_that_moved_takes_the_correction_and_its_fold_half_of_it) {
    const Points source = drawn_face(), target = drawn_creature();
    const Take take = faces::take_of(source, {closing(source, 1, 1)});
    const Take with = faces::performed(take, target), without = faces::performed(take, target, plain);
    const auto moved = [&](const char* id) {
        return length(row(with, 1)[*find_column(with, id)] - row(without, 1)[*find_column(with, id)]);
    };
    EXPECT_GT(moved("3.1"), 20 * moved("3.3"));
    EXPECT_NEAR(moved("3.13"), moved("3.1") / 2, 1e-12);
    EXPECT_NEAR(moved("3.9"), moved("3.3") / 2, 1e-12);
    EXPECT_EQ(moved("4.1"), 0);
}

TEST(Contact, lids_and_lips_that_cross_on_the_source_do_not_cross_on_the_target) {
    const Points source = drawn_face(), target = drawn_creature();
    Points crossing = closing(source, 1.4, 0.7);
    for (const auto& pair : inner_lips) crossing[pair[0]] = {0, -0.1, 0};
    const Take take = faces::take_of(source, {crossing});
    const Take out = faces::performed(take, target), without = faces::performed(take, target, plain);
    for (const auto& pair : lids) EXPECT_GE(upright(out, 1, pair), -1e-12);
    for (const auto& pair : inner_lips) {
        EXPECT_GE(upright(out, 1, pair), -1e-12);
        EXPECT_LT(upright(without, 1, pair), -0.01);
    }
}

TEST(Contact, the_opening_goes_through_rest_and_the_floor_without_a_step_or_a_kink) {
    const Points source = drawn_face(), target = drawn_creature();
    Frames frames;
    for (int i = -300; i <= 1200; ++i) frames.push_back(closing(source, i / 1000.0, 0.6));
    const Take out = faces::performed(faces::take_of(source, frames), target);
    double last = 0;
    for (std::size_t r = 2; r < row_count(out); ++r) {
        const double step = upright(out, r - 1, lids[0]) - upright(out, r, lids[0]);
        EXPECT_GE(step, -1e-12);
        if (r > 2) {
            EXPECT_LT(std::abs(step - last), 0.08e-3);
        }
        last = step;
    }
}

TEST(Contact, rest_maps_to_rest_also_where_the_targets_mouth_is_nearly_closed_or_crossed) {
    for (const double mouth : {0.3, 0.01, 0.001, -0.012}) {
        const Points target = drawn_creature(mouth);
        const Take out = faces::performed(faces::take_of(drawn_face(), {Points{}}), target);
        for (std::size_t c = 0; c < out.points.size(); ++c)
            EXPECT_LT(distance(row(out, 1)[c], target.at(out.points[c])), 1e-9) << mouth << " " << out.points[c];
    }
}

TEST(Contact, a_face_maps_to_itself_where_nothing_crosses) {
    const Points face = drawn_face(0.18, 0.06);
    Points smile = closing(face, 0.7, 0.9, 0.01);
    smile["8.3"] = {0.05, 0.04, -0.03};
    smile["2.3"] = {0.01, -0.2, -0.02};
    const Take take = faces::take_of(face, {smile});
    for (const RetargetOptions& options : {RetargetOptions{}, units}) {
        const Take out = faces::performed(take, face, options);
        for (std::size_t c = 0; c < out.points.size(); ++c)
            EXPECT_LT(distance(row(out, 1)[c], row(take, 1)[*find_column(take, out.points[c])]), 1e-6);
    }
}

TEST(Contact, a_lower_lid_that_the_source_lacks_is_taken_to_be_still) {
    Points source = drawn_face();
    const Points target = drawn_creature();
    const Points frame = closing(source, 1, 1);
    source.erase("3.3");
    source.erase("3.4");
    const Take take = faces::take_of(source, {frame});
    const Take out = faces::performed(take, target), without = faces::performed(take, target, plain);
    const auto gap = [&](const Take& t) { return distance(row(t, 1)[*find_column(t, "3.1")], target.at("3.3")); };
    EXPECT_LT(gap(out), 0.025 * faces::eyes(target));
    EXPECT_GT(gap(without), 0.1 * faces::eyes(target));
}

TEST(Contact, a_mouth_open_at_rest_closes_to_the_opening_that_the_user_names) {
    const Points source = drawn_face(), target = drawn_creature(0.2);
    RetargetOptions options;
    options.sealed = {{"2.2", 0.03}};
    const double size = faces::eyes(target);
    const auto up = [&](const Take& take, const RetargetOptions& o) {
        return upright(faces::performed(take, target, o), 1, inner_lips[0]) / size;
    };
    EXPECT_NEAR(up(faces::take_of(source, {Points{}}), options), 0.03, 0.005);  // up in the face, not in space
    EXPECT_GT(up(faces::take_of(source, {Points{}}), {}), 0.1);
    const Points wide{{"2.3", {0, -0.8, 0}}};
    EXPECT_NEAR(up(faces::take_of(source, {wide}), options), up(faces::take_of(source, {wide}), {}), 0.02);

    const Points speaker = drawn_face(0.18, 0.1), shut{{"2.3", {0, 0.1, 0.01}}};
    EXPECT_NEAR(up(faces::take_of(speaker, {shut}), options), 0.03, 0.01);
    options.sealed = {{"4.1", 0.03}};
    EXPECT_THROW((void)faces::performed(faces::take_of(source, {Points{}}), target, options), Error);
}

TEST(Contact, moving_scaling_or_turning_either_side_changes_nothing) {
    const Points source = drawn_face(), target = drawn_creature();
    Points frame = closing(source, 0.9, 0.7, 0.01);
    frame["2.3"] = {0.01, -0.1, 0};
    frame["2.2"] = {0, -0.13, 0};
    const auto turned = [](const Vec3& p) {
        return 37.0 * rotate({0.5, -0.5, 0.1, std::sqrt(0.49)}, p) + Vec3{300, -100, 50};
    };
    const auto changed = [&](Points points) {
        for (auto& [id, p] : points) p = turned(p);
        return points;
    };
    Take take = faces::take_of(source, {frame});
    for (const RetargetOptions& options : {RetargetOptions{}, units}) {
        const Take before = faces::performed(take, target, options);
        Take moved = take;
        for (Vec3& p : moved.samples) p = turned(p);
        const Take of_source = faces::performed(moved, target, options);
        const Take of_target = faces::performed(take, changed(target), options);
        for (std::size_t i = 0; i < before.samples.size(); ++i) {
            EXPECT_LT(distance(of_source.samples[i], before.samples[i]), 1e-6);
            EXPECT_LT(distance(of_target.samples[i], turned(before.samples[i])), 37e-6);
        }
    }
}

TEST(Contact, a_lost_lid_leaves_its_partner_to_its_own_map) {
    const Points source = drawn_face(), target = drawn_creature();
    Take take = faces::take_of(source, {closing(source, 1, 0.5)});
    row(take, 1)[*find_column(take, "3.1")] = lost_sample;
    const Take out = faces::performed(take, target), without = faces::performed(take, target, plain);
    EXPECT_FALSE(is_finite(row(out, 1)[*find_column(out, "3.1")]));
    EXPECT_EQ(row(out, 1)[*find_column(out, "3.3")], row(without, 1)[*find_column(out, "3.3")]);
    EXPECT_LT(opening(out, 1, lids[1]), 0.00051 * faces::eyes(target));
}

TEST(Contact, a_frame_alone_goes_where_the_row_of_a_take_goes) {
    const Points source = drawn_face(), target = drawn_creature();
    Take take = faces::take_of(source, {closing(source, 0.7, 0.5, 0.01)});
    row(take, 1)[4] = lost_sample;
    const Retarget map = fit_retarget(take, faces::face_of(target));
    const Take out = retarget(map, take);
    std::vector<Vec3> frame, moved(map.points.size());
    for (const std::string& id : map.points) frame.push_back(row(take, 1)[*find_column(take, id)]);
    retarget(map, frame, moved);
    for (std::size_t i = 0; i < moved.size(); ++i) {
        EXPECT_EQ(is_finite(moved[i]), i != 4);
        if (i != 4) {
            EXPECT_EQ(moved[i], row(out, 1)[i]);
        }
    }
}

TEST(Contact, a_picture_of_closing_eyes_closes_them) {
    const Points source = drawn_face(), target = drawn_creature();
    Take take = faces::take_of(source, {closing(source, 1, 0.8)});
    take.planar = true;
    for (std::size_t c = 0; c < take.points.size(); ++c) row(take, 1)[c].z += 5;  // does not matter
    const Take out = faces::performed(take, target);
    for (const auto& pair : lids) EXPECT_LE(opening(out, 1, pair), 0.00051 * faces::eyes(target));
}

TEST(Units, a_creature_moves_in_its_own_lengths) {
    const Points source = drawn_face(), target = drawn_creature();
    const Points frame{{"8.3", {0.1, 0, 0}}, {"8.4", {-0.1, 0, 0}}, {"4.1", {0, 0.1, 0}}};
    const Take take = faces::take_of(source, {frame});
    const RetargetOptions no_contact{RetargetMethod::fapu, Reading::remedied, {}, false};
    const Take out = faces::performed(take, target, no_contact);
    const auto moved = [&](const char* id) {
        return length(row(out, 1)[*find_column(out, id)] - row(out, 0)[*find_column(out, id)]);
    };
    EXPECT_NEAR(moved("8.3"), 0.1 * 0.48, 1e-3);  // the mouth is 0.4 x 1.2 as wide
    EXPECT_NEAR(moved("4.1"), 0.1 * 0.8, 5e-3);   // the nose is 0.8 as long
}

TEST(Units, an_axis_whose_unit_a_face_lacks_follows_the_local_map) {
    Points source = drawn_face();
    source.erase("9.15");
    const Points target = drawn_creature();
    const Take take = faces::take_of(source, {Points{{"4.1", {0, 0.1, 0}}, {"4.2", {0, 0.1, 0}}}});
    const RetargetOptions no_contact{RetargetMethod::fapu, Reading::remedied, {}, false};
    const Take out = faces::performed(take, target, no_contact), local = faces::performed(take, target, plain);
    const auto up = [](const Take& t) {
        return (row(t, 1)[*find_column(t, "4.1")] - row(t, 0)[*find_column(t, "4.1")]).y;
    };
    EXPECT_NEAR(up(out), up(local), 0.01 * up(local));
}

}  // namespace
}  // namespace mien
