// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// How far a rig is from the truth: an animated head whose shapes are known gives the rig only the displacement of its
// feature points, and every other vertex is compared. The measure of docs/methods.md.

#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mien/algorithms/deform.hpp"
#include "mien/face.hpp"
#include "mien/io/gltf.hpp"
#include "mien/io/points.hpp"
#include "mien/rig.hpp"

namespace mien::figures {

struct Figures {
    double error = 0;    ///< mean over the shapes of RMS error / RMS true motion, over all vertices
    double flipped = 0;  ///< share of the moving triangles whose normal opposes the true one
};

/// A head whose shapes are known, and the named sets of its points.
struct Subject {
    Face face;
    nlohmann::json sets;
    std::size_t skin = 0;  ///< how many of its vertices, from the first, are skin: only those are compared
};

inline std::filesystem::path folder(const char* head = "ict") {
    return std::filesystem::path(MIEN_SHARED) / "data" / head;
}

inline std::string contents(const std::string& name, const char* head = "ict") {
    std::ifstream file(folder(head) / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

inline Face read_face(const std::string& head, const std::string& points) {
    const auto none_beside = [](std::string_view) { return std::vector<std::byte>(); };
    Face face{parse_gltf(std::as_bytes(std::span(head)), none_beside), {}};
    face.points = parse_points(std::as_bytes(std::span(points)), face.mesh).points;
    return face;
}

/// The head of the ICT face model with its 27 shapes.
inline Subject read_subject() {
    const std::string points = contents("feature_points.json");
    Subject subject{read_face(contents("ict_face.glb"), points), nlohmann::json::parse(points).at("_sets")};
    subject.skin = vertex_count(subject.face.mesh);
    return subject;
}

/// A head of MakeHuman with its 34 shapes, by the same sets: eye sockets and mouth are closed pockets.
inline Subject read_pocket_subject() {
    const char* folder = "mh-caucasian";
    Subject subject{read_face(contents("mh-caucasian-female.glb", folder), contents("points-glb.json", folder)),
                    nlohmann::json::parse(contents("feature_points.json")).at("_sets")};
    subject.skin = subject.face.mesh.parts.front().vertex_count;
    return subject;
}

/// The subject with only the points of a set: "all_skin" (73), "vicon27", "dutreve21".
inline Face with_set(const Subject& subject, const std::string& set) {
    return with_points(subject.face, subject.sets.at(set).get<std::vector<std::string>>());
}

inline std::vector<Vec3f> dense(const MorphTarget& shape, std::size_t vertices) {
    std::vector<Vec3f> moves(vertices);
    for (std::size_t i = 0; i < shape.vertices.size(); ++i) moves[shape.vertices[i]] = shape.deltas[i];
    return moves;
}

inline double root_mean_square(const std::vector<Vec3f>& a, const std::vector<Vec3f>& b, std::size_t count) {
    double sum = 0;
    for (std::size_t v = 0; v < count; ++v) sum += dot(to_double(a[v] - b[v]), to_double(a[v] - b[v]));
    return std::sqrt(sum / static_cast<double>(count));
}

inline Vec3 normal(const std::vector<Vec3f>& p, std::span<const std::uint32_t> corners) {
    const Vec3 a = to_double(p[corners[0]]);
    return cross(to_double(p[corners[1]]) - a, to_double(p[corners[2]]) - a);
}

/// Triangles with a vertex that moves by over 0.2 % of the eye distance, in truth or by the rig, and those of them that
/// are flipped.
struct Triangles {
    std::size_t moving = 0, flipped = 0;
};
inline void count(const Mesh& mesh, const std::vector<Vec3f>& truth, const std::vector<Vec3f>& found, double least,
                  Triangles& triangles) {
    for (std::size_t f = 0; f < face_count(mesh); ++f) {
        const auto corners = face(mesh, f);
        if (std::none_of(corners.begin(), corners.end(), [&](std::uint32_t v) {
                return distance(truth[v], mesh.positions[v]) > least || distance(found[v], mesh.positions[v]) > least;
            }))
            continue;
        ++triangles.moving;
        if (dot(normal(truth, corners), normal(found, corners)) < 0) ++triangles.flipped;
    }
}

inline Figures measure(const Rig& rig, const Subject& subject) {
    const Mesh& mesh = subject.face.mesh;
    const double least = 0.002 * eye_distance(subject.face.points);
    Figures figures;
    Triangles triangles;
    for (const MorphTarget& shape : mesh.morph_targets) {
        const std::vector<Vec3f> moves = dense(shape, mesh.positions.size());
        std::vector<Vec3f> truth(mesh.positions), found(mesh.positions.size()), points;
        for (std::size_t v = 0; v < truth.size(); ++v) truth[v] += moves[v];
        for (const FeaturePoint& point : rig.points) points.push_back(moves[point.vertex]);
        deform(rig, points, found);
        figures.error += root_mean_square(found, truth, subject.skin) /
                         root_mean_square(truth, mesh.positions, subject.skin) /
                         static_cast<double>(mesh.morph_targets.size());
        count(mesh, truth, found, least, triangles);
    }
    figures.flipped = static_cast<double>(triangles.flipped) / static_cast<double>(triangles.moving);
    return figures;
}

}  // namespace mien::figures
