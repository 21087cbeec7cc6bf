// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/morph.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "inputs.hpp"
#include "outputs.hpp"

#include "mien/error.hpp"
#include "mien/io/gltf.hpp"
#include "mien/io/read.hpp"

namespace mien::cli {

namespace fs = std::filesystem;

namespace {

struct Morph {
    FaceFlags face;
    std::vector<fs::path> to;
    fs::path to_head;
    OutputFlags output;
};

std::vector<MeasuredPoint> points_of_head(const fs::path& head, const fs::path& points) {
    std::vector<MeasuredPoint> measured;
    for (const FeaturePoint& point : read_face(head, points).points) measured.push_back({point.id, point.position});
    return measured;
}

std::vector<MeasuredPoint> load_measured(const Morph& flags) {
    std::vector<std::vector<MeasuredPoint>> pictures;
    for (const fs::path& file : flags.to)
        pictures.push_back(flags.to_head.empty() ? read_measured_points(file) : points_of_head(flags.to_head, file));
    return merged(pictures);
}

// The head with its rig: the file's own, or one that is bound to all of its points.
RigFile load_rigged(const FaceFlags& flags, Report& report) {
    if (flags.points.empty()) return read_rig(flags.head);
    Face face = load_face(flags, report);
    Rig rig = bind_rig(face, load_examples(face, flags, report), flags, report);
    return {std::move(face.mesh), std::move(rig)};
}

struct Shared {
    std::vector<std::string> ids, carried, unused;
};

Shared shared_points(const Rig& rig, const std::vector<MeasuredPoint>& measured) {
    Shared shared;
    for (const MeasuredPoint& point : measured)
        (find_point(rig.points, point.id) ? shared.ids : shared.unused).push_back(point.id);
    for (const FeaturePoint& point : rig.points)
        if (std::find(shared.ids.begin(), shared.ids.end(), point.id) == shared.ids.end())
            shared.carried.push_back(point.id);
    return shared;
}

void morph(Call& call, const Morph& flags) {
    std::vector<fs::path> inputs = flags.to;
    inputs.insert(inputs.end(), {flags.face.head, flags.face.points, flags.to_head});
    check_output(flags.output.output, inputs, call.flags);
    RigFile file = load_rigged(flags.face, call.report);
    const std::vector<MeasuredPoint> measured = load_measured(flags);
    const Shared shared = shared_points(file.rig, measured);
    if (shared.ids.empty()) throw Error("--to: expected points that the head has, found none");
    RigOptions every_influence = flags.face.rig;
    every_influence.influences = 0;
    const Face driven = with_points({file.mesh, file.rig.points}, shared.ids);
    file.mesh.positions = mien::morph(make_rig(driven, flags.face.method, every_influence), measured);
    const Rig rig = carried_over(file.rig, file.mesh.positions);
    call.report["morph"] = {{"points_met", shared.ids.size()},
                            {"points_carried_by_the_skin", shared.carried},
                            {"measured_points_not_used", shared.unused}};
    const Skin skin = skin_for(call, flags.output, file.mesh, rig, Take{});
    write_output(call, flags.output.output, format_rig(file.mesh, rig, skin));
}

}  // namespace

void add_morph(CLI::App& app, Call& call) {
    const auto flags = std::make_shared<Morph>();
    CLI::App* verb = add_verb(app, call, "morph",
                              "Reshapes a head to the feature points of somebody else; its rig and texture stay.",
                              "mien morph generic.glb --points generic.json --to kate-front.json --to kate-side.json "
                              "-o kate-rig.glb",
                              [&call, flags] { morph(call, *flags); });
    verb->add_option("head", flags->face.head, "a neutral head (.glb .gltf .fbx .obj .off .ply) or a rig file (.glb)")
        ->required();
    verb->add_option("--points", flags->face.points, "its feature points (.json); not given: head is a rig file");
    verb->add_option(
            "--to", flags->to,
            "where the points are on the other face (.json): id -> [x, y, z], null for what a picture does not "
            "show; several files are merged. +x to the face's left, +y up, +z out of it")
        ->required()
        ->allow_extra_args(false);
    verb->add_option("--to-head", flags->to_head, "the head that --to names vertices of");
    add_rig_flags(*verb, flags->face);
    verb->add_option("-o,--output", flags->output.output, "the rig file to write (.glb)")->required();
    add_skin_flags(*verb, flags->output);
}

}  // namespace mien::cli
