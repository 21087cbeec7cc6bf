// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/evaluate.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <memory>

#include "evaluate_table.hpp"
#include "inputs.hpp"
#include "outputs.hpp"
#include "progress.hpp"
#include "shape_stage.hpp"

#include "mien/algorithms/key_rows.hpp"
#include "mien/draw/sheet.hpp"
#include "mien/error.hpp"
#include "mien/io/png.hpp"
#include "mien/io/write.hpp"

namespace mien::cli {

namespace {

struct Evaluate {
    FaceFlags face;
    std::vector<std::string> methods;
    std::vector<std::string> shapes, shown;
    double max_error = 0;
    std::filesystem::path picture;
    LookFlags look;
};

constexpr std::size_t rows_of_picture = 6;

const MorphTarget* find_shape(const Mesh& mesh, const std::string& name) {
    const auto found = std::find_if(mesh.morph_targets.begin(), mesh.morph_targets.end(),
                                    [&](const MorphTarget& shape) { return shape.name == name; });
    return found == mesh.morph_targets.end() ? nullptr : &*found;
}

std::string names_of(const Mesh& mesh) {
    std::vector<std::string> names;
    for (const MorphTarget& shape : mesh.morph_targets) names.push_back(shape.name);
    return fmt::format("{}", fmt::join(names, ", "));
}

void check_names(const Evaluate& flags, const Mesh& mesh) {
    for (const std::vector<std::string>* list : {&flags.shapes, &flags.shown})
        for (const std::string& name : *list)
            if (find_shape(mesh, name) == nullptr)
                throw Error(fmt::format("{}: expected a shape of the head ({}), found {}", flags.face.head.string(),
                                        names_of(mesh), name));
}

void keep_only(const std::vector<std::string>& names, Mesh& mesh) {
    if (names.empty()) return;
    std::vector<MorphTarget> kept;
    kept.reserve(names.size());
    for (const std::string& name : names) kept.push_back(*find_shape(mesh, name));
    mesh.morph_targets = std::move(kept);
}

// A method and the rule that it follows: "surface-distance:paper".
Rig rig_named(const Face& face, const std::string& name, RigOptions options) {
    constexpr std::string_view paper = ":paper";
    if (!name.ends_with(paper)) return make_rig(face, name, options);
    options.reading = Reading::paper;
    Rig rig = make_rig(face, name.substr(0, name.size() - paper.size()), options);
    rig.method = name;
    return rig;
}

std::vector<Vec3f> dense(const MorphTarget& shape, std::size_t vertices) {
    std::vector<Vec3f> moves(vertices);
    for (std::size_t i = 0; i < shape.vertices.size(); ++i) moves[shape.vertices[i]] = shape.deltas[i];
    return moves;
}

// The shape on the other side of the face, as files name it: eyeBlinkLeft and eyeBlinkRight, eyeBlink_L and eyeBlink_R.
std::string twin_of(std::string name) {
    for (const auto& [left, right] : {std::pair{"Left", "Right"}, {"_L", "_R"}, {"left", "right"}})
        for (const auto& [from, to] : {std::pair{left, right}, {right, left}})
            if (const std::size_t at = name.find(from); at != std::string::npos)
                return name.replace(at, std::string_view(from).size(), to);
    return name;
}

// The shapes that differ most from rest and from each other, of two alike the first.
std::vector<std::string> telling_shapes(const Mesh& mesh) {
    std::vector<Vec3f> rows(mesh.positions.size());
    for (const MorphTarget& shape : mesh.morph_targets) {
        const std::vector<Vec3f> moves = dense(shape, mesh.positions.size());
        rows.insert(rows.end(), moves.begin(), moves.end());
    }
    std::vector<std::string> names;
    for (const std::size_t row : key_rows(rows, mesh.positions.size(), 2 * rows_of_picture + 1)) {
        if (row == 0 || names.size() == rows_of_picture) continue;
        const std::string& name = mesh.morph_targets[row - 1].name;
        if (std::find(names.begin(), names.end(), twin_of(name)) == names.end()) names.push_back(name);
    }
    return names;
}

std::vector<float> error_of(const std::vector<Vec3f>& truth, const std::vector<Vec3f>& found, double eyes) {
    std::vector<float> error;
    for (std::size_t v = 0; v < truth.size(); ++v)
        error.push_back(distance(truth[v], found[v]) / static_cast<float>(eyes));
    return error;
}

// Errors from 2 % of the eye distance on are painted, to 12 %.
constexpr float painted_from = 0.02F, painted_to = 0.12F;

struct Column {
    const Evaluation* evaluation;
    std::vector<MorphTarget> shapes;
};

Picture draw(const Evaluate& flags, const Face& face, const std::vector<Rig>& rigs,
             const std::vector<Column>& columns) {
    const std::vector<std::string> rows = flags.shown.empty() ? telling_shapes(face.mesh) : flags.shown;
    ShapeStage stage(face, rigs.front(), flags.look, size_of(flags.look.size, {220, 260}));
    GridNames names{rows, {"truth"}, {}};
    for (const Column& column : columns) names.columns.push_back(column.evaluation->method);
    std::vector<Picture> pictures;
    for (const std::string& name : rows) {
        const MorphTarget& truth = *find_shape(face.mesh, name);
        const std::vector<Vec3f> moves = dense(truth, face.mesh.positions.size());
        const std::array full{1.0F};
        pictures.push_back(stage.picture(stage.enter(std::span(&truth, 1)), full));
        names.cells.emplace_back();
        const auto s = static_cast<std::size_t>(&truth - face.mesh.morph_targets.data());
        for (const Column& column : columns) {
            const MorphTarget& made = column.shapes[s];
            const std::vector<float> error =
                error_of(moves, dense(made, face.mesh.positions.size()), eye_distance(face.points));
            pictures.push_back(stage.picture(stage.enter(std::span(&made, 1)), full, error, painted_from, painted_to));
            const auto& figures = column.evaluation->shapes;
            const auto found = std::find_if(figures.begin(), figures.end(),
                                            [&](const ShapeFigures& shape) { return shape.shape == name; });
            names.cells.push_back(found == figures.end() ? "" : fmt::format("error {:.2f}", found->error));
        }
    }
    SheetOptions options;
    options.title =
        fmt::format("{}: {} feature points drive the whole face", flags.face.head.stem().string(), face.points.size());
    options.legend = Legend{100 * painted_from, 100 * painted_to, "% of the eye distance from the truth"};
    return grid(pictures, names, options);
}

void gate(Call& call, const Evaluate& flags, const std::vector<Evaluation>& evaluations) {
    if (!(flags.max_error > 0)) return;
    for (const Evaluation& evaluation : evaluations)
        if (evaluation.error > flags.max_error)
            call.gate = fmt::format("the mean error of {} is {:.3f}, --max-error allows {:.3f}", evaluation.method,
                                    evaluation.error, flags.max_error);
}

void evaluate(Call& call, const Evaluate& flags) {
    check_output(flags.picture, {flags.face.head, flags.face.points}, call.flags);
    Face face = load_face(flags.face, call.report);
    if (face.mesh.morph_targets.empty())
        throw Error(flags.face.head.string() +
                    ": expected a head with shapes (morph targets) to compare with, found none");
    check_names(flags, face.mesh);
    keep_only(flags.shapes, face.mesh);
    std::vector<Rig> rigs;
    std::vector<Evaluation> evaluations;
    Progress progress("evaluating", call.flags.quiet || call.flags.json);
    for (const std::string& method : flags.methods) {
        rigs.push_back(rig_named(face, method, flags.face.rig));
        evaluations.push_back(mien::evaluate(face, rigs.back()));
        call.report["methods"].push_back(as_report(evaluations.back()));
        progress(evaluations.size(), flags.methods.size());
    }
    call.text = fmt::format("{}: {} shapes, {} feature points\n", flags.face.head.filename().string(),
                            evaluations.front().shapes.size(), face.points.size()) +
                as_table(evaluations, call.flags.verbose);
    gate(call, flags, evaluations);
    if (flags.picture.empty() || call.flags.dry_run) return;
    std::vector<Column> columns;
    for (std::size_t m = 0; m < rigs.size(); ++m) columns.push_back({&evaluations[m], reproduce_shapes(face, rigs[m])});
    WriteOptions options;
    options.overwrite = call.flags.force;
    write_file(flags.picture, format_png(draw(flags, face, rigs, columns)), options);
    call.report["picture"] = flags.picture.string();
}

std::vector<std::string> method_names() {
    std::vector<std::string> names;
    for (const Rigger& rigger : riggers()) {
        names.emplace_back(rigger.name);
        names.push_back(std::string(rigger.name) + ":paper");
    }
    return names;
}

}  // namespace

void add_evaluate(CLI::App& app, Call& call) {
    const auto flags = std::make_shared<Evaluate>();
    flags->methods = {std::string(riggers().front().name)};
    CLI::App* verb =
        add_verb(app, call, "evaluate", "Tells how well feature points reproduce the shapes that a head has.",
                 "mien evaluate kate-with-shapes.glb --points kate.json --method biharmonic \\\n"
                 "      --method surface-distance:paper --picture kate.png --max-error 0.4",
                 [&call, flags] { evaluate(call, *flags); });
    verb->add_option("head", flags->face.head, "a head with shapes (morph targets): .glb .gltf")->required();
    verb->add_option("--points", flags->face.points, "its feature points (.json)")->required();
    verb->add_option("--method", flags->methods,
                     "how feature points move the skin; may be given several times. With :paper behind it, by its "
                     "paper's rule as written")
        ->check(CLI::IsMember(method_names()))
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->default_str(flags->methods.front());
    verb->add_option("--rig-influences", flags->face.rig.influences, "points kept per vertex in the rig, 0 for all")
        ->check(CLI::Range(0, 64))
        ->capture_default_str();
    verb->add_option("--shapes", flags->shapes, "measure only these, by commas")->delimiter(',');
    verb->add_option("--max-error", flags->max_error, "exit with 4 when the mean error of a method is larger")
        ->check(CLI::PositiveNumber);
    verb->add_option("--picture", flags->picture, "draw shapes by methods, the error in colour (.png)");
    verb->add_option("--show", flags->shown, "the picture's shapes, by commas; those that differ most when not given")
        ->delimiter(',');
    add_picture_flags(*verb, flags->look);
}

}  // namespace mien::cli
