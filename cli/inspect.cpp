// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <memory>

#include "fap_files.hpp"
#include "inputs.hpp"
#include "verb.hpp"

#include "mien/algorithms/check_mesh.hpp"
#include "mien/algorithms/head.hpp"
#include "mien/algorithms/tracks.hpp"
#include "mien/error.hpp"
#include "mien/io/read.hpp"

namespace mien::cli {

namespace {

struct Inspect {
    std::filesystem::path file;
    std::filesystem::path points;
    FdpFlags definition;
};

Report xyz(const Vec3& v) {
    return Report::array({v.x, v.y, v.z});
}

Report oddities(const MeshCheck& check) {
    Report odd = Report::object();
    const auto count = [&](const char* what, std::size_t number) {
        if (number > 0) odd[what] = number;
    };
    count("unused_vertices", check.unused_vertices);
    count("edges_with_three_faces_or_more", check.nonmanifold_edges);
    count("edges_with_mixed_winding", check.mixed_edges);
    count("faces_without_area", check.flat_faces);
    count("repeated_faces", check.repeated_faces);
    return odd;
}

void inspect_parts(const Mesh& mesh, Report& report) {
    for (const Part& part : mesh.parts)
        report["parts"].push_back({{"name", part.name},
                                   {"mesh", part.mesh},
                                   {"primitive", part.primitive},
                                   {"vertices", part.vertex_count},
                                   {"faces", part.face_count}});
    for (const MorphTarget& target : mesh.morph_targets) report["morph_targets"].push_back(target.name);
}

void inspect_mesh(const Mesh& mesh, Report& report) {
    const MeshCheck check = check_mesh(mesh);
    const Box box = bounding_box(mesh);
    report["kind"] = "mesh";
    report["vertices"] = vertex_count(mesh);
    report["vertices_after_joining"] = check.places;
    report["faces"] = {{"triangles", check.triangles}, {"quads", check.quads}, {"larger", check.larger_faces}};
    report["islands"] = check.islands;
    report["border_edges"] = check.border_edges;
    report["unit"] = mesh.unit.empty() ? "not stated" : mesh.unit;
    report["size"] = xyz(box.high - box.low);
    report["centre"] = xyz(0.5 * (box.low + box.high));
    if (const Report odd = oddities(check); !odd.empty()) report["odd"] = odd;
    inspect_parts(mesh, report);
    for (const std::string& sentence : mesh.left_out) warn(report, "left out: " + sentence);
}

void inspect_points(const std::filesystem::path& path, const Mesh& mesh, Report& report) {
    const PointsFile file = read_points(path, mesh);
    Report& list = report["feature_points"];
    for (const FeaturePoint& point : file.points) list.push_back(point.id);
    report["eye_distance"] = eye_distance(file.points);
    for (const std::string& sentence : file.warnings) warn(report, sentence);
}

void inspect_rig(const Rig& rig, Report& report) {
    report["rig"] = {{"method", rig.method},
                     {"points", rig.points.size()},
                     {"weights", rig.weights.size()},
                     {"vertices_unreached", rig.unreached},
                     {"eyeballs", rig.eyeballs.size()}};
}

void inspect_take(const Take& take, Report& report) {
    const TakeCheck check = check_take(take);
    report["kind"] = "take";
    report_missing(take, report);
    report["rows"] = row_count(take);
    report["seconds"] = take.times.empty() ? 0.0 : take.times.back() - take.times.front();
    report["rows_per_second"] = frame_rate(take);
    report["unit"] = take.unit.empty() ? "not stated" : take.unit;
    report["dimensions"] = take.planar ? 2 : 3;
    report["points"] = take.points;
    if (const auto markers = head_markers(take); !markers.empty()) report["head_markers"] = markers;
    for (const TakeCheck::Column& column : check.lost)
        report["lost"].push_back(
            {{"point", column.point}, {"samples", column.lost}, {"longest_gap_in_rows", column.longest_gap}});
    if (!check.never_seen.empty()) report["never_seen"] = check.never_seen;
    for (const TakeCheck::Swap& swap : check.swaps)
        report["labels_that_seem_swapped"].push_back({{"a", swap.a}, {"b", swap.b}, {"row", swap.row}});
}

void inspect(Call& call, const Inspect& flags) {
    Report& report = call.report;
    report["file"] = flags.file.string();
    if (is_take(flags.file)) {
        inspect_take(mark_zeros_lost(read_take(flags.file)), report);
        return;
    }
    if (is_faps(flags.file)) {
        report["kind"] = "face animation parameters";
        load_faps(flags.file, report);
        return;
    }
    if (is_fdp(flags.file)) {
        const Fdp fdp = read_fdp(flags.file, fdp_options(flags.definition));
        if (vertex_count(fdp.mesh) > 0) inspect_mesh(fdp.mesh, report);
        report["kind"] = "face definition";
        report_fdp(fdp, report);
        return;
    }
    const Mesh mesh = read_mesh(flags.file);
    inspect_mesh(mesh, report);
    if (is_rig(mesh)) inspect_rig(read_rig(flags.file).rig, report);
    if (!flags.points.empty()) inspect_points(flags.points, mesh, report);
}

}  // namespace

void add_inspect(CLI::App& app, Call& call) {
    const auto flags = std::make_shared<Inspect>();
    CLI::App* verb =
        add_verb(app, call, "inspect", "Says what is in a mesh, take or rig file, and what is odd about it.",
                 "mien inspect kate.glb --points kate.json", [&call, flags] { inspect(call, *flags); });
    verb->add_option("file", flags->file,
                     "a mesh (.glb .gltf .obj .off .ply), take (.trc .csv .c3d), rig (.glb), animation parameters "
                     "(.fap .fba) or face definition (.fat .bt .fdp .fapu .json)")
        ->required();
    add_fdp_flags(*verb, flags->definition);
    verb->add_option("--points", flags->points, "feature points of the mesh, to be checked against it (.json)");
}

}  // namespace mien::cli
