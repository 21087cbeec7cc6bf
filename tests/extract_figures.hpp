// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// How well an animation comes back from what was extracted of it: a head with ARKit shapes that plays a recording, and
// a head whose maker drew one field per parameter. For the test and the benchmark.

#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "arkit_head.hpp"
#include "obadiah_figures.hpp"

#include "mien/algorithms/deform.hpp"
#include "mien/algorithms/extract_faps.hpp"
#include "mien/algorithms/fapu.hpp"
#include "mien/algorithms/learn_fat.hpp"
#include "mien/algorithms/replay_error.hpp"

namespace mien::extracted {

/// An animation taken apart, and how well it is made again.
struct Result {
    UprightSequence upright;
    Fapu fapu;
    FapStream stream;
    LearntFat learnt;
    ReplayError replay;
    std::vector<double> beyond;  ///< by region and over all: what no mix of parameters gives
    std::size_t entries = 0;     ///< displacement vectors in the table
};

inline Face face_of(const Result& result) {
    return {result.upright.sequence.mesh, result.upright.points};
}

/// How a table plays a stream of the same head, the head's own motion left out of both.
inline ReplayError replayed(const Result& truth, const Fat& fat) {
    FapStream stream = truth.stream;
    for (FapFrame& frame : stream.frames)
        for (const int fap : {48, 49, 50}) frame.value[fap_index(fap)] = 0;
    const MeshSequence played = deform(fat, truth.upright.sequence.mesh, stream);
    return replay_error(face_of(truth), truth.upright.sequence, rows_of_frames(truth.upright.sequence, played.times),
                        played);
}

/// Learns from an animation that keeps still. Without a stream the parameters are extracted.
inline Result learn(UprightSequence upright, Reading reading, const FapStream& stream = {}) {
    Result result;
    result.upright = std::move(upright);
    result.fapu = measure_fapu(face_of(result));
    result.stream = stream.frames.empty() ? extract_faps(result.upright, result.fapu) : stream;
    result.learnt = learn_fat(result.upright, result.fapu, result.stream, reading);
    result.replay = replayed(result, result.learnt.fat);
    result.beyond = shares_by_region(face_of(result), result.learnt.beyond, result.learnt.motion);
    for (const FaceDefTables& table : result.learnt.fat.tables)
        for (const FaceDefMesh& mesh : table.meshes) result.entries += mesh.displacements.size();
    return result;
}

/// How far the head's motion that was found is from the true one.
struct PoseError {
    double degrees = 0;
    double shift = 0;  ///< of the centre between the eyes, in eye distances
};

inline PoseError pose_error(const UprightSequence& upright, const std::vector<Pose>& truth) {
    Vec3 eyes;
    for (const char* id : {"3.7", "3.8", "3.11", "3.12"})
        eyes += 0.25 * upright.points[*find_point(upright.points, id)].position;
    eyes = apply(upright.source, eyes);
    const Quaternion& s = upright.source.rotation;
    const auto source_of = [&](const Vec3& p) { return rotate(conjugate(s), p - upright.source.translation); };
    PoseError error;
    for (std::size_t r = 0; r < truth.size(); ++r) {
        const auto found = [&](const Vec3& p) { return apply(upright.source, apply(upright.head[r], source_of(p))); };
        error.shift = std::max(error.shift, distance(found(eyes), apply(truth[r], eyes)));
        for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
            const Vec3 is = found(eyes + axis) - found(eyes), was = rotate(truth[r].rotation, axis);
            error.degrees = std::max(error.degrees, std::atan2(length(cross(is, was)), dot(is, was)) * 57.29577951);
        }
    }
    error.shift /= eye_distance(upright.points);
    return error;
}

/// The head with ARKit shapes that plays a recording and moves, and what was taken from it.
struct Talking {
    Result result;
    PoseError pose;
};

inline Talking talking(const std::string& recording, std::size_t step, Reading reading) {
    const arkit::AnimatedHead head = arkit::animated_head(recording, step);
    const std::vector<FeaturePoint> points = read_points(arkit::points_file(), head.moving.mesh).points;
    Talking talking;
    UprightSequence taken = upright(head.moving, points, reading);
    talking.pose = pose_error(taken, head.poses);
    talking.result = learn(std::move(taken), reading);
    return talking;
}

using Fields = std::map<int, std::vector<Vec3>>;

/// The fields that were drawn for parameters that move skin.
inline Fields drawn_fields(const Mesh& mesh) {
    Fields fields;
    for (int fap = 3; fap <= 68; ++fap)
        if (fap_info(fap).unit != FapUnit::angle)
            if (auto field = obadiah::drawn_field(mesh, fap)) fields[fap] = std::move(*field);
    return fields;
}

/// Each parameter alone, up and down.
inline FapStream one_by_one(const Fields& fields) {
    FapStream stream;
    const auto add = [&](int fap, int value) {
        FapFrame& frame = stream.frames.emplace_back();
        frame.number = static_cast<std::uint32_t>(stream.frames.size() - 1);
        frame.mask.set();
        if (fap > 0) frame.value[fap_index(fap)] = value;
    };
    add(0, 0);
    for (const auto& [fap, field] : fields)
        for (const int value : {100, 200, 400, 200, -100, -200}) add(fap, value);
    return stream;
}

/// All parameters at once, in every frame but the first.
inline FapStream all_at_once(const Fields& fields, std::size_t frames = 400) {
    FapStream stream;
    for (std::size_t r = 0; r < frames; ++r) {
        FapFrame& frame = stream.frames.emplace_back();
        frame.number = static_cast<std::uint32_t>(r);
        frame.mask.set();
        int place = 0;
        for (const auto& [fap, field] : fields) {
            const double t = static_cast<double>(r);
            ++place;
            frame.value[fap_index(fap)] =
                static_cast<std::int32_t>(std::lround(r == 0 ? 0
                                                             : 200 * std::sin(0.0563 * (place + 1) * t + place) +
                                                                   100 * std::sin(0.11 * (place % 7 + 1) * t)));
        }
    }
    return stream;
}

/// The head as its fields and a stream move it.
inline UprightSequence drawn(const Face& face, const Fields& fields, const FapStream& stream) {
    UprightSequence upright;
    upright.points = face.points;
    upright.sequence.mesh = face.mesh;
    upright.sequence.mesh.morph_targets.clear();
    for (const FapFrame& frame : stream.frames) upright.sequence.times.push_back(frame.number / stream.rate);
    upright.head.assign(stream.frames.size(), Pose{});
    const auto data = std::make_shared<const std::pair<Fields, std::vector<FapFrame>>>(fields, stream.frames);
    const auto rest = std::make_shared<const std::vector<Vec3f>>(face.mesh.positions);
    upright.sequence.positions = [data, rest](std::size_t row, std::span<Vec3f> filled) {
        std::vector<Vec3> moves(filled.size());
        for (const auto& [fap, field] : data->first)
            if (const double value = data->second[row].value[fap_index(fap)]; value != 0)
                for (std::size_t v = 0; v < moves.size(); ++v) moves[v] += value * field[v];
        for (std::size_t v = 0; v < moves.size(); ++v) filled[v] = to_float(to_double((*rest)[v]) + moves[v]);
    };
    return upright;
}

/// How a learnt field compares with the drawn one.
struct FieldError {
    int fap = 0;
    double error = 0;           ///< RMS off / RMS drawn
    double outside = 0;         ///< largest motion where the drawn field has none, as a share of its peak
    std::size_t strangers = 0;  ///< vertices there that go farther than 1 % of the peak
};

inline std::vector<FieldError> field_errors(const Face& face, const Fields& fields, const Fat& fat) {
    std::vector<FieldError> errors;
    std::vector<Vec3f> moved(vertex_count(face.mesh));
    for (const auto& [fap, field] : fields) {
        constexpr double value = 200;
        FapFrame frame;
        frame.mask.set();
        frame.value[fap_index(fap)] = static_cast<std::int32_t>(value);
        const std::vector<Vec3f> origin(moved.size());  // small numbers: the head lies far from the origin
        Fat skin{{}, fat.tables};
        for (FaceDefTables& table : skin.tables) table.transforms.clear();
        deform(skin, origin, frame, moved);
        double off = 0, all = 0, peak = 0;
        for (const Vec3& f : field) peak = std::max(peak, length(f));
        FieldError& error = errors.emplace_back(FieldError{fap, 0, 0, 0});
        for (std::size_t v = 0; v < field.size(); ++v) {
            const Vec3 is = to_double(moved[v]) / value;
            off += dot(is - field[v], is - field[v]);
            all += dot(field[v], field[v]);
            if (length(field[v]) > 1e-6 * peak) continue;
            error.outside = std::max(error.outside, length(is) / peak);
            if (length(is) > 0.01 * peak) ++error.strangers;
        }
        error.error = std::sqrt(off / all);
    }
    return errors;
}

}  // namespace mien::extracted
