// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/upright.hpp"

#include <algorithm>
#include <cmath>

#include "algorithms/face_frame.hpp"
#include "algorithms/rotation.hpp"

namespace mien {

namespace {

// Where its left is shows in a face's symmetry; how far it nods only in its relief, which differs from face to face:
// five heads that look straight on seem to look from 2 degrees up to 15 down. So a nod is believed only where it is far
// larger, as where a capture has another axis for up; else the face is taken to look level.
constexpr double least_nod = 0.35;  // radians

Quaternion without_small_nod(const Quaternion& turn) {
    const Vec3 ahead = rotate(turn, {0, 0, 1});
    if (std::abs(std::asin(std::clamp(ahead.y, -1.0, 1.0))) > least_nod) return turn;
    const Vec3 left = rotate(turn, {1, 0, 0}), level = cross(left, {0, 1, 0}) / length(cross(left, {0, 1, 0}));
    return nearest_rotation({left, cross(level, left), level});
}

// The turn of the points that `self`, a map of a face to itself, has in its source.
std::optional<Quaternion> turn_of(Retarget& self) {
    self.target_neutral = self.source_neutral;
    if (self.points.size() < 3) return std::nullopt;
    const FaceFrames frames = face_frames(self, 1);
    return frames.known ? std::optional(frames.source.turn) : std::nullopt;
}

}  // namespace

std::optional<Quaternion> face_turn(std::span<const FeaturePoint> points) {
    Retarget self;
    for (const FeaturePoint& point : points) {
        self.points.push_back(point.id);
        self.source_neutral.push_back(point.position);
    }
    return turn_of(self);
}

std::optional<Quaternion> face_turn(const Take& take, const NeutralOptions& options) {
    const std::vector<Vec3> rest = neutral(take, options);
    Retarget self;
    self.planar = take.planar;
    for (std::size_t c = 0; c < rest.size(); ++c) {
        if (!is_finite(rest[c]) || mirror_point(take.points[c]).empty()) continue;
        self.points.push_back(take.points[c]);
        self.source_neutral.push_back(rest[c]);
    }
    const std::optional<Quaternion> turn = turn_of(self);
    return turn ? std::optional(without_small_nod(*turn)) : std::nullopt;
}

Take upright(const Take& take, const Quaternion& turn) {
    const Quaternion back = conjugate(turn);
    Take result = take;
    for (Vec3& sample : result.samples) sample = is_finite(sample) ? rotate(back, sample) : lost_sample;
    for (Pose& pose : result.head) pose = {back * pose.rotation * turn, rotate(back, pose.translation)};
    return result;
}

}  // namespace mien
