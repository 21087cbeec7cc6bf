// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// What is done once per export: a rig as a skin, a motion as morph targets. A head of 30,000 vertices that 70 points
// move over 500 rows; every vertex knows the 12 nearest points, or all.

#include "mien/algorithms/skin.hpp"

#include <algorithm>
#include <benchmark/benchmark.h>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <span>
#include <utility>
#include <vector>

#include "mien/algorithms/bake_morphs.hpp"

namespace mien {
namespace {

constexpr std::size_t vertices = 30000, points = 70, rows = 500;

// Evenly spread over the front of a ball of radius 100: a spiral by the golden angle.
Vec3 on_the_ball(std::size_t i, std::size_t count) {
    const double z = 1 - (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    const double angle = 2.399963229728653 * static_cast<double>(i), radius = std::sqrt(1 - z * z);
    return {100 * radius * std::cos(angle), 100 * radius * std::sin(angle), 100 * z};
}

// Weights that fall with distance, some negative, as a biharmonic rig has them.
void add_row(Rig& rig, const Vec3& p, std::size_t entries) {
    std::vector<std::pair<double, std::uint16_t>> near;
    for (std::uint16_t k = 0; k < points; ++k) near.push_back({distance(p, rig.points[k].position), k});
    std::sort(near.begin(), near.end());
    near.resize(entries);
    std::sort(near.begin(), near.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
    const auto fall = [](double far) { return std::exp(-far * far / 800) - 0.05 * std::exp(-far * far / 3200); };
    double sum = 0;
    for (const auto& [far, point] : near) sum += fall(far);
    for (const auto& [far, point] : near) {
        const auto w = static_cast<float>(fall(far) / sum);
        rig.row_points.push_back(point);
        rig.weights.push_back({w, 0.9F * w, 1.1F * w});
    }
    rig.row_starts.push_back(static_cast<std::uint32_t>(rig.row_points.size()));
}

Rig ball(std::size_t entries) {
    Rig rig;
    for (std::size_t k = 0; k < points; ++k)
        rig.points.push_back({fmt::format("p{}", k), 0, on_the_ball(k, points), {}, 0});
    rig.row_starts = {0};
    for (std::size_t v = 0; v < vertices; ++v) {
        rig.rest.push_back(to_float(on_the_ball(v, vertices)));
        add_row(rig, on_the_ball(v, vertices), entries);
    }
    return rig;
}

// Waves of six lengths run over the ball.
Take waves(const Rig& rig) {
    Take take;
    for (const FeaturePoint& point : rig.points) take.points.push_back(point.id);
    for (std::size_t r = 0; r < rows; ++r) {
        take.times.push_back(static_cast<double>(r) / 60);
        for (const FeaturePoint& point : rig.points) {
            Vec3 moved;
            for (int wave = 1; wave <= 6; ++wave) {
                const double phase = 0.02 * wave * point.position.x + 0.01 * wave * wave * point.position.y;
                moved += std::sin(0.11 * wave * static_cast<double>(r) + phase) * Vec3{0.5, 1, 0.3};
            }
            take.samples.push_back(point.position + moved);
        }
    }
    return take;
}

MeshSequence played(const Rig& rig, const Take& take) {
    MeshSequence sequence;
    sequence.mesh.positions = rig.rest;
    sequence.times = take.times;
    sequence.positions = [&rig, &take](std::size_t r, std::span<Vec3f> positions) {
        std::vector<Vec3f> moved(points);
        displacements(rig, bind_take(rig, take), row(take, r), moved);
        for (std::size_t v = 0; v < vertices; ++v) {
            positions[v] = rig.rest[v];
            for (std::size_t e = rig.row_starts[v]; e < rig.row_starts[v + 1]; ++e) {
                const Vec3f &w = rig.weights[e], &d = moved[rig.row_points[e]];
                positions[v] += {w.x * d.x, w.y * d.y, w.z * d.z};
            }
        }
    };
    return sequence;
}

void skin(benchmark::State& state) {
    const Rig rig = ball(static_cast<std::size_t>(state.range(0)));
    const Take take = waves(rig);
    Skin skin;
    for ([[maybe_unused]] auto _ : state) skin = make_skin(rig, take, {static_cast<std::uint32_t>(state.range(1))});
    state.counters["mean_error"] = skin.mean_error;
    state.counters["max_error"] = skin.max_error;
}
BENCHMARK(skin)->ArgNames({"entries", "influences"})->ArgsProduct({{12, 70}, {4, 8}})->Unit(benchmark::kMillisecond);

void bake(benchmark::State& state) {
    const Rig rig = ball(12);
    const Take take = waves(rig);
    const MeshSequence sequence = played(rig, take);
    MorphTrack track;
    for ([[maybe_unused]] auto _ : state) track = bake_morphs(sequence);
    state.counters["targets"] = static_cast<double>(track.targets.size());
    state.counters["mean_error"] = track.mean_error;
    state.counters["max_error"] = track.max_error;
}
BENCHMARK(bake)->Unit(benchmark::kMillisecond);

// What of `bake` is the motion itself, which it asks for five times.
void rows_of_the_motion(benchmark::State& state) {
    const Rig rig = ball(12);
    const Take take = waves(rig);
    const MeshSequence sequence = played(rig, take);
    std::vector<Vec3f> positions(vertices);
    for ([[maybe_unused]] auto _ : state)
        for (std::size_t r = 0; r < rows; ++r) sequence.positions(r, positions);
}
BENCHMARK(rows_of_the_motion)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace mien
