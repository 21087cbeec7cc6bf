// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/replay_error.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

#include "algorithms/face_regions.hpp"

#include "mien/error.hpp"

namespace mien {

namespace {

struct Sums {
    std::size_t vertices = 0;
    double distance = 0, squares = 0, motion = 0, max = 0;
};

double share(double part, double whole) {
    if (whole > 0) return std::sqrt(part / whole);
    return part > 0 ? std::numeric_limits<double>::infinity() : 0;
}

ReplayRegion figures(std::string_view name, const Sums& sums, std::size_t rows, double eyes) {
    const auto count = static_cast<double>(std::max<std::size_t>(sums.vertices * rows, 1));
    return {std::string(name), sums.vertices, sums.distance / count / eyes, sums.max / eyes,
            share(sums.squares, sums.motion)};
}

std::vector<std::size_t> regions_of(const Face& face) {
    const Weld welded = weld(face.mesh);
    return vertex_regions(face, welded, edge_graph(face.mesh, welded));
}

void check(const Face& face, const MeshSequence& truth, std::span<const std::size_t> rows, const MeshSequence& replay) {
    const std::size_t vertices = vertex_count(face.mesh);
    if (rows.empty()) throw Error("replay: expected rows to compare, found none");
    if (rows.size() != replay.times.size())
        throw Error(fmt::format("replay: expected {} rows, found {}", rows.size(), replay.times.size()));
    for (const MeshSequence* sequence : {&truth, &replay})
        if (vertex_count(sequence->mesh) != vertices)
            throw Error(fmt::format("replay: expected {} vertices, found {}", vertices, vertex_count(sequence->mesh)));
    if (!(eye_distance(face.points) > 0)) throw Error("replay: expected points that tell how large the face is");
}

}  // namespace

ReplayError replay_error(const Face& face, const MeshSequence& truth, std::span<const std::size_t> rows,
                         const MeshSequence& replay) {
    check(face, truth, rows, replay);
    const double eyes = eye_distance(face.points);
    const std::vector<std::size_t> region = regions_of(face);
    const std::size_t vertices = region.size();
    std::vector<Sums> sums(region_names.size() + 1);  // all of them last
    Sums& all = sums.back();
    for (const std::size_t r : region) ++sums[r].vertices;
    all.vertices = vertices;
    ReplayError result;
    result.vertices.assign(vertices, 0);
    std::vector<Vec3f> is(vertices), was(vertices);
    for (std::size_t r = 0; r < rows.size(); ++r) {
        truth.positions(rows[r], was);
        replay.positions(r, is);
        double row = 0;
        for (std::size_t v = 0; v < vertices; ++v) {
            const double off = distance(to_double(is[v]), to_double(was[v]));
            const double moved = distance(to_double(was[v]), to_double(face.mesh.positions[v]));
            row += off;
            result.vertices[v] += off * off / static_cast<double>(rows.size());
            for (Sums* s : {&sums[region[v]], &all}) {
                s->distance += off;
                s->squares += off * off;
                s->motion += moved * moved;
                s->max = std::max(s->max, off);
            }
        }
        result.rows.push_back(row / static_cast<double>(std::max<std::size_t>(vertices, 1)) / eyes);
    }
    for (double& v : result.vertices) v = std::sqrt(v);
    for (std::size_t r = 0; r < region_names.size(); ++r)
        if (sums[r].vertices > 0) result.regions.push_back(figures(region_names[r], sums[r], rows.size(), eyes));
    const ReplayRegion whole = figures("", all, rows.size(), eyes);
    result.mean = whole.mean;
    result.max = whole.max;
    result.error = whole.error;
    return result;
}

std::vector<double> shares_by_region(const Face& face, std::span<const double> part, std::span<const double> whole) {
    const std::vector<std::size_t> region = regions_of(face);
    std::vector<Sums> sums(region_names.size() + 1);
    for (std::size_t v = 0; v < region.size(); ++v)
        for (Sums* s : {&sums[region[v]], &sums.back()}) {
            ++s->vertices;
            s->squares += part[v] * part[v];
            s->motion += whole[v] * whole[v];
        }
    std::vector<double> shares;
    for (const Sums& s : sums)
        if (s.vertices > 0 || &s == &sums.back()) shares.push_back(share(s.squares, s.motion));
    return shares;
}

std::vector<std::size_t> rows_of_frames(const MeshSequence& sequence, std::span<const double> times) {
    if (sequence.times.empty()) throw Error("animated head: expected rows, found none");
    const std::vector<double>& at = sequence.times;
    const double step = at.size() > 1 ? (at.back() - at.front()) / static_cast<double>(at.size() - 1) : 1;
    std::vector<std::size_t> rows;
    for (const double asked : times) {
        const double time = at.front() + asked;
        if (time > at.back() + 0.5 * step) break;
        const auto after = std::lower_bound(at.begin(), at.end(), time);
        const bool earlier = after == at.end() || (after != at.begin() && time - *(after - 1) <= *after - time);
        rows.push_back(static_cast<std::size_t>(after - at.begin()) - (earlier ? 1 : 0));
    }
    return rows;
}

}  // namespace mien
