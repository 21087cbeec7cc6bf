// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Rigs from example shapes (docs/methods.md, "From example shapes"). `left_out`: mean error on shapes that the rig has
// seen neither of themselves nor of their mirror partners; `mixes`: on random mixes of the shapes it has seen; `single`
// and `free`: of a rig from another head's shapes and of the data-free one; `flipped`: percent of moving triangles.

#include <benchmark/benchmark.h>
#include <map>
#include <string>

#include "prior_figures.hpp"

#include "mien/algorithms/carry_shapes.hpp"
#include "mien/algorithms/rig_biharmonic.hpp"
#include "mien/algorithms/rig_prior.hpp"

namespace mien {
namespace {

using figures::Figures;

const figures::Subject& subject() {
    static const figures::Subject read = figures::read_subject();
    return read;
}
const figures::Subject& other() {
    static const figures::Subject read = figures::read_pocket_subject();
    return read;
}

// MakeHuman's units on the ICT face, and the other way round.
const std::vector<MorphTarget>& units() {
    static const std::vector<MorphTarget> all =
        carry_shapes(other().face, other().face.mesh.morph_targets, subject().face);
    return all;
}
const std::vector<MorphTarget>& shapes_on_other() {
    static const std::vector<MorphTarget> all =
        carry_shapes(subject().face, subject().face.mesh.morph_targets, other().face);
    return all;
}

bool is_there(benchmark::State& state) {
    const bool there =
        std::filesystem::exists(figures::folder()) && std::filesystem::exists(figures::folder("mh-caucasian"));
    if (!there) state.SkipWithError("no heads beside the project");
    return there;
}

struct Way {
    const char* name;
    bool helped;
    PriorOptions options;
};
constexpr Way ways[] = {
    {"all points", true, {true, 0}},
    {"8 points", true, {true, 8}},
    {"8 points, linear", true, {false, 8}},
    {"8 points, no helper", false, {true, 8}},
};

void own_shapes(benchmark::State& state, const Way& way, const char* set) {
    if (!is_there(state)) return;
    const figures::Subject asked = figures::with_points_of(subject(), set);
    const Face& face = asked.face;
    const std::vector<MorphTarget> helper = way.helped ? units() : std::vector<MorphTarget>();
    Figures left_out;
    for (auto _ : state)
        left_out = figures::leave_one_out(asked, [&](const std::vector<MorphTarget>& kept) {
            return rig_prior(face, {kept, helper}, way.options);
        });
    const Rig rig = rig_prior(face, {face.mesh.morph_targets, helper}, way.options);
    const Figures mixed = figures::mixes(rig, asked, 200);
    state.counters["left_out"] = left_out.error;
    state.counters["flipped"] = 100 * left_out.flipped;
    state.counters["mixes"] = mixed.error;
    state.counters["mixes_flipped"] = 100 * mixed.flipped;
}

void carried(benchmark::State& state, const figures::Subject& asked, const std::vector<MorphTarget>& shapes) {
    Rig rig;
    for (auto _ : state) rig = rig_prior(asked.face, {{}, shapes}, {});
    const Rig free = rig_biharmonic(asked.face);
    state.counters["single"] = figures::singles(rig, asked).error;
    state.counters["mixes"] = figures::mixes(rig, asked, 100).error;
    state.counters["free_single"] = figures::singles(free, asked).error;
    state.counters["free_mixes"] = figures::mixes(free, asked, 100).error;
    state.counters["flipped"] = 100 * figures::singles(rig, asked).flipped;
}

void to_ict(benchmark::State& state, const char* set) {
    if (is_there(state)) carried(state, figures::with_points_of(subject(), set), units());
}

void from_ict(benchmark::State& state, const char* set) {
    if (is_there(state)) carried(state, figures::with_points_of(other(), set), shapes_on_other());
}

// What a frame costs: the rows alone, the solve alone, all of it.
enum class Work { rows, solve, one_sided, linear };
void frame(benchmark::State& state, Work work) {
    if (!is_there(state)) return;
    const Face face = figures::with_set(subject(), "all_skin");
    Rig rig = rig_prior(face, {face.mesh.morph_targets, {}}, {work != Work::linear, 8});
    std::vector<Vec3f> points, positions(vertex_count(face.mesh));
    std::vector<float> weights(rig.prior->shapes.size());
    const std::vector<Vec3f> moves = figures::dense(face.mesh.morph_targets.back(), positions.size());
    for (const FeaturePoint& point : face.points) points.push_back(moves[point.vertex]);
    const Prior prior = *rig.prior;
    if (work == Work::rows) rig.prior.reset();
    for (auto _ : state) {
        if (work == Work::solve)
            shape_weights(prior, points, weights);
        else
            deform(rig, points, positions);
        benchmark::DoNotOptimize(positions.data());
        benchmark::DoNotOptimize(weights.data());
    }
}

void bind(benchmark::State& state) {
    if (!is_there(state)) return;
    const Face face = figures::with_set(subject(), "all_skin");
    for (auto _ : state) benchmark::DoNotOptimize(rig_prior(face, {face.mesh.morph_targets, units()}).weights.data());
}

void carry(benchmark::State& state) {
    if (!is_there(state)) return;
    for (auto _ : state)
        benchmark::DoNotOptimize(carry_shapes(other().face, other().face.mesh.morph_targets, subject().face).data());
}

const bool registered = [] {
    using benchmark::kMillisecond;
    for (const char* set : {"all_skin", "vicon27", "dutreve21", "suggested"}) {
        for (const Way& way : ways)
            benchmark::RegisterBenchmark((std::string("prior/own/") + set + "/" + way.name).c_str(), own_shapes, way,
                                         set)
                ->Unit(kMillisecond)
                ->Iterations(1);
        benchmark::RegisterBenchmark((std::string("prior/to ICT/") + set).c_str(), to_ict, set)
            ->Unit(kMillisecond)
            ->Iterations(1);
    }
    for (const char* set : {"all_skin", "vicon27", "dutreve21"})
        benchmark::RegisterBenchmark((std::string("prior/from ICT/") + set).c_str(), from_ict, set)
            ->Unit(kMillisecond)
            ->Iterations(1);
    benchmark::RegisterBenchmark("prior/frame/rows alone", frame, Work::rows);
    benchmark::RegisterBenchmark("prior/frame/solve alone", frame, Work::solve);
    benchmark::RegisterBenchmark("prior/frame/one-sided", frame, Work::one_sided);
    benchmark::RegisterBenchmark("prior/frame/linear", frame, Work::linear);
    benchmark::RegisterBenchmark("prior/bind", bind)->Unit(kMillisecond);
    benchmark::RegisterBenchmark("prior/carry", carry)->Unit(kMillisecond);
    return true;
}();

}  // namespace
}  // namespace mien
