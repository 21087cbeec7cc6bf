// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "extract_picture.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <vector>

#include "mien/algorithms/deform.hpp"
#include "mien/algorithms/rig_biharmonic.hpp"
#include "mien/draw/sheet.hpp"

namespace mien::cli {

namespace {

// In eye distances.
constexpr float painted_from = 0.002F, painted_to = 0.05F;

FapFrame largest_of(const FapStream& stream, int fap) {
    FapFrame largest;
    largest.mask.set(fap_index(fap));
    std::int32_t& value = largest.value[fap_index(fap)];
    for (const FapFrame& frame : stream.frames)
        if (std::abs(frame.value[fap_index(fap)]) > std::abs(value)) value = frame.value[fap_index(fap)];
    return largest;
}

std::vector<float> reach_of(const Fat& fat, const Face& face, const FapFrame& frame, double eyes) {
    std::vector<Vec3f> moved(vertex_count(face.mesh));
    deform(fat, face.mesh.positions, frame, moved);
    std::vector<float> reach;
    for (std::size_t v = 0; v < moved.size(); ++v)
        reach.push_back(distance(moved[v], face.mesh.positions[v]) / static_cast<float>(eyes));
    return reach;
}

}  // namespace

Picture extract_picture(const std::string& name, const Face& face, const LearntFat& learnt, const FapStream& stream,
                        std::span<const double> error, const LookFlags& look) {
    const double eyes = eye_distance(face.points);
    ShapeStage stage(face, rig_biharmonic(face), look, size_of(look.size, {150, 180}));
    const ModelId head = stage.enter({});
    std::vector<float> off;
    for (const double e : error) off.push_back(static_cast<float>(e / eyes));
    std::vector<Picture> pictures{stage.picture(head, {}, off, painted_from, painted_to)};
    std::vector<std::string> captions{"error of the replay"};
    for (const LearntParameter& parameter : learnt.parameters) {
        if (parameter.vertices == 0) continue;
        const FapFrame frame = largest_of(stream, parameter.fap);
        pictures.push_back(stage.picture(head, {}, reach_of(learnt.fat, face, frame, eyes), painted_from, painted_to));
        captions.push_back(fmt::format("{} {}: {} at {}", parameter.fap, fap_info(parameter.fap).name,
                                       parameter.vertices, frame.value[fap_index(parameter.fap)]));
    }
    SheetOptions options;
    options.title = fmt::format("{}: what each parameter moves", name);
    options.note = "below each picture: parameter, vertices that depend on it, its largest value";
    options.legend = Legend{100 * painted_from, 100 * painted_to, "% of the eye distance"};
    return contact_sheet(pictures, captions, options);
}

}  // namespace mien::cli
