// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "fap_files.hpp"
#include "outputs.hpp"

#include "mien/algorithms/bake_fat.hpp"
#include "mien/algorithms/deform.hpp"
#include "mien/algorithms/fapu.hpp"
#include "mien/algorithms/play_faps.hpp"
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
    FdpFlags definition;
};

// The table that fills what the stream leaves out, if one is given.
FapInterpolation load_fit(const std::filesystem::path& file, Report& report) {
    if (file.empty()) return {};
    FapInterpolation fit = read_fit(file);
    report["fit"] = {
        {"file", file.filename().string()}, {"links", fit.links.size()}, {"parameters", interpolated_faps(fit)}};
    return fit;
}

FapStream without_head_turns(FapStream stream) {
    for (FapFrame& frame : stream.frames)
        for (const int fap : {48, 49, 50}) frame.mask.reset(fap_index(fap));
    return stream;
}

bool turns_head(const FapStream& stream) {
    return std::any_of(stream.frames.begin(), stream.frames.end(), [](const FapFrame& frame) {
        return frame.mask[fap_index(48)] || frame.mask[fap_index(49)] || frame.mask[fap_index(50)];
    });
}

// The parameters that the stream sends and no table moves anything by.
std::vector<std::string> not_in_table(const FapStream& stream, const Fat& fat) {
    FapMask sent;
    for (const FapFrame& frame : stream.frames)
        for (std::size_t i = 0; i < fap_count; ++i)
            if (frame.value[i] != 0) sent.set(i);
    for (const FaceDefTables& table : fat.tables) sent.reset(fap_index(table.fap));
    std::vector<std::string> names;
    for (std::size_t i = 0; i < fap_count; ++i)
        if (sent[i]) names.emplace_back(faps[i].name);
    return names;
}

// A face animation table says by itself what every vertex does.
void play_table(Call& call, const Play& flags) {
    const Fdp fdp = read_fdp(flags.rig, fdp_options(flags.definition));
    if (fdp.fat.tables.empty())
        throw Error(flags.rig.string() + ": expected a face definition with a table, found none");
    const FapInterpolation fit = load_fit(flags.fit, call.report);
    FapStream stream = resolve_faps(load_faps(flags.faps, call.report), fdp.fat, fit);
    call.report["table"] = {{"file", flags.rig.filename().string()},
                            {"vertices", vertex_count(fdp.mesh)},
                            {"tables", fdp.fat.tables.size()}};
    call.report["parameters_not_in_the_table"] = not_in_table(stream, fdp.fat);
    if (turns_head(stream) && !flags.output.head_motion)
        call.report["head_turns"] = "in the stream; --head-motion plays them";
    if (!flags.output.head_motion) stream = without_head_turns(std::move(stream));
    if (flags.output.output.extension() == ".glb")
        write_morphs(call, flags.output, fdp.mesh, fat_morphs(fdp.fat, fdp.mesh, stream));
    else
        write_cache(call, flags.output, deform(fdp.fat, fdp.mesh, stream));
}

std::vector<std::string> carried_points(const Face& face, const std::vector<ToldPoint>& told) {
    std::vector<std::string> carried;
    for (const FeaturePoint& point : face.points)
        if (std::none_of(told.begin(), told.end(), [&](const ToldPoint& t) { return t.id == point.id; }))
            carried.push_back(point.id);
    return carried;
}

// Points of which the stream says nothing are carried by the skin between the others.
void play(Call& call, const Play& flags) {
    check_output(flags.output.output, {flags.rig, flags.faps, flags.fit}, call.flags);
    if (is_fdp(flags.rig)) return play_table(call, flags);
    RigFile file = read_rig(flags.rig);
    const Face face{file.mesh, file.rig.points};
    const Fapu fapu = measure_fapu(face);
    const FapInterpolation fit = load_fit(flags.fit, call.report);
    const FapStream stream =
        resolve_faps(load_faps(flags.faps, call.report), standard_poses(), fit, carried_contours(fapu.points));
    const std::vector<ToldPoint> told = told_points(stream, fapu);
    if (told.empty())
        throw Error(flags.faps.string() + ": expected parameters that move a point of this rig, found none");
    const Fapu shown = flags.whole_units ? fapu : restrained(fapu);
    const Take take = play_faps(face, stream, shown);
    call.report["rig"] = {{"file", flags.rig.filename().string()}, {"points", file.rig.points.size()}};
    call.report["units"] = {
        {"irisd", fapu.irisd}, {"es", fapu.es}, {"ens", fapu.ens}, {"mns", fapu.mns}, {"mw", fapu.mw}};
    if (!fapu.estimated.empty()) call.report["units_estimated"] = fapu.estimated;
    if (shown.mns < fapu.mns)
        call.report["small_mouth"] =
            fmt::format("moves by {:.2f} of MNS; --whole-units moves it by all of it", shown.mns / fapu.mns);
    call.report["points_carried_by_the_skin"] = carried_points(face, told);
    if (!take.head.empty() && !flags.output.head_motion)
        call.report["head_turns"] = "in the stream; --head-motion plays them";
    write_performance(call, flags.output, file.mesh, file.rig, take);
}

}  // namespace

void add_play(CLI::App& app, Call& call) {
    const auto flags = std::make_shared<Play>();
    CLI::App* verb = add_verb(
        app, call, "play", "Plays face animation parameters on a rigged face, or on one with a face animation table.",
        "mien play kate-rig.glb smile.fap -o kate-smiles.glb\n  mien play kate.fat smile.fap -o kate-smiles.glb",
        [&call, flags] { play(call, *flags); });
    verb->add_option("rig", flags->rig,
                     "the rigged face (.glb written by mien rig), or its face animation table (.fat .bt .json)")
        ->required();
    verb->add_option("faps", flags->faps, "the parameters: .fap .fba")->required();
    verb->add_option("--fit", flags->fit,
                     "how parameters that are not sent follow from those that are: an interpolation table (.json)");
    verb->add_flag("--whole-units", flags->whole_units,
                   "move a small mouth by the standard's units, even where they tear it");
    add_output_flags(*verb, flags->output);
    add_fdp_flags(*verb, flags->definition);
}

}  // namespace mien::cli
