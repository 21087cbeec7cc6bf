// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// An animated head in millimetres of which all is known: a dome of 41 x 67 vertices with two eyeballs behind it, moved
// by round fields, one per parameter, none of which reaches the point of another; eyes that turn; a head that moves.

#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/fap_face.hpp"
#include "shapes.hpp"

#include "mien/algorithms/extract_faps.hpp"
#include "mien/algorithms/fapu.hpp"
#include "mien/fap.hpp"
#include "mien/mesh_sequence.hpp"

namespace mien::animated {

constexpr std::uint32_t columns = 40, rows = 66;
constexpr double step = 4, eye_x = 32, eye_radius = 11;

inline std::uint32_t vertex_at(double x, double y) {
    const auto i = static_cast<std::uint32_t>(std::lround((x + 80) / step));
    const auto j = static_cast<std::uint32_t>(std::lround((y + 140) / step));
    return j * (columns + 1) + i;
}

/// The neutral head. Its eyes are 64 apart; pupils have no points.
inline Face head() {
    Face face{shapes::grid(columns, rows, static_cast<float>(step)), {}};
    for (Vec3f& p : face.mesh.positions) {
        p -= {80, 140, 0};
        p.z = -0.004F * (p.x * p.x + 0.3F * p.y * p.y);
    }
    const auto add = [&](const char* id, double x, double y) {
        face.points.push_back(shapes::point_at(face.mesh, id, vertex_at(x, y)));
        if (mirror_point(id) != id)
            face.points.push_back(shapes::point_at(face.mesh, std::string(mirror_point(id)), vertex_at(-x, y)));
    };
    add("2.1", 0, -120), add("2.2", 0, -72), add("3.1", 32, 8), add("3.3", 32, -8), add("3.7", 48, 0);
    add("3.11", 16, 0), add("4.1", 12, 24), add("4.3", 32, 32), add("4.5", 52, 24), add("5.3", 44, -32);
    add("8.1", 0, -60), add("8.2", 0, -84), add("8.3", 28, -72), add("9.3", 0, -36), add("9.15", 0, -52);
    add("11.1", 0, 80), add("11.4", 0, 120);
    face.mesh.positions.push_back({0, -40, -90});  // 7.1, of no face
    face.points.push_back(
        shapes::point_at(face.mesh, "7.1", static_cast<std::uint32_t>(face.mesh.positions.size() - 1)));
    add_ball(face.mesh, {eye_x, 0, -20}, eye_radius);
    add_ball(face.mesh, {-eye_x, 0, -20}, eye_radius);
    return face;
}

/// The parameters whose fields the head has.
inline const std::vector<int>& moving_faps() {
    static const std::vector<int> all{3, 31, 32, 35, 36, 41, 42, 52, 53, 54, 64};
    return all;
}

inline Vec3 axis_of(const Fap& fap) {
    const double s = fap.sign;
    return fap.axis == FapAxis::x ? Vec3{s, 0, 0} : fap.axis == FapAxis::y ? Vec3{0, s, 0} : Vec3{0, 0, s};
}

/// How far a vertex goes at one unit of a parameter: along its axis, and a little forward beside the point; nothing
/// beyond 11 mm from it.
inline Vec3 field(const Face& face, const Fapu& fapu, int fap, std::uint32_t vertex) {
    constexpr double reach = 11;
    const FeaturePoint& point = face.points[*find_point(face.points, fap_info(fap).point)];
    const double away = distance(point.position, to_double(face.mesh.positions[vertex])) / reach;
    if (away >= 1) return {};
    const double height = (1 - away * away) * (1 - away * away);
    return unit_length(fapu, fap_info(fap).unit) * height * (axis_of(fap_info(fap)) + Vec3{0, 0, away});
}

/// A table of what a vertex does at a value; `bend`: what is done to the value before.
using Bend = std::function<double(int fap, double value)>;

/// The head as a stream moves it: the fields, the eyeballs by FAPs 23 to 26, and the head by `poses`, of which there
/// may be none.
inline MeshSequence play(
    const Face& face, const Fapu& fapu, const FapStream& stream, std::vector<Pose> poses = {},
    const Bend& bend = [](int, double value) { return value; }) {
    struct Data {
        Face face;
        std::map<int, std::vector<Vec3>> fields;
        std::vector<FapFrame> frames;
        std::vector<Pose> poses;
    };
    auto data = std::make_shared<Data>(Data{face, {}, stream.frames, std::move(poses)});
    for (const int fap : moving_faps())
        for (std::uint32_t v = 0; v < face.mesh.positions.size(); ++v)
            data->fields[fap].push_back(field(face, fapu, fap, v));
    MeshSequence sequence{face.mesh, {}, {}};
    for (const FapFrame& frame : stream.frames) sequence.times.push_back(frame.number / stream.rate);
    sequence.positions = [data, bend](std::size_t r, std::span<Vec3f> positions) {
        const FapFrame& frame = data->frames[r];
        const auto angle = [&](int fap) { return 1e-5 * frame.value[fap_index(fap)]; };
        const std::size_t balls = (positions.size() - std::size_t{columns + 1} * (rows + 1) - 1) / 2;
        for (std::size_t v = 0; v < positions.size(); ++v) {
            Vec3 p = to_double(data->face.mesh.positions[v]);
            for (const auto& [fap, moves] : data->fields) p += bend(fap, frame.value[fap_index(fap)]) * moves[v];
            if (v >= positions.size() - 2 * balls) {
                const bool left = v < positions.size() - balls;
                const Vec3 centre{left ? eye_x : -eye_x, 0, -20};
                const Quaternion yaw{0, std::sin(angle(left ? 23 : 24) / 2), 0, std::cos(angle(left ? 23 : 24) / 2)};
                const Quaternion pitch{std::sin(angle(left ? 25 : 26) / 2), 0, 0, std::cos(angle(left ? 25 : 26) / 2)};
                p = centre + rotate(yaw, rotate(pitch, p - centre));
            }
            if (!data->poses.empty()) p = apply(data->poses[r], p);
            positions[v] = to_float(p);
        }
    };
    return sequence;
}

/// A stream of rest and then each parameter alone, up and down.
inline FapStream one_by_one() {
    FapStream stream;
    const auto add = [&] {
        FapFrame& frame = stream.frames.emplace_back();
        frame.number = static_cast<std::uint32_t>(stream.frames.size() - 1);
        frame.mask.set();
        return &frame;
    };
    add();
    for (const int fap : moving_faps())
        for (const int value : {60, 150, 300, 80, -40, -120}) add()->value[fap_index(fap)] = value;
    return stream;
}

/// A stream in which all parameters act at once, each at a pace of its own, from rest on.
inline FapStream all_at_once(std::size_t frames = 200) {
    FapStream stream;
    for (std::size_t r = 0; r < frames; ++r) {
        FapFrame& frame = stream.frames.emplace_back();
        frame.number = static_cast<std::uint32_t>(r);
        frame.mask.set();
        double pace = 0.05;
        for (const int fap : moving_faps()) {
            pace += 0.013;
            frame.value[fap_index(fap)] =
                static_cast<std::int32_t>(std::lround(250 * std::sin(pace * static_cast<double>(r))));
        }
        for (const int eye : {23, 24, 25, 26})
            frame.value[fap_index(eye)] =
                static_cast<std::int32_t>(std::lround(20000 * std::sin((0.02 + 0.003 * eye) * static_cast<double>(r))));
    }
    return stream;
}

/// A turn by `angle` radians about an axis of length 1.
inline Quaternion turn(const Vec3& axis, double angle) {
    const Vec3 v = std::sin(angle / 2) * axis;
    return {v.x, v.y, v.z, std::cos(angle / 2)};
}

/// Poses of a head that moves, at rest in the first row.
inline std::vector<Pose> poses(std::size_t count) {
    std::vector<Pose> result;
    for (std::size_t r = 0; r < count; ++r) {
        const double t = static_cast<double>(r);
        const Vec3 axis = Vec3{2, 3, 1} / std::sqrt(14.0);
        result.push_back({turn(axis, 0.3 * std::sin(0.21 * t)), {3 * std::sin(0.1 * t), 0.2 * t, -0.1 * t}});
    }
    return result;
}

/// The animation as if its head had been taken still already.
inline UprightSequence still(const Face& face, const MeshSequence& sequence) {
    UprightSequence upright;
    upright.sequence = sequence;
    upright.points = face.points;
    upright.head.assign(sequence.times.size(), Pose{});
    return upright;
}

}  // namespace mien::animated
