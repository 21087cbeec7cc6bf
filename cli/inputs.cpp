// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "inputs.hpp"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <iterator>
#include <map>
#include <string_view>

#include "mien/algorithms/carry_shapes.hpp"
#include "mien/error.hpp"
#include "mien/io/read.hpp"

namespace mien::cli {

namespace {

const std::map<std::string, Reading> readings{{"paper", Reading::paper}, {"remedied", Reading::remedied}};
const std::map<std::string, RetargetMethod> retarget_methods{
    {"local-affine", RetargetMethod::local_affine}, {"fapu", RetargetMethod::fapu}, {"rbf", RetargetMethod::rbf}};

std::vector<std::string> rigger_names() {
    std::vector<std::string> names;
    for (const Rigger& rigger : riggers()) names.emplace_back(rigger.name);
    return names;
}

std::string rigger_help() {
    std::string help = "how feature points move the skin:";
    for (const Rigger& rigger : riggers()) help += fmt::format("\n  {}: {}", rigger.name, rigger.summary);
    return help;
}

void add_reading_flag(CLI::App& verb, Reading& reading) {
    if (verb.get_option_no_throw("--reading") != nullptr) return;
    verb.add_option("--reading", reading, "the papers' rules as written, or in the form that behaves on real faces")
        ->transform(CLI::CheckedTransformer(readings).description("paper or remedied"))
        ->default_str("remedied");
}

}  // namespace

void add_face_flags(CLI::App& verb, FaceFlags& flags) {
    verb.add_option("head", flags.head, "the neutral head: .glb .gltf .fbx .obj .off .ply")->required();
    verb.add_option("--points", flags.points, "its feature points (.json)")->required();
    add_rig_flags(verb, flags);
}

void add_rig_flags(CLI::App& verb, FaceFlags& flags) {
    flags.method = riggers().front().name;
    verb.add_option("--method", flags.method, rigger_help())
        ->check(CLI::IsMember(rigger_names()))
        ->capture_default_str();
    add_reading_flag(verb, flags.rig.reading);
    verb.add_option("--examples", flags.examples,
                    "a file with shapes (morph targets) to learn from: of this very head, or of another one whose "
                    "points --examples-points has; may be given several times")
        ->allow_extra_args(false)
        ->excludes("--method");
    verb.add_option("--examples-points", flags.examples_points,
                    "the feature points (.json) of the --examples that are other heads, in their order")
        ->allow_extra_args(false)
        ->needs("--examples");
    verb.add_flag("--linear-prior", flags.linear_prior,
                  "let example shapes be taken away too, so that the rig is one linear map, for engines that cannot "
                  "solve per frame")
        ->needs("--examples");
    verb.add_option("--rig-influences", flags.rig.influences, "points kept per vertex in the rig, 0 for all")
        ->check(CLI::Range(0, 64))
        ->capture_default_str();
}

bool is_take(const std::filesystem::path& file) {
    const std::string extension = file.extension().string();
    const auto equal = [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; };
    for (const std::string_view known : {".trc", ".csv", ".c3d"})
        if (std::equal(extension.begin(), extension.end(), known.begin(), known.end(), equal)) return true;
    return false;
}

Face load_face(const FaceFlags& flags, Report& report) {
    Mesh mesh = read_mesh(flags.head);
    if (mesh.positions.empty() || face_count(mesh) == 0) throw Error(flags.head.string() + ": no mesh in this file");
    PointsFile points = read_points(flags.points, mesh);
    Report& head = report["head"];
    head["file"] = flags.head.filename().string();
    head["vertices"] = vertex_count(mesh);
    head["faces"] = face_count(mesh);
    head["feature_points"] = points.points.size();
    for (const std::string& sentence : mesh.left_out) warn(report, "left out: " + sentence);
    for (const std::string& sentence : points.warnings) warn(report, sentence);
    return {std::move(mesh), std::move(points.points)};
}

std::vector<std::filesystem::path> input_files(const FaceFlags& flags) {
    std::vector<std::filesystem::path> files{flags.head, flags.points};
    files.insert(files.end(), flags.examples.begin(), flags.examples.end());
    files.insert(files.end(), flags.examples_points.begin(), flags.examples_points.end());
    return files;
}

namespace {

void append(std::vector<MorphTarget>& shapes, std::vector<MorphTarget> more) {
    shapes.insert(shapes.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

}  // namespace

// A file whose faces are those of the head has shapes of the head itself.
Examples load_examples(const Face& whole, const FaceFlags& flags, Report& report) {
    Examples examples;
    if (flags.examples.empty()) return examples;
    Report files = Report::array();
    auto points = flags.examples_points.begin();
    for (const std::filesystem::path& file : flags.examples) {
        Face source{read_mesh(file), {}};
        if (source.mesh.morph_targets.empty())
            throw Error(file.string() + ": expected shapes to learn from, found none");
        const bool is_own = source.mesh.face_vertices == whole.mesh.face_vertices &&
                            vertex_count(source.mesh) == vertex_count(whole.mesh);
        files.push_back({{"file", file.filename().string()},
                         {"shapes", source.mesh.morph_targets.size()},
                         {"of", is_own ? "this head" : "another head, carried over"}});
        if (is_own) {
            append(examples.own, std::move(source.mesh.morph_targets));
            continue;
        }
        if (points == flags.examples_points.end())
            throw Error(file.string() + ": these shapes are of another head; expected its points by --examples-points");
        source.points = read_points(*points++, source.mesh).points;
        append(examples.carried, carry_shapes(source, source.mesh.morph_targets, whole));
    }
    if (points != flags.examples_points.end())
        throw Error(points->string() + ": expected one --examples-points for each other head, found one more");
    report["examples"] = std::move(files);
    return examples;
}

namespace {

Rig learnt_rig(const Face& face, const Examples& examples, const FaceFlags& flags, Report& report) {
    Rig rig = rig_prior(face, examples, {!flags.linear_prior, flags.rig.influences});
    report["prior"] = {{"shapes", rig.prior->shapes.size()},
                       {"left_out_because_they_move_no_skin",
                        (examples.own.empty() ? examples.carried : examples.own).size() - rig.prior->shapes.size()},
                       {"solve", is_one_sided(*rig.prior) ? "shapes are only added" : "linear"}};
    return rig;
}

}  // namespace

Rig bind_rig(const Face& face, const Examples& examples, const FaceFlags& flags, Report& report) {
    Rig rig =
        flags.examples.empty() ? make_rig(face, flags.method, flags.rig) : learnt_rig(face, examples, flags, report);
    Report& bound = report["rig"];
    bound["method"] = rig.method;
    bound["points"] = rig.points.size();
    bound["weights"] = rig.weights.size();
    bound["vertices_unreached"] = rig.unreached;
    for (const Attachment& part : rig.attachments)
        bound["attached"].push_back({{"part", part.name}, {"how", part.how}, {"vertices", part.vertices}});
    return rig;
}

void add_take_flags(CLI::App& verb, TakeFlags& flags) {
    verb.add_option("--map", flags.map,
                    "marker names to feature point ids: two-column .csv, or .json with \"markers\"");
    verb.add_option("--head", flags.head,
                    "how the head's own motion is taken out: least-squares over all head markers, three-markers "
                    "(linear, from the first paper), or keep")
        ->check(CLI::IsMember({"least-squares", "three-markers", "keep"}))
        ->capture_default_str();
    verb.add_option("--head-markers", flags.head_options.markers,
                    "columns that ride on the skull, by commas; chosen by name and motion when not given")
        ->delimiter(',');
    verb.add_option("--neutral", flags.neutral.row, "row of the take that shows the neutral face")
        ->capture_default_str();
    verb.add_option("--neutral-rows", flags.neutral.rows, "rows from there that are averaged")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    verb.add_option("--fill-gaps", flags.fill_gaps, "fill gaps of lost samples up to this many seconds (default: off)")
        ->check(CLI::PositiveNumber);
    verb.add_option("--low-pass", flags.low_pass, "smooth without delay, cut-off in Hz (default: off)")
        ->check(CLI::PositiveNumber);
}

namespace {

void report_check(const Take& take, Report& report) {
    const TakeCheck check = check_take(take);
    std::size_t lost = 0;
    for (const TakeCheck::Column& column : check.lost) lost += column.lost;
    report["lost_samples"] = lost;
    for (const TakeCheck::Column& column : check.lost)
        report["lost"].push_back(
            {{"point", column.point}, {"samples", column.lost}, {"longest_gap_in_rows", column.longest_gap}});
    for (const TakeCheck::Swap& swap : check.swaps)
        report["labels_that_seem_swapped"].push_back({{"a", swap.a}, {"b", swap.b}, {"row", swap.row}});
}

// Columns that the map does not name, or maps to nothing, keep their names: they may still serve as head markers.
Take rename_mapped(const Take& take, const std::filesystem::path& map) {
    std::vector<Rename> names = read_marker_map(map);
    for (Rename& name : names)
        if (name.to.empty()) name.to = name.from;
    for (const std::string& point : take.points)
        if (std::none_of(names.begin(), names.end(), [&](const Rename& name) { return name.from == point; }))
            names.push_back({point, point});
    return rename_points(take, names);
}

Take without_head_motion(const Take& take, const TakeFlags& flags, Report& report) {
    Report& head = report["head_motion"];
    HeadOptions options = flags.head_options;
    options.method =
        flags.head == "three-markers" ? HeadOptions::Method::three_markers : HeadOptions::Method::least_squares;
    options.reference = flags.neutral.row;
    if (flags.head == "keep") {
        head = "kept";
        return take;
    }
    if (options.markers.empty()) options.markers = head_markers(take);
    if (options.markers.empty()) {
        head = "kept: no markers that ride on the skull; name some with --head-markers";
        return take;
    }
    head["method"] = flags.head;
    head["markers"] = options.markers;
    return remove_head_motion(take, options);
}

}  // namespace

void report_missing(const Take& take, Report& report) {
    if (take.missing_rows > 0)
        warn(report, fmt::format("the take is cut: {} rows that it promises are not in the file", take.missing_rows));
}

Take load_take(const TakeFlags& flags, Report& report) {
    Take take = mark_zeros_lost(read_take(flags.take));
    Report& about = report["take"];
    about["file"] = flags.take.filename().string();
    about["rows"] = row_count(take);
    about["rows_per_second"] = frame_rate(take);
    about["columns"] = take.points.size();
    report_missing(take, report);
    const TakeCheck check = check_take(take);
    if (!check.never_seen.empty()) about["columns_never_seen"] = check.never_seen;
    take = drop_never_seen(take);
    if (!flags.map.empty()) take = rename_mapped(take, flags.map);
    report_check(take, about);
    take = without_head_motion(take, flags, about);
    if (flags.fill_gaps > 0) {
        GapReport gaps;
        take = fill_gaps(take, {flags.fill_gaps}, &gaps);
        about["gaps"] = {{"samples_filled", gaps.filled}, {"samples_left", gaps.left}};
    }
    if (flags.low_pass > 0) {
        take = low_pass(take, {flags.low_pass});
        about["low_pass_hz"] = flags.low_pass;
    }
    return take;
}

void add_retarget_flags(CLI::App& verb, RetargetOptions& options) {
    add_reading_flag(verb, options.reading);
    verb.add_option(
            "--retarget-method", options.method,
            "how motion goes from face to face: one map per point; the units of MPEG-4, for creatures; or a warp "
            "of space")
        ->transform(CLI::CheckedTransformer(retarget_methods).description("local-affine, fapu or rbf"))
        ->default_str("local-affine");
    verb.add_flag_callback(
        "--no-contact", [&options] { options.contact = false; },
        "let lids and lips go their own ways, instead of meeting where the performer's meet");
}

namespace {

std::vector<std::string> not_in(const std::vector<std::string>& names, const std::vector<std::string>& others) {
    std::vector<std::string> missing;
    std::copy_if(names.begin(), names.end(), std::back_inserter(missing), [&](const std::string& name) {
        return std::find(others.begin(), others.end(), name) == others.end();
    });
    return missing;
}

}  // namespace

Take load_onto(const Take& take, const Face& face, const RetargetOptions& options, Report& report) {
    const Retarget map = fit_retarget(take, face, options);
    Report& about = report["retarget"];
    about["method"] = map.local.empty() ? "rbf" : options.method == RetargetMethod::fapu ? "fapu" : "local-affine";
    about["pairs_in_contact"] = map.pairs.size();
    about["points_driven"] = map.points.size();
    std::vector<std::string> ids;
    for (const FeaturePoint& point : face.points) ids.push_back(point.id);
    about["points_not_driven"] = not_in(ids, map.points);
    about["columns_not_used"] = not_in(take.points, map.points);
    if (map.local.empty()) about["residual"] = map.residual;
    Take onto = retarget(map, take);
    onto.unit = face.mesh.unit;
    return onto;
}

}  // namespace mien::cli
