// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/faps.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>

#include "fap_files.hpp"
#include "inputs.hpp"
#include "outputs.hpp"

#include "mien/algorithms/fapu.hpp"
#include "mien/algorithms/upright.hpp"
#include "mien/error.hpp"

namespace mien::cli {

namespace {

struct MakeFaps {
    TakeFlags take;
    ToFapsOptions options;
    FapOutput output;
};

// Axes of the face for those of the capture, whose camera or laboratory had its own.
Take turned_upright(const Take& take, const NeutralOptions& neutral, Report& report) {
    const auto turn = face_turn(take, neutral);
    if (!turn) {
        warn(report, "too few MPEG-4 points tell how the face is held: it is taken to look along +z, +y up");
        return take;
    }
    const double half = std::acos(std::min(1.0, std::abs(turn->w)));
    report["turned_upright_by_degrees"] = 360 / std::numbers::pi * half;
    return upright(take, *turn);
}

Fapu performer_units(const Take& take, const NeutralOptions& options, Report& report) {
    Fapu fapu = measure_fapu(neutral_points(take, options));
    report["units"] = {{"irisd", fapu.irisd}, {"es", fapu.es}, {"ens", fapu.ens}, {"mns", fapu.mns}, {"mw", fapu.mw}};
    if (!fapu.estimated.empty()) report["units_estimated"] = fapu.estimated;
    return fapu;
}

void faps(Call& call, const MakeFaps& flags) {
    check_output(flags.output.output, {flags.take.take, flags.take.map}, call.flags);
    Take take = load_take(flags.take, call.report);
    if (take.planar) throw Error(flags.take.take.string() + ": expected points in space, found those of a picture");
    take = turned_upright(take, flags.take.neutral, call.report);
    const Fapu fapu = performer_units(take, flags.take.neutral, call.report);
    FapStream stream = to_faps(take, fapu, flags.options);
    stream.name = flags.take.take.stem().string();
    FapMask sent;
    for (const FapFrame& frame : stream.frames) sent |= frame.mask;
    if (sent.none())
        throw Error(
            flags.take.take.string() +
            ": expected columns that are MPEG-4 points which parameters move, found none; name them with --map");
    call.report["faps"] = {
        {"frames", stream.frames.size()}, {"frames_per_second", stream.rate}, {"parameters", sent.count()}};
    write_faps(call, flags.output, stream);
}

}  // namespace

void add_faps(CLI::App& app, Call& call) {
    const auto flags = std::make_shared<MakeFaps>();
    CLI::App* verb = add_verb(
        app, call, "faps", "Turns captured markers into face animation parameters, in the performer's own units.",
        "mien faps smile.trc --points markers.csv --rate 25 -o smile.fap", [&call, flags] { faps(call, *flags); });
    verb->add_option("take", flags->take.take, "the capture: .trc .csv .c3d")->required();
    verb->add_option(
        "--points", flags->take.map,
        "which feature point each marker is: two-column .csv, or .json with \"markers\"; the same as --map");
    add_take_flags(*verb, flags->take);
    verb->add_option("--rate", flags->options.rate, "frames per second of the parameters; 0: those of the take")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    add_fap_output_flags(*verb, flags->output);
}

}  // namespace mien::cli
