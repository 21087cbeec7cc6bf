// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/upright.hpp"

#include "algorithms/face_frame.hpp"

namespace mien {

std::optional<Quaternion> face_turn(std::span<const FeaturePoint> points) {
    Retarget self;
    for (const FeaturePoint& point : points) {
        self.points.push_back(point.id);
        self.source_neutral.push_back(point.position);
        self.target_neutral.push_back(point.position);
    }
    if (points.size() < 3) return std::nullopt;
    const FaceFrames frames = face_frames(self, eye_distance(points));
    return frames.known ? std::optional(frames.target.turn) : std::nullopt;
}

}  // namespace mien
