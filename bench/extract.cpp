// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Extraction of MPEG-4 from animated heads (docs/papers/laftsidis.md). Each case prints its table: per region the mean
// distance of the replay in percent of the eye distance, its relative error, and what no mix of parameters gives; per
// parameter the learnt field against the one that was drawn. The counters are those over all.

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <iostream>
#include <string>

#include "extract_figures.hpp"

#include "mien/algorithms/bake_morphs.hpp"
#include "mien/io/baked_size.hpp"
#include "mien/io/fba.hpp"
#include "mien/io/fdp_text.hpp"

namespace mien {
namespace {

using extracted::Result;

const char* name_of(Reading reading) {
    return reading == Reading::paper ? "as written" : "remedied";
}

void print_regions(const Result& result) {
    for (std::size_t r = 0; r < result.replay.regions.size(); ++r) {
        const ReplayRegion& region = result.replay.regions[r];
        std::cout << fmt::format("  {:8} mean {:10.4f} % max {:10.2f} % error {:10.4f} beyond {:.4f}\n", region.name,
                                 100 * region.mean, 100 * region.max, region.error, result.beyond[r]);
    }
}

void count(benchmark::State& state, const Result& result) {
    state.counters["mean_percent"] = 100 * result.replay.mean;
    state.counters["error"] = result.replay.error;
    state.counters["beyond"] = result.beyond.back();
    state.counters["vectors"] = static_cast<double>(result.entries);
}

void talking(benchmark::State& state, const std::string& recording, Reading reading) {
    if (!arkit::is_there()) return state.SkipWithError("no head beside the project");
    extracted::Talking talking;
    for (auto _ : state) talking = extracted::talking(recording, 1, reading);
    std::cout << fmt::format("{} {}: head off by {:.5f} degrees, {:.5f} % of the eye distance\n", recording,
                             name_of(reading), talking.pose.degrees, 100 * talking.pose.shift);
    print_regions(talking.result);
    count(state, talking.result);
}

// A table that learnt from one recording plays another.
void unseen(benchmark::State& state) {
    if (!arkit::is_there()) return state.SkipWithError("no head beside the project");
    Result learnt, other;
    for (auto _ : state) {
        learnt = extracted::talking("ns-slate164", 4, Reading::remedied).result;
        other = extracted::talking("jm-slate3", 4, Reading::remedied).result;
    }
    const ReplayError replay = extracted::replayed(other, learnt.learnt.fat);
    state.counters["mean_percent"] = 100 * replay.mean;
    state.counters["error"] = replay.error;
}

void size(benchmark::State& state) {
    if (!arkit::is_there()) return state.SkipWithError("no head beside the project");
    Result result;
    for (auto _ : state) result = extracted::talking("ns-slate164", 1, Reading::remedied).result;
    const EncodedFaps coded = format_fba(result.stream);
    const Face face = extracted::face_of(result);
    const std::size_t all = format_fdp_text({face.points, result.fapu, face.mesh, result.learnt.fat}).size();
    const BakedSize baked = baked_size(result.upright.sequence, bake_morphs(result.upright.sequence));
    const double ours = static_cast<double>(all + coded.bytes.size());
    state.counters["model_and_table"] = static_cast<double>(all);
    state.counters["stream"] = static_cast<double>(coded.bytes.size());
    state.counters["kbit_s"] = coded.kilobits_per_second;
    state.counters["ratio_mdd"] = static_cast<double>(baked.point_cache) / ours;
    state.counters["ratio_meshopt"] = static_cast<double>(baked.morph_per_row) / ours;
    state.counters["ratio_few_morphs"] = static_cast<double>(baked.morph_track) / ours;
}

void drawn(benchmark::State& state, bool together, bool driven, Reading reading) {
    if (!obadiah::is_there()) return state.SkipWithError("no head beside the project");
    const obadiah::Subject subject = obadiah::read_subject();
    const extracted::Fields fields = extracted::drawn_fields(subject.face.mesh);
    const FapStream stream = together ? extracted::all_at_once(fields) : extracted::one_by_one(fields);
    Result result;
    for (auto _ : state)
        result =
            extracted::learn(extracted::drawn(subject.face, fields, stream), reading, driven ? stream : FapStream{});
    count(state, result);
    if (!driven) return;
    double mean = 0, strangers = 0;
    for (const extracted::FieldError& field : extracted::field_errors(subject.face, fields, result.learnt.fat)) {
        mean += field.error / static_cast<double>(fields.size());
        strangers += static_cast<double>(field.strangers);
        std::cout << fmt::format("  {:2} {:22} field off by {:.4f}, outside its support {:.4f} of its peak\n",
                                 field.fap, fap_info(field.fap).name, field.error, field.outside);
    }
    state.counters["field_error"] = mean;
    state.counters["strangers"] = strangers;
}

const bool registered = [] {
    const auto add = [](const std::string& name, auto function) {
        benchmark::RegisterBenchmark(name.c_str(), function)->Unit(benchmark::kMillisecond)->Iterations(1);
    };
    for (const Reading reading : {Reading::remedied, Reading::paper}) {
        const std::string how = name_of(reading);
        for (const char* recording : {"jm-slate3", "ns-slate164"})
            add("extract/talking/" + std::string(recording) + "/" + how,
                [=](benchmark::State& state) { talking(state, recording, reading); });
        for (const bool together : {false, true})
            for (const bool driven : {true, false})
                add(fmt::format("extract/drawn/{}/{}/{}", together ? "all at once" : "one by one",
                                driven ? "its parameters" : "extracted", how),
                    [=](benchmark::State& state) { drawn(state, together, driven, reading); });
    }
    add("extract/unseen", unseen);
    add("extract/size", size);
    return true;
}();

}  // namespace
}  // namespace mien
