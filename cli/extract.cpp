// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <span>

#include "extract_picture.hpp"
#include "inputs.hpp"
#include "outputs.hpp"
#include "progress.hpp"

#include "mien/algorithms/bake_morphs.hpp"
#include "mien/algorithms/deform.hpp"
#include "mien/algorithms/extract_faps.hpp"
#include "mien/algorithms/fapu.hpp"
#include "mien/algorithms/learn_fat.hpp"
#include "mien/algorithms/replay_error.hpp"
#include "mien/error.hpp"
#include "mien/io/baked_size.hpp"
#include "mien/io/fap_text.hpp"
#include "mien/io/fba.hpp"
#include "mien/io/fdp_json.hpp"
#include "mien/io/fdp_text.hpp"
#include "mien/io/png.hpp"
#include "mien/io/points.hpp"
#include "mien/io/read.hpp"
#include "mien/io/write.hpp"

namespace mien::cli {

namespace {

namespace fs = std::filesystem;

struct Extract {
    fs::path animation, points, output, picture;
    SequenceOptions sequence;
    double rate = 0;
    int quant = 1;
    std::string reading = "remedied";
    LookFlags look;
};

// What was found, from step to step.
struct Found {
    UprightSequence upright;
    Face face;
    Fapu fapu;
    FapStream stream;
    EncodedFaps coded;
    LearntFat learnt;
};

constexpr double degrees = 57.29577951308232;

double turn_angle(const Quaternion& q) {
    return 2 * degrees * std::atan2(length(Vec3{q.x, q.y, q.z}), std::abs(q.w));
}

MeshSequence load_animation(const Extract& flags, Report& report) {
    SequenceOptions options = flags.sequence;
    options.rate = flags.rate;
    MeshSequence sequence = read_sequence(flags.animation, options);
    if (flags.rate > 0) sequence = at_rate(sequence, flags.rate);
    report["animation"] = {{"file", flags.animation.filename().string()},
                           {"vertices", vertex_count(sequence.mesh)},
                           {"rows", sequence.times.size()},
                           {"seconds", sequence.times.back() - sequence.times.front()}};
    return sequence;
}

std::vector<FeaturePoint> load_points(const Extract& flags, const Mesh& mesh, Report& report) {
    PointsFile file = read_points(flags.points, mesh);
    for (const std::string& warning : file.warnings) warn(report, warning);
    report["points"] = {{"file", flags.points.filename().string()}, {"count", file.points.size()}};
    return std::move(file.points);
}

// 4 x 4, row by row; it stands left of a column.
std::vector<double> as_matrix(const Pose& pose) {
    const Vec3 x = rotate(pose.rotation, {1, 0, 0}), y = rotate(pose.rotation, {0, 1, 0}),
               z = rotate(pose.rotation, {0, 0, 1}), t = pose.translation;
    return {x.x, y.x, z.x, t.x, x.y, y.y, z.y, t.y, x.z, y.z, z.z, t.z, 0, 0, 0, 1};
}

void report_head(const Found& found, const Extract& flags, Report& report) {
    const UprightSequence& upright = found.upright;
    report["head"] = {{"turned_by_degrees", turn_angle(upright.source.rotation)},
                      {"from_model_to_animation", as_matrix(upright.source)},
                      {"skull_vertices", upright.skull.size()},
                      {"skull_moves", upright.skull_motion}};
    constexpr double loose = 0.01;
    if (upright.skull_motion > loose)
        warn(report, fmt::format("the skull keeps its shape to {:.1f} % of the eye distance only; turns of the head "
                                 "are not sure",
                                 100 * upright.skull_motion));
    report["units"] = {{"irisd", found.fapu.irisd},
                       {"es", found.fapu.es},
                       {"ens", found.fapu.ens},
                       {"mns", found.fapu.mns},
                       {"mw", found.fapu.mw}};
    if (!found.fapu.estimated.empty()) report["units_estimated"] = found.fapu.estimated;
    report["reading"] = flags.reading;
}

void report_parameters(const Found& found, Report& report) {
    constexpr double unsure = 0.01;
    std::vector<std::string> mixed;
    for (const LearntParameter& p : found.learnt.parameters) {
        report["parameters"].push_back({{"fap", p.fap},
                                        {"name", fap_info(p.fap).name},
                                        {"frames", p.active},
                                        {"alone", p.alone},
                                        {"confidence", p.confidence},
                                        {"vertices", p.vertices},
                                        {"intervals", p.intervals}});
        if (p.confidence < unsure) mixed.emplace_back(fap_info(p.fap).name);
    }
    if (!mixed.empty())
        warn(report, fmt::format("{} parameters never act apart from others, so what each does alone is a guess by "
                                 "nearness: {}",
                                 mixed.size(), fmt::join(mixed, ", ")));
}

// The head's own motion is compared elsewhere: it is the same on both sides but for rounding.
FapStream without_head(FapStream stream) {
    for (FapFrame& frame : stream.frames)
        for (const int fap : {48, 49, 50}) frame.value[fap_index(fap)] = 0;
    return stream;
}

ReplayError replay(const Found& found, const FapStream& stream) {
    const MeshSequence played = deform(found.learnt.fat, found.face.mesh, without_head(stream));
    const std::vector<std::size_t> rows = rows_of_frames(found.upright.sequence, played.times);
    return replay_error(found.face, found.upright.sequence, rows, played);
}

Report as_report(const ReplayError& error) {
    return {{"mean", error.mean}, {"max", error.max}, {"error", error.error}};
}

void report_replay(const Found& found, const ReplayError& error, Report& report) {
    Report& replayed = report["replay"] = as_report(error);
    const std::vector<double> beyond = shares_by_region(found.face, found.learnt.beyond, found.learnt.motion);
    replayed["beyond_parameters"] = beyond.back();
    for (std::size_t r = 0; r < error.regions.size(); ++r) {
        const ReplayRegion& region = error.regions[r];
        replayed["regions"].push_back({{"region", region.name},
                                       {"vertices", region.vertices},
                                       {"mean", region.mean},
                                       {"max", region.max},
                                       {"error", region.error},
                                       {"beyond_parameters", beyond[r]}});
    }
    replayed["rows"] = error.rows;
    report["replay_of_bitstream"] = as_report(replay(found, found.coded.decoded));
}

std::string head_track(const Found& found) {
    std::string text = "time,x,y,z\n";
    const std::vector<Vec3> shifts = head_translations(found.upright, found.fapu);
    for (std::size_t r = 0; r < shifts.size(); ++r)
        text += fmt::format("{},{},{},{}\n", found.upright.sequence.times[r], shifts[r].x, shifts[r].y, shifts[r].z);
    return text;
}

std::vector<NamedFile> files_of(const Found& found) {
    const Fdp fdp{found.face.points, found.fapu, found.face.mesh, found.learnt.fat};
    return {{"face.fat", format_fdp_text(fdp)},
            {"face.json", format_fdp_json(fdp)},
            {"face.fap", format_fap_text(found.stream)},
            {"face.fba", found.coded.bytes},
            {"points.json", format_points(found.face.points)},
            {"head.csv", head_track(found)}};
}

void report_sizes(const Found& found, const std::vector<NamedFile>& files, Report& report) {
    const Fdp model{found.face.points, found.fapu, found.face.mesh, {}};
    const std::size_t model_size = format_fdp_text(model).size(), all = files.front().bytes.size();
    const MorphTrack track = bake_morphs(found.upright.sequence);
    const BakedSize baked = baked_size(found.upright.sequence, track);
    const double ours = static_cast<double>(all + found.coded.bytes.size());
    report["sizes"] = {{"model", model_size},
                       {"table", all - model_size},
                       {"stream", found.coded.bytes.size()},
                       {"stream_kbit_per_second", found.coded.kilobits_per_second},
                       {"baked_mdd", baked.point_cache},
                       {"baked_morph_glb", format_glb(found.upright.sequence.mesh, track).size()},
                       {"baked_meshopt", baked.morph_per_row},
                       {"few_morphs_meshopt", baked.morph_track},
                       {"ratio_to_mdd", static_cast<double>(baked.point_cache) / ours},
                       {"ratio_to_meshopt", static_cast<double>(baked.morph_per_row) / ours},
                       {"ratio_to_few_morphs_meshopt", static_cast<double>(baked.morph_track) / ours}};
}

void write_files(Call& call, const Extract& flags, const std::vector<NamedFile>& files) {
    if (call.flags.dry_run) {
        call.report["wrote"] = "nothing: this was a dry run";
        return;
    }
    WriteOptions options;
    options.overwrite = call.flags.force;
    write_folder(files, flags.output, options);
    call.report["wrote"]["folder"] = flags.output.string();
    for (const NamedFile& file : files) call.report["wrote"][file.name] = file.bytes.size();
}

void extract(Call& call, const Extract& flags) {
    check_output(flags.output, {flags.animation, flags.points, flags.sequence.head}, call.flags);
    check_output(flags.picture, {flags.animation, flags.points, flags.sequence.head}, call.flags);
    const Reading reading = flags.reading == "paper" ? Reading::paper : Reading::remedied;
    Progress progress("extracting", call.flags.quiet || call.flags.json);
    constexpr std::size_t steps = 5;
    const MeshSequence sequence = load_animation(flags, call.report);
    progress(1, steps);
    Found found;
    found.upright = upright(sequence, load_points(flags, sequence.mesh, call.report), reading);
    found.face = {found.upright.sequence.mesh, found.upright.points};
    found.fapu = measure_fapu(found.face);
    report_head(found, flags, call.report);
    progress(2, steps);
    found.stream = extract_faps(found.upright, found.fapu, {flags.rate});
    FbaOptions coding;
    coding.quant = flags.quant;
    found.coded = format_fba(found.stream, coding);
    found.learnt = learn_fat(found.upright, found.fapu, found.stream, reading);
    report_parameters(found, call.report);
    progress(3, steps);
    const ReplayError error = replay(found, found.stream);
    report_replay(found, error, call.report);
    progress(4, steps);
    const std::vector<NamedFile> files = files_of(found);
    report_sizes(found, files, call.report);
    write_files(call, flags, files);
    progress(steps, steps);
    if (flags.picture.empty() || call.flags.dry_run) return;
    WriteOptions options;
    options.overwrite = call.flags.force;
    const Picture picture = extract_picture(flags.animation.stem().string(), found.face, found.learnt, found.stream,
                                            error.vertices, flags.look);
    write_file(flags.picture, format_png(picture), options);
    call.report["picture"] = flags.picture.string();
}

}  // namespace

void add_extract(CLI::App& app, Call& call) {
    const auto flags = std::make_shared<Extract>();
    CLI::App* verb = add_verb(
        app, call, "extract",
        "Turns an animated head into MPEG-4: its points and units, its parameters over time, and how every "
        "vertex follows them.",
        "mien extract kate-talks.glb --points kate.json -o kate-mpeg4", [&call, flags] { extract(call, *flags); });
    verb->add_option("animation", flags->animation,
                     "an animated head: .glb .gltf .fbx, .mdd and .pc2 with --head, or a folder of .obj or .ply")
        ->required();
    verb->add_option("--points", flags->points, "its feature points (.json)")->required();
    verb->add_option("-o,--output", flags->output,
                     "a folder for face.fat, face.json, face.fap, face.fba, points.json, head.csv")
        ->required();
    verb->add_option("--head", flags->sequence.head, "the neutral head of an .mdd or .pc2");
    verb->add_option("--animation", flags->sequence.animation, "which one of the file, by name or number from 0");
    verb->add_option("--fps", flags->rate, "frames per second; those of the file when not given")
        ->check(CLI::PositiveNumber);
    verb->add_option("--quant", flags->quant, "the bitstream's quantiser: 0 exact, 31 coarsest")
        ->check(CLI::Range(0, 31))
        ->capture_default_str();
    verb->add_option("--reading", flags->reading,
                     "the paper's rules as written, or in the form that works on real heads")
        ->check(CLI::IsMember({"paper", "remedied"}))
        ->capture_default_str();
    verb->add_option("--picture", flags->picture,
                     "draw where the replay errs, and the vertices that depend on each parameter (.png)");
    add_picture_flags(*verb, flags->look);
}

}  // namespace mien::cli
