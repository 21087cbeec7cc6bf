// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "outputs.hpp"

#include <fmt/format.h>

#include "progress.hpp"

#include "mien/algorithms/deform.hpp"
#include "mien/error.hpp"
#include "mien/io/gltf.hpp"
#include "mien/io/write.hpp"

namespace mien::cli {

namespace fs = std::filesystem;

namespace {

std::string check_extension(const std::string& name) {
    const std::string extension = fs::path(name).extension().string();
    if (extension.empty() || extension == ".glb" || extension == ".mdd" || extension == ".pc2") return {};
    return "expected .glb, .mdd, .pc2, or a folder name without extension for .obj files, found " + name;
}

double height(const Mesh& mesh) {
    const Box box = bounding_box(mesh);
    return box.high.y - box.low.y;
}

void check_gate(const OutputFlags& flags, double error, double height) {
    if (flags.max_error > 0 && error > flags.max_error * height)
        throw GateError(fmt::format(
            "the written form differs by {:.3g} of the head's height at most, --max-error allows {:.3g}; nothing was "
            "written. Try --influences 8, or more --morphs",
            error / height, flags.max_error));
}

void report_error(Report& about, double mean, double max, double height) {
    about["mean_error"] = mean;
    about["max_error"] = max;
    about["max_error_share_of_height"] = height > 0 ? max / height : 0;
}

}  // namespace

void add_skin_flags(CLI::App& verb, OutputFlags& flags) {
    verb.add_option("--influences", flags.skin.influences, "joints per vertex in a .glb: 4 for every viewer, or 8")
        ->check(CLI::IsMember({4, 8, 12, 16}))
        ->capture_default_str();
    verb.add_option("--max-error", flags.max_error,
                    "write nothing and exit with 4 when the .glb differs from the exact rig by more than this share of "
                    "the head's height")
        ->check(CLI::PositiveNumber);
}

void add_output_flags(CLI::App& verb, OutputFlags& flags) {
    verb.add_option("-o,--output", flags.output, "what to write: .glb, .mdd, .pc2, or a folder for .obj files")
        ->required()
        ->check(CLI::Validator(check_extension, ""));
    verb.add_option("--bake", flags.bake, "how a .glb moves: joints, or morphs")
        ->check(CLI::IsMember({"joints", "morphs"}))
        ->capture_default_str();
    add_skin_flags(verb, flags);
    verb.add_option("--morphs", flags.morphs.morphs, "most morph targets written with --bake morphs")
        ->check(CLI::Range(1, 240))
        ->capture_default_str();
    verb.add_option("--tolerance", flags.morphs.tolerance,
                    "fewer morph targets do when the mean error is under this share of the largest motion")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    verb.add_flag("--head-motion", flags.head_motion, "play the take's head motion too (joints in a .glb)");
}

void check_output(const fs::path& output, const std::vector<fs::path>& inputs, const Common& flags) {
    if (output.empty()) return;
    std::error_code ignored;
    for (const fs::path& input : inputs)
        if (!input.empty() && fs::equivalent(input, output, ignored))
            throw Error(output.string() + ": the output is one of the inputs; choose another name");
    if (!flags.force && fs::exists(output, ignored))
        throw Error(output.string() + ": is there already; -f overwrites it", Error::Kind::access);
}

Skin skin_for(Call& call, const OutputFlags& flags, const Mesh& mesh, const Rig& rig, const Take& take) {
    Skin skin = make_skin(rig, take, flags.skin);
    Report& about = call.report["influence_cut"];
    about["joints_per_vertex"] = skin.influences;
    report_error(about, skin.mean_error, skin.max_error, height(mesh));
    check_gate(flags, skin.max_error, height(mesh));
    return skin;
}

void write_output(Call& call, const fs::path& output, const std::vector<std::byte>& bytes) {
    WriteOptions options;
    options.overwrite = call.flags.force;
    if (!call.flags.dry_run) write_file(output, bytes, options);
    call.report["wrote"] = {{"file", output.string()}, {"bytes", bytes.size()}};
    if (call.flags.dry_run) call.report["wrote"] = "nothing: this was a dry run";
}

namespace {

void write_joints(Call& call, const OutputFlags& flags, const Mesh& mesh, const Rig& rig, const Take& take) {
    const Skin skin = skin_for(call, flags, mesh, rig, take);
    GltfOptions options;
    options.head_motion = flags.head_motion;
    write_output(call, flags.output, format_glb(mesh, rig, skin, take, options));
}

}  // namespace

void write_morphs(Call& call, const OutputFlags& flags, const Mesh& mesh, const MorphTrack& track) {
    Report& about = call.report["morph_bake"];
    about["morph_targets"] = track.targets.size();
    report_error(about, track.mean_error, track.max_error, height(mesh));
    check_gate(flags, track.max_error, height(mesh));
    write_output(call, flags.output, format_glb(mesh, track));
}

void write_cache(Call& call, const OutputFlags& flags, const MeshSequence& sequence) {
    Progress progress("writing " + flags.output.filename().string(), call.flags.quiet);
    WriteOptions options;
    options.overwrite = call.flags.force;
    options.progress = [&](std::size_t done, std::size_t all) { progress(done, all); };
    if (call.flags.dry_run) {
        call.report["wrote"] = "nothing: this was a dry run";
        return;
    }
    write(sequence, flags.output, options);
    call.report["wrote"] = {
        {"file", flags.output.string()}, {"rows", sequence.times.size()}, {"vertices", vertex_count(sequence.mesh)}};
}

void write_performance(Call& call, const OutputFlags& flags, const Mesh& mesh, const Rig& rig, const Take& take) {
    const bool glb = flags.output.extension() == ".glb";
    if (flags.head_motion && !(glb && flags.bake == "joints"))
        warn(call.report, "--head-motion plays in a .glb with joints only; it was left out");
    if (glb && flags.bake == "joints")
        write_joints(call, flags, mesh, rig, take);
    else if (glb)
        write_morphs(call, flags, mesh, bake_morphs(deform(rig, mesh, take), flags.morphs));
    else
        write_cache(call, flags, deform(rig, mesh, take));
}

}  // namespace mien::cli
