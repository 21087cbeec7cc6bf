// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Faces and performances whose truth on another face is known: two people of one model whose expressions are the same
// displacements on both, and a cartoon that is a warp of one of them. They lie beside the project.

#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "mien/algorithms/retarget.hpp"
#include "mien/face.hpp"
#include "mien/io/gltf.hpp"
#include "mien/io/obj.hpp"
#include "mien/io/points.hpp"

namespace mien::faces {

using Points = std::map<std::string, Vec3, std::less<>>;
using Frames = std::vector<Points>;  // displacements; a point that does not move may be left out

inline std::filesystem::path folder() {
    return std::filesystem::path(MIEN_SHARED) / "data";
}

inline std::string contents(const std::string& name) {
    std::ifstream file(folder() / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

inline double number(const std::string& text) {
    double value = std::nan("");
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
}

inline Points places(const Mesh& mesh, const std::string& points) {
    const std::string text = contents(points);
    Points result;
    for (const FeaturePoint& point : parse_points(std::as_bytes(std::span(text)), mesh).points)
        result[point.id] = point.position;
    return result;
}

inline Points from_obj(const std::string& file, const std::string& points) {
    const std::string text = contents(file);
    return places(parse_obj(std::as_bytes(std::span(text))), points);
}

inline Points from_glb(const std::string& file, const std::string& points) {
    const std::string text = contents(file);
    const auto none_beside = [](std::string_view) { return std::vector<std::byte>(); };
    return places(parse_gltf(std::as_bytes(std::span(text)), none_beside), points);
}

inline Points person(char name) {
    return from_obj(std::string("ict/ict_identity_") + name + ".obj", "ict/feature_points.json");
}

inline std::vector<std::string> point_set(const std::string& name) {
    return nlohmann::json::parse(contents("ict/feature_points.json")).at("_sets").at(name);
}

/// Both eyes one and a half times as large and more, the face wide and short.
inline Vec3 cartoon_place(const Points& person, const Vec3& p) {
    Vec3 result = p;
    for (const auto& [outer, inner] : {std::pair{"3.7", "3.11"}, std::pair{"3.12", "3.8"}}) {
        const Vec3 eye = 0.5 * (person.at(outer) + person.at(inner));
        const Vec3 d = p - eye;
        result += 0.6 * std::exp(-dot(d, d) / (2 * 1.8 * 1.8)) * d;
    }
    return {1.3 * result.x, 0.85 * result.y, 1.15 * result.z};
}

inline Points cartoon(const Points& person) {
    Points result;
    for (const auto& [id, p] : person) result[id] = cartoon_place(person, p);
    return result;
}

/// What the warp makes of the person's displacements.
inline Frames cartoon_motion(const Points& person, const Frames& frames) {
    Frames result;
    for (const Points& frame : frames) {
        result.emplace_back();
        for (const auto& [id, d] : frame)
            if (person.contains(id))
                result.back()[id] = cartoon_place(person, person.at(id) + d) - cartoon_place(person, person.at(id));
    }
    return result;
}

/// Displacements of the named shapes of the model, in centimetres.
inline std::map<std::string, Points> shapes() {
    std::map<std::string, Points> motions;
    std::istringstream lines(contents("names/arkit52_point_motion.csv"));
    std::string shape, point, x, y, z;
    std::getline(lines, shape);
    while (std::getline(lines, shape, ',') && std::getline(lines, point, ',') && std::getline(lines, x, ',') &&
           std::getline(lines, y, ',') && std::getline(lines, z))
        if (shape[0] != '_' && !shape.starts_with("viseme"))
            motions[shape][point] = 6.386 * Vec3{number(x), number(y), number(z)};
    return motions;
}

/// The shapes that the open head of the model holds.
inline std::map<std::string, Points> open_shapes() {
    constexpr std::array<std::string_view, 16> open{"browDown",    "browInnerUp", "eyeBlink",       "eyeLookDown",
                                                    "eyeSquint",   "cheekPuff",   "jawOpen",        "jawLeft",
                                                    "jawRight",    "mouthSmile",  "mouthFrown",     "mouthUpperUp",
                                                    "mouthFunnel", "mouthPucker", "mouthRollLower", "mouthShrugLower"};
    std::map<std::string, Points> result;
    for (const auto& [name, motion] : shapes()) {
        std::string stem = name;
        for (const std::string_view side : {"Left", "Right"})
            if (stem.ends_with(side) && !stem.starts_with("jaw")) stem.resize(stem.size() - side.size());
        if (stem == "noseSneer" || std::find(open.begin(), open.end(), stem) != open.end()) result[name] = motion;
    }
    return result;
}

inline void add(Points& sum, double weight, const Points& motion) {
    for (const auto& [id, d] : motion) sum[id] += weight * d;
}

inline Frames single(const std::map<std::string, Points>& shapes) {
    Frames frames;
    for (const auto& [name, motion] : shapes) frames.push_back(motion);
    return frames;
}

/// 0 up to 1, the same numbers everywhere.
struct Dice {
    std::uint64_t state = 1;
    double operator()() {
        state = state * 6364136223846793005U + 1442695040888963407U;
        return static_cast<double>(state >> 33) / 2147483648.0;
    }
    double normal() {
        double sum = -6;
        for (int i = 0; i < 12; ++i) sum += (*this)();
        return sum;
    }
};

/// Two in five of the shapes, at any weight.
inline Frames mixes(const std::map<std::string, Points>& shapes, std::size_t count = 200) {
    Dice dice;
    Frames frames(count);
    for (Points& frame : frames)
        for (const auto& [name, motion] : shapes)
            if (dice() < 0.4) add(frame, dice(), motion);
    return frames;
}

/// A recording of shape weights, played on the model's shapes.
inline Frames recording(const std::string& file, std::size_t every = 1) {
    const std::map<std::string, Points> known = shapes();
    std::istringstream lines(contents("arkit-recordings/" + file));
    std::vector<const Points*> columns;
    std::string line, cell;
    std::getline(lines, line);
    for (std::istringstream cells(line); std::getline(cells, cell, ',');) {
        if (!cell.empty()) cell[0] = static_cast<char>(std::tolower(cell[0]));
        const auto shape = known.find(cell);
        columns.push_back(shape == known.end() ? nullptr : &shape->second);
    }
    Frames frames;
    for (std::size_t r = 0; std::getline(lines, line); ++r) {
        if (r % every != 0) continue;
        frames.emplace_back();
        std::istringstream cells(line);
        for (std::size_t c = 0; std::getline(cells, cell, ','); ++c)
            if (c < columns.size() && columns[c] != nullptr) add(frames.back(), number(cell), *columns[c]);
    }
    return frames;
}

inline Face face_of(const Points& points) {
    Face face;
    for (const auto& [id, position] : points) face.points.push_back({id, 0, position, {}, 0});
    return face;
}

inline Points with_ids(const Points& points, const std::vector<std::string>& ids) {
    Points result;
    for (const std::string& id : ids)
        if (points.contains(id)) result[id] = points.at(id);
    return result;
}

/// The neutral in row 0, then the frames.
inline Take take_of(const Points& rest, const Frames& frames) {
    Take take;
    for (const auto& [id, position] : rest) take.points.push_back(id);
    for (std::size_t r = 0; r <= frames.size(); ++r) {
        take.times.push_back(static_cast<double>(r) / 60);
        for (const auto& [id, position] : rest) {
            const bool moves = r > 0 && frames[r - 1].contains(id);
            take.samples.push_back(moves ? position + frames[r - 1].at(id) : position);
        }
    }
    return take;
}

inline Take performed(const Take& take, const Points& target, const RetargetOptions& options = {}) {
    return retarget(fit_retarget(take, face_of(target), options), take);
}

inline double eyes(const Points& points) {
    return eye_distance(face_of(points).points);
}

/// Root of the sums of squares over all points and rows: error over true motion. Both takes have the same columns;
/// `counts` chooses the rows.
inline double relative_error(const Take& out, const Take& truth, const std::function<bool(std::size_t)>& counts = {}) {
    double error = 0, motion = 0;
    for (std::size_t r = 1; r < row_count(truth); ++r) {
        if (counts && !counts(r)) continue;
        for (std::size_t c = 0; c < truth.points.size(); ++c) {
            const Vec3 d = row(truth, r)[c] - row(truth, 0)[c];
            const Vec3 miss = row(out, r)[c] - row(out, 0)[c] - d;
            error += dot(miss, miss);
            motion += dot(d, d);
        }
    }
    return std::sqrt(error / motion);
}

}  // namespace mien::faces
