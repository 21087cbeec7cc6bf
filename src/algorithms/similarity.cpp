// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "algorithms/similarity.hpp"

#include <array>
#include <cmath>
#include <vector>

#include "algorithms/rotation.hpp"

namespace mien {

namespace {

// Root mean square distance to the centre; in the picture's plane for a planar source.
double radius(std::vector<Vec3> points, bool planar) {
    if (planar)
        for (Vec3& p : points) p.z = 0;
    const std::array<double, 3> s = spreads(points);
    return std::hypot(s[0], s[1], s[2]) / std::sqrt(static_cast<double>(points.size()));
}

}  // namespace

Vec3 apply(const Similarity& map, const Vec3& p) {
    return map.ratio * rotate(map.rotation, p - map.from) + map.to;
}

double source_radius(const Retarget& map) {
    return radius(map.source_neutral, map.planar);
}

Similarity best_similarity(const Retarget& map) {
    Similarity result{centre(map.source_neutral), centre(map.target_neutral), 1, {}};
    const double source = source_radius(map);
    const double target = radius(map.target_neutral, map.planar);
    if (source > 0 && target > 0) result.ratio = target / source;
    result.rotation = map.planar ? best_rotation_in_plane(map.source_neutral, map.target_neutral)
                                 : best_rotation(map.source_neutral, map.target_neutral);
    return result;
}

}  // namespace mien
