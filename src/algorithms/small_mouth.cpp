// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// A jaw tears a mouth that is too narrow for it. Maps of points look about as far as the eyes are apart, and their
// scale there is that of the whole face: on a muzzle whose mouth is a quarter as wide as the performer's, the lower lip
// sinks by two of the mouth's widths, past a chin that is a quarter as far below it, and the mouth becomes a V. The
// people of docs/methods.md have mouths above 0.8 of each other's widths, by the eye distance: they move as their maps
// say.

#include "algorithms/small_mouth.hpp"

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

namespace mien {

namespace {

constexpr double narrow = 0.8;

std::size_t index_of(const Retarget& map, std::string_view id) {
    const auto found = std::find(map.points.begin(), map.points.end(), id);
    return found == map.points.end() ? no_point : static_cast<std::size_t>(found - map.points.begin());
}

// Of the outer contour of the lips, else of the inner one.
std::optional<std::pair<std::size_t, std::size_t>> corners(const Retarget& map) {
    for (const auto& [left, right] : {std::pair("8.3", "8.4"), std::pair("2.4", "2.5")}) {
        const std::size_t a = index_of(map, left), b = index_of(map, right);
        if (a != no_point && b != no_point) return std::pair(a, b);
    }
    return std::nullopt;
}

bool is_lower_face(std::string_view id) {
    return !id.starts_with("3.") && !id.starts_with("4.") && !id.starts_with("11.");
}

}  // namespace

double mouth_share(double width, double expected) {
    return expected > 0 ? std::min(1.0, width / (narrow * expected)) : 1;
}

void fit_small_mouth(Retarget& map, const FaceFrames& frames) {
    const auto mouth = corners(map);
    if (!mouth) return;
    const double source = distance(map.source_neutral[mouth->first], map.source_neutral[mouth->second]);
    const double target = distance(map.target_neutral[mouth->first], map.target_neutral[mouth->second]);
    const double share = mouth_share(target / frames.target.eyes, source / frames.source.eyes);
    for (std::size_t i = 0; i < map.points.size(); ++i)
        if (is_lower_face(map.points[i]))
            for (Vec3& column : map.local[i]) column = share * column;
}

}  // namespace mien
