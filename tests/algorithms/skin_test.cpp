// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/skin.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <set>
#include <tbb/global_control.h>
#include <utility>
#include <vector>

#include "mien/error.hpp"

namespace mien {
namespace {

// A rig without vertices whose points lie on a line, one unit apart.
Rig points_on_a_line(std::size_t count) {
    Rig rig;
    for (std::size_t i = 0; i < count; ++i)
        rig.points.push_back({fmt::format("p{}", i), 0, {static_cast<double>(i), 0, 0}, {}, 0});
    rig.row_starts = {0};
    return rig;
}

void add_vertex(Rig& rig, const std::vector<std::pair<std::uint16_t, Vec3f>>& row) {
    rig.rest.push_back({});
    for (const auto& [point, weight] : row) {
        rig.row_points.push_back(point);
        rig.weights.push_back(weight);
    }
    rig.row_starts.push_back(static_cast<std::uint32_t>(rig.row_points.size()));
}

Vec3f all(float w) {
    return {w, w, w};
}

// A take that displaces the rig's points: one entry per row and point.
Take moving(const Rig& rig, const std::vector<std::vector<Vec3>>& rows) {
    Take take;
    for (const FeaturePoint& p : rig.points) take.points.push_back(p.id);
    for (const auto& row : rows) {
        take.times.push_back(static_cast<double>(take.times.size()));
        for (std::size_t i = 0; i < row.size(); ++i) take.samples.push_back(rig.points[i].position + row[i]);
    }
    return take;
}

// Repeatable numbers in [-1, 1).
struct Noise {
    std::uint32_t state = 1;
    double operator()() {
        state = state * 1664525U + 1013904223U;
        return static_cast<double>(state >> 8) / (1U << 23) - 1;
    }
};

Rig noisy_rig(std::size_t points, std::size_t vertices, std::size_t entries) {
    Noise noise;
    const auto some = [&] { return static_cast<float>(0.12 + 0.3 * noise()); };  // rows sum to about 1
    Rig rig = points_on_a_line(points);
    for (std::size_t v = 0; v < vertices; ++v) {
        std::vector<std::pair<std::uint16_t, Vec3f>> row;
        for (std::size_t k = 0; k < entries; ++k)
            row.push_back({static_cast<std::uint16_t>((v + k) % points), {some(), some(), some()}});
        std::sort(row.begin(), row.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
        add_vertex(rig, row);
    }
    return rig;
}

Take noisy_take(const Rig& rig, std::size_t rows) {
    Noise noise{7};
    std::vector<std::vector<Vec3>> moved(rows, std::vector<Vec3>(rig.points.size()));
    for (auto& row : moved)
        for (Vec3& d : row) d = {noise(), noise(), noise()};
    return moving(rig, moved);
}

// Near points move alike: three waves along the line in every row.
Take waving_take(const Rig& rig, std::size_t rows) {
    Noise noise{7};
    std::vector<std::vector<Vec3>> moved(rows, std::vector<Vec3>(rig.points.size()));
    for (auto& row : moved)
        for (int wave = 0; wave < 3; ++wave) {
            const Vec3 size{noise(), noise(), noise()};
            for (std::size_t k = 0; k < row.size(); ++k) row[k] += std::cos(0.3 * wave * static_cast<double>(k)) * size;
        }
    return moving(rig, moved);
}

Vec3 mirrored(const Vec3& p) {
    return {-p.x, p.y, p.z};
}

// Weight of `joint` at `vertex`.
float weight(const Skin& skin, std::size_t vertex, std::size_t joint) {
    float sum = 0;
    for (std::size_t i = vertex * skin.influences; i < (vertex + 1) * skin.influences; ++i)
        if (skin.joints[i] == joint) sum += skin.weights[i];
    return sum;
}

Vec3 rig_motion(const Rig& rig, std::size_t v, const std::vector<Vec3f>& moved) {
    Vec3 sum;
    for (std::size_t e = rig.row_starts[v]; e < rig.row_starts[v + 1]; ++e) {
        const Vec3 w = to_double(rig.weights[e]), d = to_double(moved[rig.row_points[e]]);
        sum += {w.x * d.x, w.y * d.y, w.z * d.z};
    }
    return sum;
}

Vec3 skin_motion(const Skin& skin, std::size_t v, const std::vector<Pose>& poses) {
    Vec3 sum;
    for (std::size_t i = v * skin.influences; i < (v + 1) * skin.influences; ++i)
        sum += double{skin.weights[i]} * poses[skin.joints[i]].translation;
    return sum;
}

struct Errors {
    double mean = 0, max = 0;
};

// Root mean square and largest distance between skin and rig, from the definitions.
Errors errors(const Rig& rig, const Skin& skin, const Take& take) {
    const TakeBinding binding = bind_take(rig, take);
    std::vector<Vec3f> moved(rig.points.size());
    std::vector<Pose> poses(joint_count(rig));
    Errors result;
    for (std::size_t r = 0; r < row_count(take); ++r) {
        displacements(rig, binding, row(take, r), moved);
        joint_poses(rig, moved, poses);
        for (std::size_t v = 0; v < vertex_count(rig); ++v) {
            const double d = distance(rig_motion(rig, v, moved), skin_motion(skin, v, poses));
            result.mean += d * d;
            result.max = std::max(result.max, d);
        }
    }
    result.mean = std::sqrt(result.mean / static_cast<double>(row_count(take) * vertex_count(rig)));
    return result;
}

// What is commonly done: the heaviest weights, negative ones dropped, normalised when they exceed one.
Skin cut_and_normalised(const Rig& rig, std::uint32_t influences) {
    Skin skin{influences, {}, {}, 0, 0};
    for (std::size_t v = 0; v < vertex_count(rig); ++v) {
        std::vector<std::pair<float, std::uint16_t>> row;
        for (std::size_t e = rig.row_starts[v]; e < rig.row_starts[v + 1]; ++e)
            row.push_back(
                {std::max(0.0F, (rig.weights[e].x + rig.weights[e].y + rig.weights[e].z) / 3), rig.row_points[e]});
        std::sort(row.rbegin(), row.rend());
        row.resize(influences - 1);
        float sum = 0;
        for (const auto& [w, point] : row) sum += w;
        for (const auto& [w, point] : row) {
            skin.weights.push_back(sum > 1 ? w / sum : w);
            skin.joints.push_back(point);
        }
        skin.weights.push_back(sum > 1 ? 0 : 1 - sum);
        skin.joints.push_back(static_cast<std::uint16_t>(rig.points.size()));
    }
    return skin;
}

TEST(MakeSkin, rejects_influences_that_no_engine_has) {
    for (const std::uint32_t influences : {0U, 3U, 5U, 20U})
        EXPECT_THROW(make_skin(points_on_a_line(1), {}, {influences}), Error) << influences;
}

TEST(MakeSkin, holds_what_the_file_format_asks_for) {
    const Rig rig = noisy_rig(9, 60, 8);
    for (const std::uint32_t influences : {4U, 8U}) {
        const Skin skin = make_skin(rig, noisy_take(rig, 20), {influences});
        ASSERT_EQ(skin.joints.size(), 60 * influences);
        for (std::size_t v = 0; v < 60; ++v) {
            double sum = 0;
            std::set<std::uint16_t> joints;
            for (std::size_t i = v * influences; i < (v + 1) * influences; ++i) {
                const float w = skin.weights[i];
                const bool used = w != 0;
                sum += w;
                EXPECT_GE(w, 0);
                EXPECT_TRUE(!used || joints.insert(skin.joints[i]).second) << "a joint twice in vertex " << v;
                EXPECT_TRUE(used || skin.joints[i] == 0);
                EXPECT_TRUE(i == v * influences || skin.weights[i - 1] * (1 + 1e-6F) >= w);
            }
            EXPECT_NEAR(sum, 1, 2e-7);
        }
    }
}

TEST(MakeSkin, keeps_weights_that_are_a_skin_already) {
    Rig rig = points_on_a_line(3);
    add_vertex(rig, {{1, all(1)}});
    add_vertex(rig, {{0, all(0.5F)}, {2, all(0.25F)}});
    add_vertex(rig, {});
    for (const Take& take : {Take{}, noisy_take(rig, 12)}) {
        const Skin skin = make_skin(rig, take);
        EXPECT_EQ(weight(skin, 0, 1), 1);
        EXPECT_NEAR(weight(skin, 1, 0), 0.5, 1e-6);
        EXPECT_NEAR(weight(skin, 1, 2), 0.25, 1e-6);
        EXPECT_NEAR(weight(skin, 1, 3), 0.25, 1e-6);
        EXPECT_EQ(weight(skin, 2, 3), 1);
        EXPECT_LT(skin.max_error, 1e-6);
    }
}

TEST(MakeSkin, takes_the_weight_of_the_axis_that_the_take_moves_along) {
    Rig rig = points_on_a_line(1);
    add_vertex(rig, {{0, {1, 0.5F, 0}}});
    const Skin skin = make_skin(rig, moving(rig, {{{0, 1, 0}}, {{0, -2, 0}}}));
    // The prior of one thousandth pulls towards the mean of the axes, here the same 0.5.
    EXPECT_NEAR(weight(skin, 0, 0), 0.5, 1e-6);
    EXPECT_NEAR(weight(make_skin(rig, moving(rig, {{{1, 0, 0}}})), 0, 0), 1, 1e-3);
}

TEST(MakeSkin, trades_weights_of_points_that_move_alike) {
    Rig rig = points_on_a_line(2);
    add_vertex(rig, {{0, all(1.2F)}, {1, all(-0.4F)}});
    const Skin skin = make_skin(rig, moving(rig, {{{1, 0, 0}, {1, 0, 0}}, {{0, 3, 0}, {0, 3, 0}}}));
    EXPECT_NEAR(weight(skin, 0, 0), 0.8, 1e-3);
    EXPECT_EQ(weight(skin, 0, 1), 0);
    EXPECT_LT(skin.max_error, 3e-3);
}

// Point 0 moves nearly as 1 and 2 together, so it looks best at first; the best of all lets it go again.
TEST(MakeSkin, lets_go_of_a_joint_that_others_replace) {
    Rig rig = points_on_a_line(3);
    add_vertex(rig, {{0, all(-0.1F)}, {1, all(0.5F)}, {2, all(0.5F)}});
    const Skin skin = make_skin(rig, moving(rig, {{{1, 1, 0.1}, {1, 0, 0}, {0, 1, 0}}}));
    EXPECT_NEAR(weight(skin, 0, 0), 0, 0.01);
    EXPECT_NEAR(weight(skin, 0, 1), 0.4, 0.01);
    EXPECT_NEAR(weight(skin, 0, 2), 0.4, 0.01);
}

TEST(MakeSkin, finds_the_best_weights_that_a_grid_search_finds) {
    Rig rig = points_on_a_line(2);
    add_vertex(rig, {{0, {1.3F, 0.2F, 0.4F}}, {1, {-0.2F, 0.9F, 0.5F}}});
    const Take take = noisy_take(rig, 9);
    const Skin skin = make_skin(rig, take);
    double best = 1e9;
    for (int i = 0; i <= 200; ++i)
        for (int j = 0; i + j <= 200; ++j) {
            const float a = static_cast<float>(i) / 200, b = static_cast<float>(j) / 200;
            best = std::min(best, errors(rig, {4, {0, 1, 2, 0}, {a, b, 1 - a - b, 0}, 0, 0}, take).mean);
        }
    EXPECT_LT(skin.mean_error, best * 1.001);
}

TEST(MakeSkin, leaves_nothing_to_gain_by_moving_weight_from_joint_to_joint) {
    const Rig rig = noisy_rig(12, 12, 12);
    const Take take = waving_take(rig, 40);
    const Skin best = make_skin(rig, take, {16});
    for (std::size_t from = 0; from < best.weights.size(); ++from)
        for (std::uint16_t to = 0; best.weights[from] > 0 && to <= 12; ++to) {
            Skin other = best;
            const float moved = std::min(other.weights[from], 0.02F);
            const std::size_t spare = from / 16 * 16 + 15;
            other.weights[from] -= moved;
            other.joints[spare] = to;
            other.weights[spare] += moved;
            EXPECT_GT(errors(rig, other, take).mean, best.mean_error - 1e-5) << "slot " << from << " to joint " << to;
        }
}

TEST(MakeSkin, measures_the_error_that_it_leaves) {
    Rig rig = noisy_rig(9, 30, 8);
    rig.points[4].moves.y = false;
    rig.points[4].vertex = 3;
    const Take take = noisy_take(rig, 25);
    const Skin skin = make_skin(rig, take);
    const Errors expected = errors(rig, skin, take);
    EXPECT_GT(expected.mean, 0.01);
    EXPECT_NEAR(skin.mean_error, expected.mean, 1e-6);
    EXPECT_NEAR(skin.max_error, expected.max, 1e-6);
}

TEST(MakeSkin, loses_less_than_cutting_and_normalising) {
    const Rig rig = noisy_rig(9, 60, 8);
    for (const Take& take : {noisy_take(rig, 20), waving_take(rig, 20)}) {
        const double cut = errors(rig, cut_and_normalised(rig, 4), take).mean;
        const double fitted = make_skin(rig, take).mean_error;
        EXPECT_LT(fitted, cut);
        EXPECT_LT(make_skin(rig, take, {8}).mean_error, fitted);
    }
    EXPECT_LT(make_skin(rig, waving_take(rig, 20)).mean_error,
              0.85 * errors(rig, cut_and_normalised(rig, 4), waving_take(rig, 20)).mean);
}

// Points and vertices in pairs: those of odd number are the mirror images (x -> -x) of the ones before.
TEST(MakeSkin, gives_mirrored_vertices_mirrored_weights) {
    Noise noise;
    Rig rig;
    rig.row_starts = {0};
    for (std::uint32_t i = 0; i < 10; ++i) {
        const Vec3 left = i % 2 == 0 ? Vec3{1.5 + noise(), noise(), noise()} : mirrored(rig.points[i - 1].position);
        rig.points.push_back({fmt::format("p{}", i), 0, left, {}, 0});
    }
    for (std::size_t v = 0; v < 20; ++v) {
        std::vector<std::pair<std::uint16_t, Vec3f>> left, right(10);
        for (std::uint16_t k = 0; k < 10; ++k) left.push_back({k, to_float({0.1 + 0.3 * noise(), 0.1, 0.2 * noise()})});
        for (std::uint16_t k = 0; k < 10; ++k) right[k ^ 1U] = {static_cast<std::uint16_t>(k ^ 1U), left[k].second};
        add_vertex(rig, left);
        add_vertex(rig, right);
    }
    std::vector<std::vector<Vec3>> moved(15, std::vector<Vec3>(10));
    for (auto& row : moved)
        for (std::size_t k = 0; k < 10; ++k)
            row[k] = k % 2 == 0 ? Vec3{noise(), noise(), noise()} : mirrored(row[k - 1]);
    for (const Take& take : {moving(rig, moved), Take{}}) {
        const Skin skin = make_skin(rig, take);
        for (std::size_t v = 0; v < 40; v += 2)
            for (std::size_t k = 0; k < 10; ++k)
                EXPECT_NEAR(weight(skin, v, k), weight(skin, v + 1, k ^ 1U), 1e-5) << "vertex " << v << " joint " << k;
    }
}

TEST(MakeSkin, without_a_take_tells_the_error_of_unit_motion) {
    Rig rig = points_on_a_line(1);
    add_vertex(rig, {{0, all(1.5F)}});
    const Skin skin = make_skin(rig, {});
    EXPECT_EQ(weight(skin, 0, 0), 1);
    EXPECT_NEAR(skin.mean_error, 0.5, 1e-6);
    EXPECT_NEAR(skin.max_error, 0.5, 1e-6);
}

TEST(MakeSkin, hangs_eyeballs_on_their_joint_and_counts_them_as_exact) {
    Rig rig = points_on_a_line(2);
    add_vertex(rig, {{0, all(2)}});
    add_vertex(rig, {});
    rig.eyeballs = {{"left", {}, {}, {}}, {"right", {1}, {5, 0, 0}, 1}};
    const Skin skin = make_skin(rig, moving(rig, {{{2, 0, 0}, {0, 1, 0}}}));
    EXPECT_EQ(weight(skin, 1, 4), 1);
    EXPECT_NEAR(skin.max_error, 2, 1e-6);
    EXPECT_NEAR(skin.mean_error, std::sqrt(2 * 2 / 2.0), 1e-6);
}

TEST(MakeSkin, gives_the_same_bytes_with_any_thread_count) {
    const Rig rig = noisy_rig(9, 300, 8);
    const Take take = noisy_take(rig, 20);
    std::vector<Skin> skins;
    for (const std::size_t threads : {1, 2, 8}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        skins.push_back(make_skin(rig, take));
    }
    for (const Skin& skin : skins) {
        EXPECT_EQ(skin.weights, skins[0].weights);
        EXPECT_EQ(skin.joints, skins[0].joints);
        EXPECT_EQ(skin.mean_error, skins[0].mean_error);
    }
}

}  // namespace
}  // namespace mien
