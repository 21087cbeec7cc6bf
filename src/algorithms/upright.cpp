// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/upright.hpp"

#include <algorithm>
#include <cmath>

#include "algorithms/face_frame.hpp"
#include "algorithms/rotation.hpp"

#include "mien/face.hpp"

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

}  // namespace

std::optional<Quaternion> face_turn(const Take& take, const NeutralOptions& options) {
    const std::vector<Vec3> rest = neutral(take, options);
    Retarget self;  // of the face to itself
    self.planar = take.planar;
    for (std::size_t c = 0; c < rest.size(); ++c) {
        if (!is_finite(rest[c]) || mirror_point(take.points[c]).empty()) continue;
        self.points.push_back(take.points[c]);
        self.source_neutral.push_back(rest[c]);
    }
    self.target_neutral = self.source_neutral;
    if (self.points.size() < 3) return std::nullopt;
    const FaceFrames frames = face_frames(self, 1);
    return frames.known ? std::optional(without_small_nod(frames.source.turn)) : std::nullopt;
}

Take upright(const Take& take, const Quaternion& turn) {
    const Quaternion back = conjugate(turn);
    Take result = take;
    for (Vec3& sample : result.samples) sample = is_finite(sample) ? rotate(back, sample) : lost_sample;
    for (Pose& pose : result.head) pose = {back * pose.rotation * turn, rotate(back, pose.translation)};
    return result;
}

}  // namespace mien
