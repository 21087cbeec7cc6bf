// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "algorithms/face_frame.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "algorithms/generic_face.hpp"
#include "algorithms/rotation.hpp"
#include "algorithms/similarity.hpp"

#include "mien/face.hpp"

namespace mien {

namespace {

// Points of a generic face, with their places on both sides.
struct Generic {
    std::vector<Vec3> places, source, target;
};

// Eyes, brows and nose sit on the skull. How far the lower face stands out below them differs from person to person and
// says nothing about how the head is held: over all points a face with a strong chin seems to look up by 5 degrees.
bool on_the_skull(std::string_view id) {
    return id.starts_with("3.") || id.starts_with("4.") || id.starts_with("9.");
}

template <class Counts>
Generic generic_points(const Retarget& map, Counts&& counts) {
    Generic result;
    for (std::size_t i = 0; i < map.points.size(); ++i) {
        const std::optional<Vec3> place = generic_position(map.points[i]);
        if (!place || !counts(map.points[i])) continue;
        result.places.push_back(*place);
        result.source.push_back(map.source_neutral[i]);
        result.target.push_back(map.target_neutral[i]);
    }
    return result;
}

bool spread_in_a_plane(const std::vector<Vec3>& points) {
    if (points.empty()) return false;
    const std::array<double, 3> s = spreads(points);
    return s[1] > 0.05 * s[0];
}

std::vector<FeaturePoint> named(const std::vector<std::string>& ids, const std::vector<Vec3>& positions) {
    std::vector<FeaturePoint> points;
    for (std::size_t i = 0; i < ids.size(); ++i) points.push_back({ids[i], 0, positions[i], {}, 0});
    return points;
}

bool has_both_eyes(const std::vector<std::string>& ids) {
    return std::any_of(ids.begin(), ids.end(), [&](const std::string& id) {
        return id.starts_with("3.") && std::find(ids.begin(), ids.end(), mirror_point(id)) != ids.end();
    });
}

// Enough of the skull's points to tell how the head is held: some high, some low, on both sides.
bool has_nose_and_eyes(const std::vector<std::string>& ids) {
    const auto has = [&](std::string_view group) {
        return std::any_of(ids.begin(), ids.end(), [&](const std::string& id) {
            return id.starts_with(group) && generic_position(id) && mirror_point(id) != id &&
                   std::find(ids.begin(), ids.end(), mirror_point(id)) != ids.end();
        });
    };
    return has("9.") && (has("3.") || has("4."));
}

double positive(double eyes) {
    return eyes > 0 ? eyes : 1;  // a single point has no size, and any will do
}

}  // namespace

FaceFrames face_frames(const Retarget& map, double eyes) {
    const Similarity base = best_similarity(map);
    FaceFrames frames;
    if (has_both_eyes(map.points)) {
        frames.source.eyes = positive(eye_distance(named(map.points, map.source_neutral)));
        frames.target.eyes = positive(eye_distance(named(map.points, map.target_neutral)));
    } else {
        frames.target.eyes = positive(eyes);
        frames.source.eyes = frames.target.eyes / base.ratio;
    }
    frames.target.turn = base.rotation;
    const bool skull = has_nose_and_eyes(map.points);
    const Generic generic = generic_points(map, [&](std::string_view id) { return !skull || on_the_skull(id); });
    frames.known =
        spread_in_a_plane(generic.places) && spread_in_a_plane(generic.source) && spread_in_a_plane(generic.target);
    if (!frames.known) return frames;
    const auto best = map.planar ? best_rotation_in_plane : best_rotation;
    frames.source.turn = best(generic.places, generic.source);
    frames.target.turn = best(generic.places, generic.target);
    return frames;
}

}  // namespace mien
