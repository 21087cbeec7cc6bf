// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// How far rigs with example shapes are from the truth: shapes that were kept aside, and mixes of shapes that were seen.

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rig_figures.hpp"

#include "mien/algorithms/suggest_points.hpp"

namespace mien::figures {

/// "browDown" of "browDown_L": what a shape and its mirror partner share.
inline std::string family(const std::string& name) {
    for (const std::string_view side : {"_L", "_R", "Left", "Right", "_left", "_right", "-left", "-right"})
        if (name.size() > side.size() && name.ends_with(side)) return name.substr(0, name.size() - side.size());
    return name;
}

/// The figures of a rig on shapes, as `measure` gives them.
struct Sum {
    Figures figures;
    Triangles triangles;
    std::size_t count = 0;
};
inline void add(Sum& sum, const Rig& rig, const Subject& subject, const std::vector<Vec3f>& moves) {
    const Face& face = subject.face;
    const Mesh& mesh = face.mesh;
    std::vector<Vec3f> truth(mesh.positions), found(mesh.positions.size()), points;
    for (std::size_t v = 0; v < truth.size(); ++v) truth[v] += moves[v];
    for (const FeaturePoint& point : rig.points) points.push_back(moves[point.vertex]);
    deform(rig, points, found);
    sum.figures.error +=
        root_mean_square(found, truth, subject.skin) / root_mean_square(truth, mesh.positions, subject.skin);
    count(mesh, truth, found, 0.002 * eye_distance(face.points), sum.triangles);
    ++sum.count;
}
inline Figures mean(const Sum& sum) {
    return {sum.figures.error / static_cast<double>(sum.count),
            static_cast<double>(sum.triangles.flipped) / static_cast<double>(sum.triangles.moving)};
}

/// Every shape from a rig that has seen neither it nor its mirror partner. `make`: a rig from the shapes that are left.
template <class Make>
Figures leave_one_out(const Subject& subject, const Make& make) {
    const Face& face = subject.face;
    std::vector<std::string> done;
    Sum sum;
    for (const MorphTarget& shape : face.mesh.morph_targets) {
        if (std::find(done.begin(), done.end(), family(shape.name)) != done.end()) continue;
        done.push_back(family(shape.name));
        std::vector<MorphTarget> kept;
        for (const MorphTarget& other : face.mesh.morph_targets)
            if (family(other.name) != done.back()) kept.push_back(other);
        const Rig rig = make(kept);
        for (const MorphTarget& aside : face.mesh.morph_targets)
            if (family(aside.name) == done.back()) add(sum, rig, subject, dense(aside, vertex_count(face.mesh)));
    }
    return mean(sum);
}

/// Every shape of the head.
inline Figures singles(const Rig& rig, const Subject& subject) {
    const Face& face = subject.face;
    Sum sum;
    for (const MorphTarget& shape : face.mesh.morph_targets)
        if (!shape.vertices.empty()) add(sum, rig, subject, dense(shape, vertex_count(face.mesh)));
    return mean(sum);
}

/// Mixes of the head's shapes: a fifth of them at a time on average, each between 0 and 1.
inline Figures mixes(const Rig& rig, const Subject& subject, std::size_t count) {
    const Face& face = subject.face;
    std::uint32_t state = 1;
    const auto random = [&state] {
        state = 1664525U * state + 1013904223U;
        return static_cast<double>(state >> 8U) / 16777216.0;
    };
    Sum sum;
    while (sum.count < count) {
        std::vector<Vec3f> moves(vertex_count(face.mesh));
        bool any = false;
        for (const MorphTarget& shape : face.mesh.morph_targets) {
            const double share = random(), weight = random();
            if (share > 0.2) continue;
            any = any || !shape.vertices.empty();
            for (std::size_t i = 0; i < shape.vertices.size(); ++i)
                moves[shape.vertices[i]] += static_cast<float>(weight) * shape.deltas[i];
        }
        if (any) add(sum, rig, subject, moves);
    }
    return mean(sum);
}

/// The subject whose face has only the points of a set; "suggested": those of "all_skin" and the 13 that would help
/// most.
inline Subject with_points_of(const Subject& subject, const std::string& set) {
    Subject result{with_set(subject, set == "suggested" ? "all_skin" : set), {}, subject.skin};
    if (set == "suggested")
        for (const Suggestion& more : suggest_points(result.face, {13})) result.face.points.push_back(more.point);
    return result;
}

}  // namespace mien::figures
