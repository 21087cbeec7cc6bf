// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Pictures of the ICT face at 640 x 480: how long a pose takes, a draft, a full picture, and many heads at once. Its
// skin has 11,248 vertices; quads are cut into four until it has the 26,719 of the complete model.

#include <array>
#include <benchmark/benchmark.h>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "mien/algorithms/riggers.hpp"
#include "mien/io/read.hpp"
#include "mien/io/scene.hpp"
#include "mien/render/dress.hpp"
#include "mien/render/renderer.hpp"

namespace mien {
namespace {

constexpr std::size_t complete = 26719;

struct Subject {
    Rig rig;
    Scene scene;
};

// The middle of two vertices: a new vertex that moves as both do.
struct Cutter {
    Rig& rig;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> known;

    std::uint32_t middle(std::uint32_t a, std::uint32_t b) {
        const auto key = std::minmax(a, b);
        const auto [found, is_new] = known.try_emplace(key, static_cast<std::uint32_t>(rig.rest.size()));
        if (is_new) add({a, b});
        return found->second;
    }
    std::uint32_t add(std::vector<std::uint32_t> of) {
        std::map<std::uint16_t, Vec3f> row;
        Vec3f place;
        const float share = 1 / static_cast<float>(of.size());
        for (const std::uint32_t v : of) {
            place += share * rig.rest[v];
            for (std::uint32_t e = rig.row_starts[v]; e < rig.row_starts[v + 1]; ++e)
                row[rig.row_points[e]] += share * rig.weights[e];
        }
        rig.rest.push_back(place);
        for (const auto& [point, weight] : row) {
            rig.row_points.push_back(point);
            rig.weights.push_back(weight);
        }
        rig.row_starts.push_back(static_cast<std::uint32_t>(rig.row_points.size()));
        return static_cast<std::uint32_t>(rig.rest.size() - 1);
    }
};

Subject read_subject() {
    const std::filesystem::path folder = std::filesystem::path(MIEN_SHARED) / "data/ict";
    const Face face = read_face(folder / "ict_neutral.obj", folder / "feature_points.json");
    Subject subject{make_rig(face, "biharmonic"), {}};
    Cutter cutter{subject.rig, {}};
    Surface surface;
    const auto add = [&](std::array<std::uint32_t, 4> q) {
        surface.triangles.insert(surface.triangles.end(), {q[0], q[1], q[2], q[0], q[2], q[3]});
    };
    for (std::size_t f = 0; f < face_count(face.mesh); ++f) {
        const auto c = mien::face(face.mesh, f);
        const std::array corners{c[0], c[1], c[2], c[3 % c.size()]};
        if (subject.rig.rest.size() + 5 > complete || c.size() != 4) {
            add(corners);
            continue;
        }
        const std::uint32_t m = cutter.add({c[0], c[1], c[2], c[3]});
        for (std::size_t k = 0; k < 4; ++k)
            add({c[k], cutter.middle(c[k], c[(k + 1) % 4]), m, cutter.middle(c[k], c[(k + 3) % 4])});
    }
    while (subject.rig.rest.size() < complete) cutter.add({0});
    surface.positions = subject.rig.rest;
    subject.scene.nodes.emplace_back();
    subject.scene.materials.emplace_back();
    subject.scene.surfaces.push_back(surface);
    dress(subject.scene, &subject.rig);
    return subject;
}

const Subject* subject() {
    if (!std::filesystem::exists(std::filesystem::path(MIEN_SHARED) / "data/ict/ict_neutral.obj")) return nullptr;
    static const Subject read = read_subject();
    return &read;
}

// Heads in rows, each with a pose of its own.
struct Crowd {
    Renderer renderer;
    std::vector<ModelId> heads;
    Camera camera;

    explicit Crowd(std::size_t count) {
        const auto columns = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(count))));
        heads.push_back(renderer.upload(subject()->scene, {&subject()->rig, {}}));
        const Box box = renderer.rest_box(heads[0]);
        while (heads.size() < count) {
            const auto column = static_cast<double>(heads.size() % columns);
            const auto line = static_cast<double>(heads.size() / columns);
            heads.push_back(renderer.copy(heads[0]));
            renderer.place(heads.back(),
                           {Affine{}.columns, {column * (box.high.x - box.low.x), line * (box.high.y - box.low.y), 0}});
        }
        Box all = box;
        for (const ModelId head : heads) {
            all.high.x = std::max(all.high.x, renderer.rest_box(head).high.x);
            all.high.y = std::max(all.high.y, renderer.rest_box(head).high.y);
        }
        camera = frame(all, View::front, 640, 480);
    }
    void pose(int frame) {
        std::vector<Vec3f> moves(subject()->rig.points.size());
        for (std::size_t h = 0; h < heads.size(); ++h) {
            for (std::size_t k = 0; k < moves.size(); ++k)
                moves[k].y = 0.3F * std::sin(static_cast<float>(frame) * 0.2F + static_cast<float>(k + h));
            renderer.pose(heads[h], moves);
        }
    }
};

std::unique_ptr<Crowd> crowd(benchmark::State& state, std::size_t count) {
    if (subject() == nullptr) {
        state.SkipWithError("no ICT face beside the project");
        return nullptr;
    }
    try {
        auto made = std::make_unique<Crowd>(count);
        state.SetLabel(made->renderer.device());
        return made;
    } catch (const std::exception& error) {
        state.SkipWithError(error.what());
        return nullptr;
    }
}

void per_second(benchmark::State& state, double frames) {
    state.counters["frames"] = benchmark::Counter(frames, benchmark::Counter::kIsIterationInvariantRate);
}

// Twenty poses and one look at the last, which waits for all of them.
void pose(benchmark::State& state) {
    const auto heads = crowd(state, 1);
    if (!heads) return;
    std::vector<Vec3f> positions(heads->renderer.vertex_count(heads->heads[0]));
    int frame = 0;
    for ([[maybe_unused]] auto _ : state) {
        for (int i = 0; i < 20; ++i) heads->pose(++frame);
        heads->renderer.read_positions(heads->heads[0], positions);
    }
    per_second(state, 20);
}
BENCHMARK(pose)->Name("render/pose")->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

void draw(benchmark::State& state, Quality quality) {
    // Ten thousand heads need 6 GB and are for graphics cards.
    if (state.range(0) > 1000 && subject() != nullptr && Renderer().device().find("llvmpipe") != std::string::npos) {
        state.SkipWithError("no graphics card");
        return;
    }
    const auto heads = crowd(state, static_cast<std::size_t>(state.range(0)));
    if (!heads) return;
    Look look;
    look.quality = quality;
    if (quality == Quality::full) look.passes = static_cast<std::uint32_t>(state.range(1));
    int frame = 0;
    for ([[maybe_unused]] auto _ : state) {
        heads->pose(++frame);
        benchmark::DoNotOptimize(heads->renderer.draw(heads->heads, heads->camera, look));
    }
    per_second(state, 1);
}
BENCHMARK_CAPTURE(draw, draft, Quality::draft)
    ->Name("render/draft")
    ->ArgName("heads")
    ->Arg(1)
    ->Arg(100)
    ->Arg(10000)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK_CAPTURE(draw, full, Quality::full)
    ->Name("render/full")
    ->ArgNames({"heads", "passes"})
    ->Args({1, 16})
    ->Args({1, 48})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

}  // namespace
}  // namespace mien
