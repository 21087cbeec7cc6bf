// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Every way to rig with every set of points, on the ICT face model (27 shapes) as triangles and as quads, and on a
// MakeHuman head whose eye sockets and mouth are closed pockets (34 shapes): how far from the truth, and how long it
// takes to bind. `error` is the mean over the shapes of RMS error / RMS motion; `flipped` is in percent of the moving
// triangles.

#include <benchmark/benchmark.h>
#include <optional>
#include <string>

#include "rig_figures.hpp"

#include "mien/algorithms/riggers.hpp"
#include "mien/algorithms/suggest_points.hpp"

namespace mien {
namespace {

struct Way {
    const char* name;
    const char* method;
    RigOptions options;
};
constexpr Way ways[] = {
    {"biharmonic, all points", "biharmonic", {Reading::remedied, 0}},
    {"biharmonic, 8 points a vertex", "biharmonic", {Reading::remedied, 8}},
    {"surface distance, paper", "surface-distance", {Reading::paper, 0}},
    {"surface distance, remedied", "surface-distance", {Reading::remedied, 0}},
    {"ellipsoid, paper", "ellipsoid", {Reading::paper, 0}},
    {"ellipsoid, remedied", "ellipsoid", {Reading::remedied, 0}},
    {"rbf, all points", "rbf", {Reading::remedied, 0}},
    {"rbf, 8 points a vertex", "rbf", {Reading::remedied, 8}},
    {"rbf along the surface, all points", "rbf-surface", {Reading::remedied, 0}},
    {"rbf along the surface, 8 points a vertex", "rbf-surface", {Reading::remedied, 8}},
};
// A head, a named set of its points, and how many suggested ones are added to it.
struct Case {
    const char* head;
    const char* set;
    std::uint32_t suggested;
};
constexpr Case cases[] = {
    {"ict", "all_skin", 0},          {"ict", "vicon27", 0},          {"ict", "dutreve21", 0},
    {"ict quads", "all_skin", 0},    {"ict quads", "vicon27", 0},    {"ict quads", "dutreve21", 0},
    {"mh-caucasian", "all_skin", 0}, {"mh-caucasian", "vicon27", 0}, {"mh-caucasian", "dutreve21", 0},
};
constexpr Case with_more[] = {
    {"ict", "all_skin", 13},          {"ict", "vicon27", 6},          {"ict", "dutreve21", 7},
    {"mh-caucasian", "all_skin", 13}, {"mh-caucasian", "vicon27", 6}, {"mh-caucasian", "dutreve21", 7},
};

const figures::Subject& subject(const Case& asked) {
    static const figures::Subject ict = figures::read_subject();
    static const figures::Subject quads = figures::read_quad_subject();
    static const figures::Subject makehuman = figures::read_pocket_subject();
    const std::string head = asked.head;
    return head == "ict" ? ict : head == "ict quads" ? quads : makehuman;
}

Face face_of(const Case& asked) {
    Face face = figures::with_set(subject(asked), asked.set);
    for (const Suggestion& s : suggest_points(face, {.count = asked.suggested})) face.points.push_back(s.point);
    return face;
}

void bind(benchmark::State& state, const Way& way, const Case& asked) {
    if (!std::filesystem::exists(figures::folder()) || !std::filesystem::exists(figures::folder("mh-caucasian"))) {
        state.SkipWithError("no such head beside the project");
        return;
    }
    const Face face = face_of(asked);
    Rig rig;
    for (auto _ : state) rig = make_rig(face, way.method, way.options);
    const figures::Figures figures = figures::measure(rig, subject(asked));
    state.counters["points"] = static_cast<double>(face.points.size());
    state.counters["error"] = figures.error;
    state.counters["flipped"] = 100 * figures.flipped;
}

void enter(const Way& way, const Case& asked) {
    std::string name = std::string("rigs/") + asked.head + "/" + asked.set;
    if (asked.suggested > 0) name += " and " + std::to_string(asked.suggested) + " suggested";
    benchmark::RegisterBenchmark((name + "/" + way.name).c_str(), bind, way, asked)->Unit(benchmark::kMillisecond);
}

const bool registered = [] {
    for (const Case& asked : cases)
        for (const Way& way : ways) enter(way, asked);
    for (const Case& asked : with_more) {
        enter(ways[0], asked);
        enter(ways[1], asked);
    }
    return true;
}();

}  // namespace
}  // namespace mien
