// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Every way to rig, on the ICT face model: how far from the truth, and how long it takes to bind. `error` is the mean
// over 27 shapes of RMS error / RMS motion; `flipped` is in percent of the moving triangles.

#include <benchmark/benchmark.h>
#include <optional>
#include <string>

#include "rig_figures.hpp"

#include "mien/algorithms/riggers.hpp"

namespace mien {
namespace {

struct Way {
    const char* name;
    const char* method;
    RigOptions options;
};
constexpr Way ways[] = {
    {"biharmonic, all points", "biharmonic", {Reading::remedied, 0}},
    {"biharmonic, 8 points a vertex", "biharmonic", {Reading::remedied, 8}},
    {"surface distance, paper", "surface-distance", {Reading::paper, 0}},
    {"surface distance, remedied", "surface-distance", {Reading::remedied, 0}},
    {"ellipsoid, paper", "ellipsoid", {Reading::paper, 0}},
    {"ellipsoid, remedied", "ellipsoid", {Reading::remedied, 0}},
    {"rbf, all points", "rbf", {Reading::remedied, 0}},
    {"rbf, 8 points a vertex", "rbf", {Reading::remedied, 8}},
    {"rbf along the surface, all points", "rbf-surface", {Reading::remedied, 0}},
    {"rbf along the surface, 8 points a vertex", "rbf-surface", {Reading::remedied, 8}},
};
constexpr const char* sets[] = {"all_skin", "vicon27", "dutreve21"};

const figures::Subject& subject() {
    static const figures::Subject read = figures::read_subject();
    return read;
}

void bind(benchmark::State& state, const Way& way, const char* set) {
    if (!std::filesystem::exists(figures::folder())) {
        state.SkipWithError("no ICT face beside the project");
        return;
    }
    const Face face = figures::with_set(subject(), set);
    Rig rig;
    for (auto _ : state) rig = make_rig(face, way.method, way.options);
    const figures::Figures figures = figures::measure(rig, subject());
    state.counters["error"] = figures.error;
    state.counters["flipped"] = 100 * figures.flipped;
}

const bool registered = [] {
    for (const char* set : sets)
        for (const Way& way : ways)
            benchmark::RegisterBenchmark((std::string("rigs/") + set + "/" + way.name).c_str(), bind, way, set)
                ->Unit(benchmark::kMillisecond);
    return true;
}();

}  // namespace
}  // namespace mien
