// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/io/points.hpp"

#include <cmath>
#include <memory>
#include <span>

#include "inputs.hpp"
#include "outputs.hpp"

#include "mien/algorithms/suggest_points.hpp"

namespace mien::cli {

namespace {

struct SuggestPoints {
    FaceFlags face;
    SuggestOptions options;
    std::filesystem::path output;
};

double rounded(double share) {
    return std::round(1000 * share) / 1000;
}

Report about(const Suggestion& suggestion) {
    const Vec3& at = suggestion.point.position;
    return {{"point", suggestion.point.id},
            {"place", suggestion.place},
            {"vertex", suggestion.point.vertex},
            {"position", {at.x, at.y, at.z}},
            {"error_before", rounded(suggestion.error_before)},
            {"error_after", rounded(suggestion.error_after)},
            {"saves", rounded(suggestion.error_before - suggestion.error_after)}};
}

void points(Call& call, const SuggestPoints& flags) {
    if (!flags.output.empty()) check_output(flags.output, {flags.face.head, flags.face.points}, call.flags);
    Face face = load_face(flags.face, call.report);
    call.report["suggested"] = Report::array();
    for (const Suggestion& suggestion : suggest_points(face, flags.options)) {
        call.report["suggested"].push_back(about(suggestion));
        face.points.push_back(suggestion.point);
    }
    if (flags.output.empty()) return;
    const std::string text = format_points(face.points);
    const auto bytes = std::as_bytes(std::span(text));
    write_output(call, flags.output, {bytes.begin(), bytes.end()});
}

}  // namespace

void add_points(CLI::App& app, Call& call) {
    const auto flags = std::make_shared<SuggestPoints>();
    CLI::App* verb = add_verb(app, call, "points",
                              "Names the feature points that a head lacks and that would help most, and places them.",
                              "mien points kate.glb --points kate.json -o kate-more.json --count 7",
                              [&call, flags] { points(call, *flags); });
    verb->add_option("head", flags->face.head, "the neutral head: .glb .gltf .fbx .obj .off .ply")->required();
    verb->add_option("--points", flags->face.points, "the feature points that it has (.json)")->required();
    verb->add_option("-o,--output", flags->output, "write these points and the suggested ones (.json)");
    verb->add_option(
            "--count", flags->options.count,
            "points to suggest at most, best first; \"saves\" is how much less of ordinary motion a rig misses")
        ->check(CLI::Range(1, 100))
        ->capture_default_str();
}

}  // namespace mien::cli
