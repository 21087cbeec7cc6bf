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

#include "mien/algorithms/carry_shapes.hpp"
#include "mien/algorithms/rig_prior.hpp"
#include "mien/io/read.hpp"

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
inline void add(Sum& sum, const Rig& rig, const Face& face, const std::vector<Vec3f>& moves) {
    const Mesh& mesh = face.mesh;
    std::vector<Vec3f> truth(mesh.positions), found(mesh.positions.size()), points;
    for (std::size_t v = 0; v < truth.size(); ++v) truth[v] += moves[v];
    for (const FeaturePoint& point : rig.points) points.push_back(moves[point.vertex]);
    deform(rig, points, found);
    sum.figures.error += root_mean_square(found, truth) / root_mean_square(truth, mesh.positions);
    count(mesh, truth, found, 0.002 * eye_distance(face.points), sum.triangles);
    ++sum.count;
}
inline Figures mean(const Sum& sum) {
    return {sum.figures.error / static_cast<double>(sum.count),
            static_cast<double>(sum.triangles.flipped) / static_cast<double>(sum.triangles.moving)};
}

/// Every shape from a rig that has seen neither it nor its mirror partner. `face`: with the points that the rig gets;
/// `make`: a rig from the shapes that are left.
template <class Make>
Figures leave_one_out(const Face& face, const Make& make) {
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
            if (family(aside.name) == done.back()) add(sum, rig, face, dense(aside, vertex_count(face.mesh)));
    }
    return mean(sum);
}

/// Every shape of the head.
inline Figures singles(const Rig& rig, const Face& face) {
    Sum sum;
    for (const MorphTarget& shape : face.mesh.morph_targets)
        if (!shape.vertices.empty()) add(sum, rig, face, dense(shape, vertex_count(face.mesh)));
    return mean(sum);
}

/// Mixes of the head's shapes: a fifth of them at a time on average, each between 0 and 1.
inline Figures mixes(const Rig& rig, const Face& face, std::size_t count) {
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
        if (any) add(sum, rig, face, moves);
    }
    return mean(sum);
}

/// The sites that METHODS suggests beside the 73 points, with their mirrors: throat, under the jaw, jaw line, neck,
/// under the chin, cheek, mid-forehead, below the jaw angle.
inline Face with_suggested_points(Face face) {
    for (const std::uint32_t v :
         {970U, 8901U, 9223U, 2462U, 221U, 9008U, 3080U, 839U, 3465U, 1247U, 1851U, 8853U, 9176U})
        face.points.push_back({"at " + std::to_string(v), v, to_double(face.mesh.positions[v]), {}, 0});
    return face;
}

/// Another head whose shapes are known: MakeHuman's, of another topology, in units of its own artist.
inline std::filesystem::path other_folder() {
    return std::filesystem::path(MIEN_SHARED) / "data" / "mh-caucasian";
}
inline Face read_other() {
    Mesh mesh = read_mesh(other_folder() / "mh-caucasian-female.glb");
    std::vector<FeaturePoint> points = read_points(other_folder() / "points-glb.json", mesh).points;
    return {std::move(mesh), std::move(points)};
}

}  // namespace mien::figures
