// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/bake_morphs.hpp"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <limits>
#include <set>
#include <tbb/global_control.h>
#include <utility>
#include <vector>

#include "shapes.hpp"

#include "mien/error.hpp"

namespace mien {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

using Frames = std::vector<std::vector<Vec3f>>;

// A sequence that plays displacements: one entry per row and vertex.
MeshSequence playing(Mesh mesh, Frames moved) {
    std::vector<double> times;
    for (std::size_t r = 0; r < moved.size(); ++r) times.push_back(static_cast<double>(r) / 60);
    const std::vector<Vec3f> neutral = mesh.positions;
    return {std::move(mesh), std::move(times),
            [neutral, moved = std::move(moved)](std::size_t row, std::span<Vec3f> positions) {
                for (std::size_t v = 0; v < neutral.size(); ++v) positions[v] = neutral[v] + moved[row][v];
            }};
}

MeshSequence still(std::size_t rows) {
    return playing(shapes::grid(3, 3), Frames(rows, std::vector<Vec3f>(16)));
}

// Vertex v of mode k: smooth, and independent of the other modes.
Vec3 mode(std::size_t k, std::size_t v) {
    const double a = static_cast<double>(k + 1), b = static_cast<double>(v);
    return {std::sin(0.37 * a * b), std::cos(0.11 * a * b + a), std::sin(0.05 * a * b + 2 * a)};
}

// Motion of the given rank about a neutral head of side 10; the modes weaken as 1, 1/2, 1/4 and so on.
MeshSequence of_rank(std::size_t rank, std::size_t rows) {
    Mesh mesh = shapes::grid(10, 10);
    Frames moved(rows, std::vector<Vec3f>(mesh.positions.size()));
    for (std::size_t r = 0; r < rows; ++r)
        for (std::size_t v = 0; v < moved[r].size(); ++v) {
            Vec3 sum;
            for (std::size_t k = 0; k < rank; ++k)
                sum += std::ldexp(std::sin(0.3 * static_cast<double>((r + 1) * (k + 1))), -static_cast<int>(k)) *
                       mode(k, v);
            moved[r][v] = to_float(sum);
        }
    return playing(std::move(mesh), std::move(moved));
}

// What a viewer shows: positions(row) = neutral + sum of weight times target.
std::vector<Vec3> shown(const MorphTrack& track, const Mesh& mesh, std::size_t row) {
    std::vector<Vec3> positions;
    for (const Vec3f& p : mesh.positions) positions.push_back(to_double(p));
    for (std::size_t k = 0; k < track.targets.size(); ++k)
        for (std::size_t i = 0; i < track.targets[k].vertices.size(); ++i)
            positions[track.targets[k].vertices[i]] +=
                double{track.weights[row * track.targets.size() + k]} * to_double(track.targets[k].deltas[i]);
    return positions;
}

struct Errors {
    double mean = 0, max = 0;
};

Errors errors(const MorphTrack& track, const MeshSequence& sequence) {
    Errors result;
    std::vector<Vec3f> frame(sequence.mesh.positions.size());
    for (std::size_t r = 0; r < sequence.times.size(); ++r) {
        sequence.positions(r, frame);
        const std::vector<Vec3> positions = shown(track, sequence.mesh, r);
        for (std::size_t v = 0; v < frame.size(); ++v) {
            const double d = distance(positions[v], to_double(frame[v]));
            result.mean += d * d;
            result.max = std::max(result.max, d);
        }
    }
    result.mean = std::sqrt(result.mean / static_cast<double>(sequence.times.size() * frame.size()));
    return result;
}

TEST(BakeMorphs, rejects_a_sequence_without_rows) {
    EXPECT_THROW(bake_morphs(still(0)), Error);
}

TEST(BakeMorphs, names_the_row_and_vertex_of_a_number_that_is_not_finite) {
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), -std::numeric_limits<float>::infinity()}) {
        Frames moved(4, std::vector<Vec3f>(16));
        moved[2][13].y = bad;
        try {
            bake_morphs(playing(shapes::grid(3, 3), moved));
            FAIL() << "took " << bad;
        } catch (const Error& e) {
            EXPECT_THAT(e.what(), HasSubstr("row 2, vertex 13"));
        }
    }
}

TEST(BakeMorphs, gives_no_targets_for_a_head_that_keeps_still) {
    const MorphTrack track = bake_morphs(still(3));
    EXPECT_THAT(track.targets, IsEmpty());
    EXPECT_THAT(track.weights, IsEmpty());
    EXPECT_THAT(track.times, ElementsAre(0, 1 / 60.0, 2 / 60.0));
    EXPECT_EQ(track.mean_error, 0);
    EXPECT_EQ(track.max_error, 0);
}

TEST(BakeMorphs, takes_one_motion_apart_into_its_largest_shape_and_its_share_of_it) {
    Frames moved(3, std::vector<Vec3f>(4));
    moved[1][2] = {0, -1, 0};
    moved[2][2] = {0, 4, 0};
    moved[1][3] = {0.5F, 0, 0};
    moved[2][3] = {-2, 0, 0};
    const MorphTrack track = bake_morphs(playing(shapes::grid(1, 1), moved));
    ASSERT_EQ(track.targets.size(), 1);
    EXPECT_EQ(track.targets[0].name, "morph_01");
    EXPECT_THAT(track.targets[0].vertices, ElementsAre(2, 3));
    EXPECT_NEAR(track.targets[0].deltas[0].y, 4, 1e-6);
    EXPECT_NEAR(track.targets[0].deltas[1].x, -2, 1e-6);
    EXPECT_EQ(track.weights[2], 1);
    EXPECT_NEAR(track.weights[1], -0.25, 1e-7);
    EXPECT_NEAR(track.weights[0], 0, 1e-7);
}

TEST(BakeMorphs, gives_back_motion_of_rank_k_with_k_targets) {
    for (const std::size_t rank : {1U, 2U, 5U, 9U}) {
        const MeshSequence sequence = of_rank(rank, 40);
        const MorphTrack track = bake_morphs(sequence, {24, 0, 0});
        EXPECT_EQ(track.targets.size(), rank);
        EXPECT_LT(errors(track, sequence).max, 3e-6) << "rank " << rank;  // floats up to 10 are 1e-6 apart
    }
}

TEST(BakeMorphs, gives_back_motion_that_begins_late_in_a_long_sequence) {
    MeshSequence sequence = of_rank(6, 700);
    sequence.positions = [play = sequence.positions, neutral = sequence.mesh.positions](std::size_t row,
                                                                                        std::span<Vec3f> positions) {
        play(row, positions);
        if (row < 400) std::copy(neutral.begin(), neutral.end(), positions.begin());
    };
    const MorphTrack track = bake_morphs(sequence, {24, 0, 0});
    EXPECT_EQ(track.targets.size(), 6);
    EXPECT_LT(errors(track, sequence).max, 3e-6);
}

// 363 coordinates that have nothing to do with each other: more shapes than are kept from block to block.
TEST(BakeMorphs, counts_what_was_dropped_between_blocks_as_error) {
    std::uint32_t state = 1;
    const auto noise = [&] { return static_cast<float>((state = state * 1664525U + 1013904223U) >> 8) / (1U << 24); };
    Frames moved(600, std::vector<Vec3f>(121));
    for (auto& row : moved)
        for (Vec3f& d : row) d = {noise() - 0.5F, noise() - 0.5F, noise() - 0.5F};
    const MeshSequence sequence = playing(shapes::grid(10, 10), moved);
    const MorphTrack track = bake_morphs(sequence, {256, 0.1, 0});
    EXPECT_EQ(track.targets.size(), 256);
    EXPECT_GT(track.mean_error, 0.1 * std::sqrt(0.75));
}

TEST(BakeMorphs, takes_the_rounding_of_far_coordinates_for_no_motion) {
    Mesh mesh = shapes::grid(10, 10);
    for (Vec3f& p : mesh.positions) p += {1000, 1000, 1000};
    Frames moved(30, std::vector<Vec3f>(121));
    for (std::size_t r = 0; r < 30; ++r)
        for (std::size_t v = 0; v < 121; ++v) moved[r][v] = to_float(0.01 * std::sin(0.3 * double(r)) * mode(0, v));
    EXPECT_EQ(bake_morphs(playing(mesh, moved), {24, 0, 0}).targets.size(), 1);
}

TEST(BakeMorphs, gives_weights_whose_largest_is_one) {
    const MorphTrack track = bake_morphs(of_rank(5, 40));
    const std::size_t n = track.targets.size();
    ASSERT_GT(n, 2);
    ASSERT_EQ(track.weights.size(), 40 * n);
    for (std::size_t k = 0; k < n; ++k) {
        std::vector<float> weights;
        for (std::size_t r = 0; r < 40; ++r) weights.push_back(track.weights[r * n + k]);
        EXPECT_EQ(*std::max_element(weights.begin(), weights.end()), 1);
        EXPECT_GE(*std::min_element(weights.begin(), weights.end()), -1);
    }
}

TEST(BakeMorphs, measures_the_error_that_it_leaves) {
    const MeshSequence sequence = of_rank(9, 40);
    for (const std::uint32_t morphs : {0U, 1U, 4U}) {
        const MorphTrack track = bake_morphs(sequence, {morphs, 0, 0.05});
        const Errors expected = errors(track, sequence);
        EXPECT_EQ(track.targets.size(), morphs);
        EXPECT_GT(expected.mean, 0.01);
        EXPECT_NEAR(track.mean_error, expected.mean, 1e-6);
        EXPECT_NEAR(track.max_error, expected.max, 1e-6);
    }
}

TEST(BakeMorphs, stops_at_the_fewest_targets_within_the_tolerance) {
    const MeshSequence sequence = of_rank(9, 40);
    double largest = 0;
    for (std::size_t r = 0; r < 40; ++r) {
        std::vector<Vec3f> frame(sequence.mesh.positions.size());
        sequence.positions(r, frame);
        for (std::size_t v = 0; v < frame.size(); ++v)
            largest = std::max(largest, distance(to_double(frame[v]), to_double(sequence.mesh.positions[v])));
    }
    for (const double tolerance : {0.2, 0.03, 0.005}) {
        const MorphTrack track = bake_morphs(sequence, {24, tolerance, 0});
        const auto fewer = static_cast<std::uint32_t>(track.targets.size() - 1);
        EXPECT_LE(track.mean_error, tolerance * largest);
        EXPECT_GT(bake_morphs(sequence, {fewer, 0, 0}).mean_error, tolerance * largest);
    }
}

TEST(BakeMorphs, finds_no_worse_shapes_than_the_modes_it_was_made_of) {
    const MeshSequence sequence = of_rank(4, 60);
    // The same motion cut after two modes, and its distance to the whole.
    const MeshSequence cut = of_rank(2, 60);
    std::vector<Vec3f> a(121), b(121);
    double sum = 0;
    for (std::size_t r = 0; r < 60; ++r) {
        sequence.positions(r, a);
        cut.positions(r, b);
        for (std::size_t v = 0; v < 121; ++v) sum += std::pow(distance(to_double(a[v]), to_double(b[v])), 2);
    }
    EXPECT_LT(bake_morphs(sequence, {2, 0, 0}).mean_error, std::sqrt(sum / (60 * 121)));
}

TEST(BakeMorphs, drops_small_deltas_and_fits_the_weights_again) {
    Frames moved(20, std::vector<Vec3f>(121));
    for (std::size_t r = 0; r < 20; ++r)
        for (std::size_t v = 0; v < 121; ++v) {
            const double size = v < 30 ? 1 : v < 100 ? 0.01 : 0;
            moved[r][v] = to_float(size * std::sin(0.4 * static_cast<double>(r)) * mode(0, v));
        }
    const MeshSequence sequence = playing(shapes::grid(10, 10), moved);
    const MorphTrack dense = bake_morphs(sequence, {24, 1e-3, 0}), sparse = bake_morphs(sequence, {24, 1e-3, 0.05});
    ASSERT_EQ(dense.targets.size(), 1);
    ASSERT_EQ(sparse.targets.size(), 1);
    EXPECT_EQ(dense.targets[0].vertices.size(), 100);
    EXPECT_EQ(sparse.targets[0].vertices.size(), 30);
    EXPECT_LT(dense.max_error, 1e-6);
    EXPECT_NEAR(sparse.max_error, 0.017, 2e-3);  // the dropped ones: 0.01 times a mode of length up to sqrt(3)
}

TEST(BakeMorphs, gives_the_weights_that_fit_the_sparse_targets_best) {
    const MeshSequence sequence = of_rank(9, 40);
    const MorphTrack track = bake_morphs(sequence, {5, 0, 0.1});
    std::vector<Vec3f> frame(121);
    for (std::size_t r = 0; r < 40; ++r) {
        sequence.positions(r, frame);
        const std::vector<Vec3> positions = shown(track, sequence.mesh, r);
        for (const MorphTarget& target : track.targets) {
            double along = 0;  // what is left has no part along any target
            for (std::size_t i = 0; i < target.vertices.size(); ++i) {
                const std::uint32_t v = target.vertices[i];
                along += dot(to_double(frame[v]) - positions[v], to_double(target.deltas[i]));
            }
            EXPECT_NEAR(along, 0, 1e-4) << "row " << r << ' ' << target.name;
        }
    }
}

TEST(BakeMorphs, leaves_vertices_alone_that_never_move) {
    Frames moved(12, std::vector<Vec3f>(121));
    for (std::size_t r = 0; r < 12; ++r)
        for (std::size_t v = 40; v < 60; ++v)
            moved[r][v] = to_float(std::cos(static_cast<double>(r)) * mode(0, v) + mode(r % 3, v));
    std::set<std::uint32_t> touched;
    for (const MorphTarget& target : bake_morphs(playing(shapes::grid(10, 10), moved), {24, 0, 0}).targets) {
        EXPECT_TRUE(std::is_sorted(target.vertices.begin(), target.vertices.end()));
        EXPECT_EQ(target.vertices.size(), target.deltas.size());
        touched.insert(target.vertices.begin(), target.vertices.end());
    }
    EXPECT_EQ(touched.size(), 20);
    EXPECT_EQ(*touched.begin(), 40);
    EXPECT_EQ(*touched.rbegin(), 59);
}

TEST(BakeMorphs, turns_with_the_head) {
    const MeshSequence sequence = of_rank(3, 30);
    MeshSequence turned = sequence;  // a quarter turn: (x, y, z) -> (-y, x, z), exact in floats
    for (Vec3f& p : turned.mesh.positions) p = {-p.y, p.x, p.z};
    turned.positions = [&](std::size_t row, std::span<Vec3f> positions) {
        sequence.positions(row, positions);
        for (Vec3f& p : positions) p = {-p.y, p.x, p.z};
    };
    const MorphTrack a = bake_morphs(sequence), b = bake_morphs(turned);
    ASSERT_EQ(a.targets.size(), b.targets.size());
    EXPECT_NEAR(a.mean_error, b.mean_error, 1e-6);
    for (std::size_t i = 0; i < a.weights.size(); ++i) EXPECT_NEAR(a.weights[i], b.weights[i], 1e-4);
}

TEST(BakeMorphs, gives_the_same_bytes_with_any_thread_count) {
    const MeshSequence sequence = of_rank(12, 300);
    std::vector<MorphTrack> tracks;
    for (const std::size_t threads : {1, 2, 8}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        tracks.push_back(bake_morphs(sequence));
    }
    for (const MorphTrack& track : tracks) {
        EXPECT_EQ(track.weights, tracks[0].weights);
        EXPECT_EQ(track.mean_error, tracks[0].mean_error);
        EXPECT_EQ(track.max_error, tracks[0].max_error);
        ASSERT_EQ(track.targets.size(), tracks[0].targets.size());
        for (std::size_t k = 0; k < track.targets.size(); ++k)
            EXPECT_TRUE(track.targets[k].deltas == tracks[0].targets[k].deltas);
    }
}

}  // namespace
}  // namespace mien
