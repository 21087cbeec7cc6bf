// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/upright.hpp"

#include "algorithms/face_frame.hpp"
#include "algorithms/rotation.hpp"

#include "mien/face.hpp"

namespace mien {

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
    return frames.known ? std::optional(frames.source.turn) : std::nullopt;
}

Take upright(const Take& take, const Quaternion& turn) {
    const Quaternion back = conjugate(turn);
    Take result = take;
    for (Vec3& sample : result.samples) sample = is_finite(sample) ? rotate(back, sample) : lost_sample;
    for (Pose& pose : result.head) pose = {back * pose.rotation * turn, rotate(back, pose.translation)};
    return result;
}

}  // namespace mien
