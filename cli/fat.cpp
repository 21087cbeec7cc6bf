// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "fap_files.hpp"
#include "outputs.hpp"

#include "mien/algorithms/bake_fat.hpp"
#include "mien/algorithms/fapu.hpp"
#include "mien/error.hpp"
#include "mien/io/gltf.hpp"
#include "mien/io/read.hpp"
#include "mien/io/write.hpp"

namespace mien::cli {

namespace fs = std::filesystem;

namespace {

struct MakeFat {
    fs::path input, output;
    fs::path shapes;  // empty: none
    fs::path sent;    // empty: all
    BakeFatOptions bake;
    FdpFlags definition;
};

std::string check_extension(const std::string& name) {
    const std::string extension = fs::path(name).extension().string();
    if (extension == ".glb" || is_fdp(name)) return {};
    return "expected .fat, .bt, .json, .fdp, .fapu or .glb, found " + name;
}

FapMask sent_in(const FapStream& stream) {
    FapMask sent;
    for (const FapFrame& frame : stream.frames) sent |= frame.mask;
    return sent;
}

void report_error(Report& report, const FatError& error, double eyes) {
    report["mean_error"] = error.mean;
    report["max_error"] = error.max;
    report["max_error_share_of_eye_distance"] = eyes > 0 ? error.max / eyes : 0;
}

void bend(Call& call, const MakeFat& flags, const Fapu& fapu, Fdp& fdp) {
    const Mesh shaped = read_mesh(flags.shapes);
    if (vertex_count(shaped) != vertex_count(fdp.mesh))
        throw Error(flags.shapes.string() + ": expected the vertices of " + flags.input.string() + ", found others");
    BakedFat bent = fat_of_shapes(fdp.fat, fdp.mesh, fapu, fdp.points, shaped.morph_targets);
    report_error(call.report["shapes"], bent.alone, eye_distance(fdp.points));
    fdp.fat = std::move(bent.fat);
}

Fdp of_rig(Call& call, const MakeFat& flags) {
    RigFile file = read_rig(flags.input);
    const Fapu fapu = measure_fapu(Face{file.mesh, file.rig.points});
    BakeFatOptions options = flags.bake;
    if (!flags.sent.empty()) options.sent = sent_in(load_faps(flags.sent, call.report));
    BakedFat baked = bake_fat(file.rig, file.mesh, fapu, options);
    report_error(call.report["parameters_alone"], baked.alone, eye_distance(file.rig.points));
    if (!fapu.estimated.empty()) call.report["units_estimated"] = fapu.estimated;
    Fdp fdp{file.rig.points, fapu, std::move(file.mesh), std::move(baked.fat)};
    if (!flags.shapes.empty()) bend(call, flags, fapu, fdp);
    return fdp;
}

void fat(Call& call, const MakeFat& flags) {
    check_output(flags.output, {flags.input, flags.shapes, flags.sent}, call.flags);
    const bool table = is_fdp(flags.input);
    if (table && !flags.shapes.empty()) throw Error("--shapes: expected a rig file (.glb) to bend, found a table");
    const Fdp fdp = table ? read_fdp(flags.input, fdp_options(flags.definition)) : of_rig(call, flags);
    report_fdp(fdp, call.report);
    if (flags.output.extension() == ".glb")
        return write_output(call, flags.output, format_glb(fdp.mesh, fat_morphs(fdp.fat, fdp.mesh, {})));
    WriteOptions options;
    options.overwrite = call.flags.force;
    if (!call.flags.dry_run) write(fdp, flags.output, options);
    call.report["wrote"] =
        call.flags.dry_run ? Report("nothing: this was a dry run") : Report{{"file", flags.output.string()}};
}

}  // namespace

void add_fat(CLI::App& app, Call& call) {
    const auto flags = std::make_shared<MakeFat>();
    CLI::App* verb =
        add_verb(app, call, "fat",
                 "Makes a rig a face animation table, or gives a table another form: text, JSON, or a head "
                 "with a morph target per parameter.",
                 "mien fat kate-rig.glb -o kate.fat\n  mien fat kate.fat -o kate-by-parameters.glb",
                 [&call, flags] { fat(call, *flags); });
    verb->add_option("input", flags->input,
                     "a rig file (.glb written by mien rig) or a face definition (.fat .bt .json)")
        ->required();
    verb->add_option("-o,--output", flags->output,
                     "what to write: .fat .bt .json, its points .fdp, its units .fapu, or .glb")
        ->required()
        ->check(CLI::Validator(check_extension, ""));
    verb->add_option("--shapes", flags->shapes,
                     "the same head with the shapes of ARKit (.glb), which the table is bent to give back");
    verb->add_option(
        "--sent", flags->sent,
        "parameters (.fap .fba) whose stream the table is for: points that it leaves out are carried by the skin");
    verb->add_option("--tolerance", flags->bake.tolerance,
                     "borders are put in until each parameter is met to this share of the eye distance")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    verb->add_option("--sparsity", flags->bake.sparsity,
                     "vertices that move less than this share of the farthest are left out")
        ->check(CLI::Range(0.0, 1.0))
        ->capture_default_str();
    verb->add_flag_callback(
        "--no-head", [flags] { flags->bake.head = false; }, "leave the turns of the head out");
    add_fdp_flags(*verb, flags->definition);
}

}  // namespace mien::cli
