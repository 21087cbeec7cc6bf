// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// A real head with ARKit shapes that plays the weights somebody's telephone recorded, with and without a head that
// nods, turns and tilts: an animated head whose every part is known. For tests and benchmarks.

#pragma once

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <memory>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "mien/io/read.hpp"
#include "mien/mesh_sequence.hpp"
#include "mien/vec.hpp"

namespace mien::arkit {

inline std::filesystem::path head_file() {
    return std::filesystem::path(MIEN_SHARED) / "data/ict/ict_face.glb";
}

inline std::filesystem::path points_file() {
    return std::filesystem::path(MIEN_SHARED) / "data/ict/feature_points.json";
}

/// A recording by its name, "jm-slate3" or "ns-slate164".
inline std::filesystem::path recording_file(const std::string& name) {
    return std::filesystem::path(MIEN_SHARED) / "data/arkit-recordings" / (name + ".csv");
}

inline bool is_there() {
    return std::filesystem::exists(head_file()) && std::filesystem::exists(recording_file("jm-slate3"));
}

/// The name of an ARKit shape in the one spelling that all others fold to: what follows the last dot, small letters,
/// and
/// "_l" or "_r" for the sides. "BlendShape.EyeBlinkLeft", "eyeBlink_L" -> "eyeblink_l".
inline std::string folded(const std::string& name) {
    std::string text = name.substr(name.rfind('.') + 1);
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    for (const auto& [side, letter] : {std::pair<std::string, std::string>{"left", "_l"}, {"right", "_r"}}) {
        if (text.size() <= side.size() || !text.ends_with(side)) continue;
        text.resize(text.size() - side.size());
        if (text.back() == '_') text.pop_back();
        return text + letter;
    }
    return text;
}

/// What a telephone recorded: one row per frame, one column per name of the header behind the timecode.
struct Recording {
    std::vector<std::string> names;  ///< folded
    std::vector<std::vector<float>> rows;
};

inline std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    return cells;
}

/// A CSV of Live Link Face; columns are told by their names.
inline Recording read_recording(const std::filesystem::path& path) {
    std::ifstream file(path);
    std::string line;
    std::getline(file, line);
    Recording recording;
    for (const std::string& cell : cells_of(line)) recording.names.push_back(folded(cell));
    while (std::getline(file, line)) {
        const std::vector<std::string> cells = cells_of(line);
        if (cells.size() != recording.names.size())
            throw std::runtime_error(path.string() + ": a row of another width");
        std::vector<float>& row = recording.rows.emplace_back();
        for (const std::string& cell : cells) row.push_back(std::strtof(cell.c_str(), nullptr));
    }
    return recording;
}

/// The column that a shape plays. Two shapes of one side each may share the column of both ("browInnerUp_L").
inline std::size_t column_of(const Recording& recording, const std::string& shape) {
    std::string name = folded(shape);
    const auto find = [&] { return std::find(recording.names.begin(), recording.names.end(), name); };
    auto at = find();
    if (at == recording.names.end() && (name.ends_with("_l") || name.ends_with("_r"))) {
        name.resize(name.size() - 2);
        at = find();
    }
    if (at == recording.names.end()) throw std::runtime_error("no column plays the shape " + shape);
    return static_cast<std::size_t>(at - recording.names.begin());
}

/// A unit quaternion that turns by `angle` radians about an axis of length 1.
inline Quaternion turn(const Vec3& axis, double angle) {
    const Vec3 v = std::sin(angle / 2) * axis;
    return {v.x, v.y, v.z, std::cos(angle / 2)};
}

/// First `a`, then `b`.
inline Quaternion then(const Quaternion& a, const Quaternion& b) {
    const Vec3 u{a.x, a.y, a.z}, v{b.x, b.y, b.z};
    const Vec3 w = a.w * v + b.w * u + cross(v, u);
    return {w.x, w.y, w.z, a.w * b.w - dot(u, v)};
}

/// The head at `time`: a nod of 15 degrees, a turn of 12 and a tilt of 8 about `neck`, each at a pace of its own, and a
/// sway of 2 % of the height `size`; upright and in place at 0.
inline Pose head_pose(double time, const Vec3& neck, double size) {
    const auto wave = [&](double hertz) { return std::sin(2 * std::numbers::pi * hertz * time); };
    const double degree = std::numbers::pi / 180;
    const Quaternion nod = turn({1, 0, 0}, 15 * degree * wave(0.31));
    const Quaternion yaw = turn({0, 1, 0}, 12 * degree * wave(0.23));
    const Quaternion tilt = turn({0, 0, 1}, 8 * degree * wave(0.17));
    const Quaternion rotation = then(then(nod, tilt), yaw);
    const Vec3 sway = 0.02 * size * Vec3{wave(0.19), 0.5 * wave(0.37), wave(0.29)};
    return {rotation, neck - rotate(rotation, neck) + sway};
}

/// The animated head, as it is and taken apart.
struct AnimatedHead {
    MorphTrack track;         ///< the shapes of the head and their weights over time
    std::vector<Pose> poses;  ///< one per row
    MeshSequence still;       ///< the shapes alone: the truth of the face
    MeshSequence moving;      ///< what is seen: each row of `still` through its pose
};

inline MeshSequence still_sequence(const Mesh& mesh, const MorphTrack& track) {
    const auto shapes = std::make_shared<const MorphTrack>(track);
    const auto rest = std::make_shared<const std::vector<Vec3f>>(mesh.positions);
    return {mesh, track.times, [shapes, rest](std::size_t row, std::span<Vec3f> positions) {
                std::copy(rest->begin(), rest->end(), positions.begin());
                for (std::size_t t = 0; t < shapes->targets.size(); ++t) {
                    const MorphTarget& target = shapes->targets[t];
                    const float weight = shapes->weights[row * shapes->targets.size() + t];
                    for (std::size_t i = 0; i < target.vertices.size(); ++i)
                        positions[target.vertices[i]] += weight * target.deltas[i];
                }
            }};
}

inline MeshSequence moving_sequence(const MeshSequence& still, const std::vector<Pose>& poses) {
    return {still.mesh, still.times, [still = still.positions, poses](std::size_t row, std::span<Vec3f> positions) {
                still(row, positions);
                for (Vec3f& p : positions) p = to_float(apply(poses[row], to_double(p)));
            }};
}

/// A head that plays a recording at 60 rows a second. `step`: every how many rows of it; `most`: rows at most, 0 for
/// all.
inline AnimatedHead animate(const Mesh& mesh, const Recording& recording, std::size_t step = 1, std::size_t most = 0) {
    constexpr double rate = 60;
    AnimatedHead head;
    head.track.targets = mesh.morph_targets;
    std::vector<std::size_t> columns;
    for (const MorphTarget& target : mesh.morph_targets) columns.push_back(column_of(recording, target.name));
    const Box box = bounding_box(mesh);
    const Vec3 size = box.high - box.low;
    const Vec3 neck{0.5 * (box.low.x + box.high.x), box.low.y + 0.36 * size.y, box.low.z + 0.35 * size.z};
    for (std::size_t row = 0; row < recording.rows.size(); row += step) {
        if (most > 0 && head.poses.size() == most) break;
        head.track.times.push_back(static_cast<double>(row) / rate);
        for (const std::size_t column : columns) head.track.weights.push_back(recording.rows[row][column]);
        head.poses.push_back(head_pose(head.track.times.back(), neck, size.y));
    }
    head.still = still_sequence(mesh, head.track);
    head.moving = moving_sequence(head.still, head.poses);
    return head;
}

/// The head of the shared data with its 27 shapes, playing a recording by name.
inline AnimatedHead animated_head(const std::string& recording = "jm-slate3", std::size_t step = 1,
                                  std::size_t most = 0) {
    return animate(read_mesh(head_file()), read_recording(recording_file(recording)), step, most);
}

}  // namespace mien::arkit
