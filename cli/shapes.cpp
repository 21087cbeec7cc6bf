// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <map>
#include <memory>

#include "inputs.hpp"
#include "interrupt.hpp"
#include "outputs.hpp"
#include "progress.hpp"
#include "shape_stage.hpp"

#include "mien/algorithms/check_shapes.hpp"
#include "mien/algorithms/make_shapes.hpp"
#include "mien/draw/sheet.hpp"
#include "mien/error.hpp"
#include "mien/io/gltf.hpp"
#include "mien/io/png.hpp"
#include "mien/io/read.hpp"
#include "mien/io/write.hpp"

namespace mien::cli {

namespace {

namespace fs = std::filesystem;

struct Shapes {
    FaceFlags face;
    fs::path output, sheet;
    std::vector<std::string> sets, gains, shown;
    ShapesOptions shapes;
    LookFlags look;
};

const std::map<std::string, ShapeSet> sets{
    {"arkit", ShapeSet::arkit}, {"visemes", ShapeSet::visemes}, {"vrm", ShapeSet::vrm}};

ShapeGain gain_of(const std::string& text) {
    const std::size_t equals = text.find('=');
    ShapeGain gain{text.substr(0, equals), 0};
    const char* const first = text.data() + std::min(equals + 1, text.size());
    const char* const last = text.data() + text.size();
    const auto [end, error] = std::from_chars(first, last, gain.gain);
    if (equals == std::string::npos || error != std::errc() || end != last)
        throw Error(fmt::format("--gain: expected SHAPE=NUMBER such as mouthSmileLeft=1.2, found {}", text));
    return gain;
}

ShapesOptions options_of(const Shapes& flags) {
    ShapesOptions options = flags.shapes;
    if (!flags.sets.empty()) options.sets.clear();
    for (const std::string& name : flags.sets) options.sets.push_back(sets.at(name));
    for (const std::string& text : flags.gains) options.gains.push_back(gain_of(text));
    return options;
}

Report openness(const std::optional<Openness>& open) {
    if (!open) return "not known";
    return {{"widest", open->most}, {"narrowest", open->least}};
}

void report_shapes(const FaceShapes& made, const ShapesCheck& check, Report& report) {
    Report& about = report["shapes"];
    about["count"] = made.shapes.size();
    about["head_is_symmetric"] = made.symmetric;
    if (!made.kept.empty()) about["kept_from_the_artist"] = made.kept;
    if (!made.unknown.empty()) about["examples_of_no_standard"] = made.unknown;
    for (const MorphTarget& shape : made.shapes)
        if (shape.vertices.empty()) about["move_nothing"].push_back(shape.name);
    about["blink_left_open"] = openness(check.blink_left);
    about["blink_right_open"] = openness(check.blink_right);
    about["jaw_open_with_mouth_close_open"] = openness(check.closed_jaw);
    if (check.upper_lip) about["upper_lip_in_jaw_open"] = *check.upper_lip;
    about["flipped_faces"] = check.flipped;
    if (check.most_flipped_share > 0)
        about["most_flipped"] = {{"shape", check.most_flipped}, {"share", check.most_flipped_share}};
    for (const std::string& note : made.notes) warn(report, note);
}

// A file's mesh gets the shapes that name one of its vertices: all of them name one of the face, so that programs find
// every name there.
std::vector<MorphTarget> all_named(std::vector<MorphTarget> shapes, std::uint32_t vertex) {
    for (MorphTarget& shape : shapes) {
        const auto at = std::lower_bound(shape.vertices.begin(), shape.vertices.end(), vertex);
        if (at != shape.vertices.end() && *at == vertex) continue;
        shape.deltas.insert(shape.deltas.begin() + (at - shape.vertices.begin()), Vec3f{});
        shape.vertices.insert(at, vertex);
    }
    return shapes;
}

// What a shape is shown with, so that it can be seen: a tongue and lips that meet need an open jaw.
std::vector<float> weights_of(const std::vector<MorphTarget>& shapes, std::size_t shown) {
    std::vector<float> weights(shapes.size());
    weights[shown] = 1;
    const float jaw = shapes[shown].name == "mouthClose" ? 1.0F : shapes[shown].name == "tongueOut" ? 0.4F : 0;
    for (std::size_t s = 0; s < shapes.size(); ++s)
        if (jaw > 0 && shapes[s].name == "jawOpen") weights[s] = jaw;
    return weights;
}

std::string caption(const std::string& shape) {
    if (shape == "mouthClose") return "mouthClose with jawOpen";
    return shape == "tongueOut" ? "tongueOut with 0.4 jawOpen" : shape;
}

void draw_sheet(Call& call, const Shapes& flags, const Face& face, const Rig& rig,
                const std::vector<MorphTarget>& shapes) {
    ShapeStage stage(face, rig, flags.look, size_of(flags.look.size, {200, 240}));
    const ModelId model = stage.enter(shapes);
    std::vector<Picture> pictures;
    std::vector<std::string> captions;
    Progress progress("drawing", call.flags.quiet || call.flags.json);
    for (std::size_t s = 0; s < shapes.size(); ++s) {
        stop_if_interrupted();
        const auto& wanted = flags.shown;
        if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), shapes[s].name) == wanted.end()) continue;
        pictures.push_back(stage.picture(model, weights_of(shapes, s)));
        captions.push_back(caption(shapes[s].name));
        progress(s + 1, shapes.size());
    }
    SheetOptions options;
    options.title = flags.face.head.stem().string();
    options.note = fmt::format("{} shapes from {} feature points", shapes.size(), rig.points.size());
    WriteOptions write;
    write.overwrite = call.flags.force;
    write_file(flags.sheet, format_png(contact_sheet(pictures, captions, options)), write);
    call.report["sheet"] = flags.sheet.string();
}

void shapes(Call& call, const Shapes& flags) {
    const std::vector<fs::path> inputs = input_files(flags.face);
    check_output(flags.output, inputs, call.flags);
    check_output(flags.sheet, inputs, call.flags);
    const Face face = load_face(flags.face, call.report);
    ShapesOptions options = options_of(flags);
    Examples examples = load_examples(face, flags.face, call.report);
    const Rig rig = bind_rig(with_points(face, shape_points(face)), examples, flags.face, call.report);
    options.examples = std::move(examples.own);
    const FaceShapes made = make_shapes(face, rig, options);
    report_shapes(made, check_shapes(face, made.shapes), call.report);
    MorphTrack track;
    track.targets = all_named(made.shapes, rig.points.front().vertex);
    write_output(call, flags.output, format_glb(face.mesh, track));
    if (flags.sheet.empty() || call.flags.dry_run) return;
    listen_for_interrupts();
    draw_sheet(call, flags, face, rig, made.shapes);
}

void add_own_flags(CLI::App& verb, Shapes& flags) {
    verb.add_option("-o,--output", flags.output, "the head with its shapes (.glb)")->required();
    verb.add_option("--sets", flags.sets, "whose shapes, by commas (default: all)")
        ->delimiter(',')
        ->check(CLI::IsMember({"arkit", "visemes", "vrm"}));
    verb.add_option("--gain", flags.gains, "SHAPE=NUMBER: make a shape stronger or weaker; may be given several times");
    verb.add_option("--retarget-method", flags.shapes.method,
                    "how motion goes from the table's face to this one: one map per point, or in the units of MPEG-4")
        ->transform(
            CLI::CheckedTransformer(std::map<std::string, RetargetMethod>{
                                        {"local-affine", RetargetMethod::local_affine}, {"fapu", RetargetMethod::fapu}})
                .description("local-affine or fapu"))
        ->default_str("local-affine");
    verb.add_option("--look-aside", flags.shapes.look_aside, "degrees that eyes turn to a side")->capture_default_str();
    verb.add_option("--look-up", flags.shapes.look_up, "degrees that eyes turn up")->capture_default_str();
    verb.add_option("--look-down", flags.shapes.look_down, "degrees that eyes turn down")->capture_default_str();
    verb.add_option("--sheet", flags.sheet, "also draw every shape on one sheet (.png)");
    verb.add_option("--show", flags.shown, "only these on the sheet, by commas")->delimiter(',');
    add_picture_flags(verb, flags.look);
}

}  // namespace

void add_shapes(CLI::App& app, Call& call) {
    const auto flags = std::make_shared<Shapes>();
    flags->face.rig.influences = 0;
    CLI::App* verb = add_verb(
        app, call, "shapes", "Gives a neutral head the shapes of ARKit, the visemes and the expressions of VRM.",
        "mien shapes kate.glb --points kate.json -o kate-with-shapes.glb --sheet kate.png\n"
        "  mien shapes kate.glb --points kate.json --examples kates-smiles.glb --gain browInnerUp=1.5 -o kate-52.glb",
        [&call, flags] { shapes(call, *flags); });
    add_face_flags(*verb, flags->face);
    add_own_flags(*verb, *flags);
}

}  // namespace mien::cli
