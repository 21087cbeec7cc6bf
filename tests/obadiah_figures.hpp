// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// A head that was modelled by hand for MPEG-4, with one displacement field per parameter: what a rig of its feature
// points does when a parameter is played alone, against what its maker drew. For the test and the benchmark.

#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "mien/algorithms/deform.hpp"
#include "mien/algorithms/faps.hpp"
#include "mien/algorithms/fapu.hpp"
#include "mien/algorithms/rig_biharmonic.hpp"
#include "mien/io/read.hpp"

namespace mien::obadiah {

inline std::filesystem::path head() {
    return std::filesystem::path(MIEN_SHARED) / "data/obadiah-fap/obadiah-fap-poses.glb";
}

inline std::filesystem::path points() {
    return std::filesystem::path(MIEN_SHARED) / "mpeg4/samples/greta_faces_fdp_estimated.csv";
}

inline bool is_there() {
    return std::filesystem::exists(head()) && std::filesystem::exists(points());
}

/// The points, each the vertex that its parameter moves most.
inline std::vector<FeaturePoint> read_estimated_points(const Mesh& mesh) {
    std::vector<FeaturePoint> result;
    std::ifstream file(points());
    for (std::string line; std::getline(file, line);) {
        std::istringstream cells(line);
        std::string face, id, vertex;
        std::getline(cells, face, ',');
        std::getline(cells, id, ',');
        std::getline(cells, vertex, ',');
        if (face != "obadiah" || find_point(result, id)) continue;
        const auto v = static_cast<std::uint32_t>(std::stoul(vertex));
        result.push_back({id, v, to_double(mesh.positions.at(v)), {}, 0});
    }
    return result;
}

/// The field that was drawn for a parameter, per unit of it; nothing when there is none.
inline std::optional<std::vector<Vec3>> drawn_field(const Mesh& mesh, int fap) {
    std::vector<Vec3> field(mesh.positions.size());
    bool found = false;
    const std::string name = fmt::format("FAP_{}", fap);
    for (const MorphTarget& target : mesh.morph_targets) {
        if (target.name != name && target.name != name + "_0" && target.name != name + "_1") continue;
        found = true;
        for (std::size_t i = 0; i < target.vertices.size(); ++i)
            field[target.vertices[i]] += to_double(target.deltas[i]);
    }
    return found ? std::optional(field) : std::nullopt;
}

/// How a parameter that is played compares with the one that was drawn.
struct Agreement {
    int fap = 0;
    bool same_axis = false;  ///< at the feature point the drawn motion is largest along the parameter's axis
    bool same_sign = false;  ///< and goes the same way as ours
    double cosine = 0;       ///< between the two fields, 1: equal up to their size
    double size = 0;         ///< ours over drawn, at the feature point
    double error = 0;        ///< ours less drawn over drawn, root mean square, each at its own size
    double shape_error = 0;  ///< the same with ours at the best size
};

struct Subject {
    Face face;
    Rig rig;
    Fapu fapu;
};

inline Subject read_subject() {
    Subject subject;
    subject.face.mesh = read_mesh(head());
    subject.face.points = read_estimated_points(subject.face.mesh);
    subject.rig = rig_biharmonic(subject.face);
    subject.fapu = measure_fapu(subject.face.points);
    return subject;
}

/// The field of a parameter of one unit: every other parameter is sent too, as 0.
inline std::vector<Vec3> played_field(const Subject& subject, int fap) {
    constexpr int units = 100;
    FapStream stream;
    FapFrame& frame = stream.frames.emplace_back();
    frame.mask.set();
    frame.value[fap_index(fap)] = units;
    const Take take = to_take(stream, subject.fapu);
    const TakeBinding binding = bind_take(subject.rig, take);
    std::vector<Vec3f> moves(subject.rig.points.size()), places(vertex_count(subject.rig));
    displacements(subject.rig, binding, row(take, 0), moves);
    deform(subject.rig, moves, places);
    std::vector<Vec3> field(places.size());
    for (std::size_t v = 0; v < places.size(); ++v)
        field[v] = (to_double(places[v]) - to_double(subject.rig.rest[v])) / static_cast<double>(units);
    return field;
}

inline double along(const Vec3& v, FapAxis axis) {
    return axis == FapAxis::x ? v.x : axis == FapAxis::y ? v.y : v.z;
}

inline std::optional<Agreement> compare(const Subject& subject, int number) {
    const Fap& fap = fap_info(number);
    const auto point = find_point(subject.face.points, fap.point);
    const auto drawn = drawn_field(subject.face.mesh, number);
    if (!point || !drawn) return std::nullopt;
    const std::vector<Vec3> ours = played_field(subject, number);
    double both = 0, us = 0, them = 0, apart = 0;
    for (std::size_t v = 0; v < ours.size(); ++v) {
        both += dot(ours[v], (*drawn)[v]);
        us += dot(ours[v], ours[v]);
        them += dot((*drawn)[v], (*drawn)[v]);
        apart += dot(ours[v] - (*drawn)[v], ours[v] - (*drawn)[v]);
    }
    const std::uint32_t vertex = subject.face.points[*point].vertex;
    const Vec3 here = (*drawn)[vertex];
    const double largest = std::max({std::abs(here.x), std::abs(here.y), std::abs(here.z)});
    const double main = along(here, fap.axis);
    Agreement result{number};
    result.same_axis = std::abs(main) == largest;
    result.same_sign = main * along(ours[vertex], fap.axis) > 0;
    result.cosine = both / std::sqrt(us * them);
    result.size = length(ours[vertex]) / length(here);
    result.error = std::sqrt(apart / them);
    result.shape_error = std::sqrt(std::max(0.0, 1 - result.cosine * result.cosine));
    return result;
}

}  // namespace mien::obadiah
