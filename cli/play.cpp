// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <string>
#include <vector>

#include "fap_files.hpp"
#include "outputs.hpp"

#include "mien/algorithms/complete.hpp"
#include "mien/algorithms/faps.hpp"
#include "mien/algorithms/fapu.hpp"
#include "mien/algorithms/resolve_faps.hpp"
#include "mien/error.hpp"
#include "mien/io/read.hpp"

namespace mien::cli {

namespace {

struct Play {
    std::filesystem::path rig;
    std::filesystem::path faps;
    std::filesystem::path fit;  // empty: none
    bool whole_units = false;
    OutputFlags output;
};

// The table that fills what the stream leaves out, if one is given.
FapInterpolation load_fit(const std::filesystem::path& file, Report& report) {
    if (file.empty()) return {};
    FapInterpolation fit = read_fit(file);
    report["fit"] = {
        {"file", file.filename().string()}, {"links", fit.links.size()}, {"parameters", interpolated_faps(fit)}};
    return fit;
}

Take told(const Take& take, const std::vector<std::string>& points) {
    std::vector<Rename> names;
    names.reserve(points.size());
    for (const std::string& point : points) names.push_back({point, point});
    return rename_points(take, names);
}

// Points of which the stream says nothing are carried by the skin between the others.
void play(Call& call, const Play& flags) {
    check_output(flags.output.output, {flags.rig, flags.faps, flags.fit}, call.flags);
    RigFile file = read_rig(flags.rig);
    const Face face{file.mesh, file.rig.points};
    const Fapu fapu = measure_fapu(face);
    const FapInterpolation fit = load_fit(flags.fit, call.report);
    const FapStream stream = resolve_faps(load_faps(flags.faps, call.report), standard_poses(), fit);
    const std::vector<std::string> points = told_points(stream, fapu);
    if (points.empty())
        throw Error(flags.faps.string() + ": expected parameters that move a point of this rig, found none");
    const Fapu shown = flags.whole_units ? fapu : restrained(fapu);
    const Take take = told(to_take(stream, shown), points);
    call.report["rig"] = {{"file", flags.rig.filename().string()}, {"points", file.rig.points.size()}};
    call.report["units"] = {
        {"irisd", fapu.irisd}, {"es", fapu.es}, {"ens", fapu.ens}, {"mns", fapu.mns}, {"mw", fapu.mw}};
    if (!fapu.estimated.empty()) call.report["units_estimated"] = fapu.estimated;
    if (shown.mns < fapu.mns)
        call.report["small_mouth"] =
            fmt::format("moves by {:.2f} of MNS; --whole-units moves it by all of it", shown.mns / fapu.mns);
    call.report["points_carried_by_the_skin"] = missing_points(face, take);
    if (!take.head.empty() && !flags.output.head_motion)
        call.report["head_turns"] = "in the stream; --head-motion plays them";
    write_performance(call, flags.output, file.mesh, file.rig, complete(face, take));
}

}  // namespace

void add_play(CLI::App& app, Call& call) {
    const auto flags = std::make_shared<Play>();
    CLI::App* verb =
        add_verb(app, call, "play", "Plays face animation parameters on a rigged face, in the face's own MPEG-4 units.",
                 "mien play kate-rig.glb smile.fap -o kate-smiles.glb", [&call, flags] { play(call, *flags); });
    verb->add_option("rig", flags->rig, "the rigged face (.glb written by mien rig)")->required();
    verb->add_option("faps", flags->faps, "the parameters: .fap .fba")->required();
    verb->add_option("--fit", flags->fit,
                     "how parameters that are not sent follow from those that are: an interpolation table (.json)");
    verb->add_flag("--whole-units", flags->whole_units,
                   "move a small mouth by the standard's units, even where they tear it");
    add_output_flags(*verb, flags->output);
}

}  // namespace mien::cli
