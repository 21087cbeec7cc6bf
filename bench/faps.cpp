// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Every parameter played alone on a head that was made by hand for MPEG-4, with a displacement field for each: `sign` 1
// where both go the same way along the parameter's axis, `cosine` between the fields, `size` ours over drawn at the
// feature point, `error` and `shape_error` in percent of what was drawn, as it is and at the best size.

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "obadiah_figures.hpp"

namespace mien {
namespace {

const obadiah::Subject& subject() {
    static const obadiah::Subject read = obadiah::read_subject();
    return read;
}

void play(benchmark::State& state, int fap) {
    if (!obadiah::is_there()) {
        state.SkipWithError("no hand-made head beside the project");
        return;
    }
    for (auto _ : state) benchmark::DoNotOptimize(obadiah::played_field(subject(), fap));
    const auto agreement = obadiah::compare(subject(), fap);
    if (!agreement) {
        state.SkipWithError("no field or no point for it");
        return;
    }
    state.counters["axis"] = agreement->same_axis ? 1 : 0;
    state.counters["sign"] = agreement->same_sign ? 1 : -1;
    state.counters["cosine"] = agreement->cosine;
    state.counters["size"] = agreement->size;
    state.counters["error"] = 100 * agreement->error;
    state.counters["shape_error"] = 100 * agreement->shape_error;
}

const bool registered = [] {
    for (int fap = 3; fap <= static_cast<int>(fap_count); ++fap)
        benchmark::RegisterBenchmark(fmt::format("faps/{}_{}", fap, fap_info(fap).name).c_str(), play, fap)
            ->Unit(benchmark::kMicrosecond)
            ->Iterations(3);
    return true;
}();

}  // namespace
}  // namespace mien
