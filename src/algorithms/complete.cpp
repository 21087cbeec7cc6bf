// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/complete.hpp"

#include <algorithm>
#include <cstdint>
#include <span>

#include "mien/algorithms/deform.hpp"
#include "mien/algorithms/rig_biharmonic.hpp"
#include "mien/error.hpp"

namespace mien {

namespace {

// What a rig does to one vertex.
Vec3 displacement_at(const Rig& rig, std::uint32_t vertex, std::span<const Vec3f> displacements) {
    Vec3 sum;
    for (std::uint32_t k = rig.row_starts[vertex]; k < rig.row_starts[vertex + 1]; ++k) {
        const Vec3 w = to_double(rig.weights[k]);
        const Vec3 d = to_double(displacements[rig.row_points[k]]);
        sum += Vec3{w.x * d.x, w.y * d.y, w.z * d.z};
    }
    return sum;
}

}  // namespace

std::vector<std::string> missing_points(const Face& face, const Take& take) {
    std::vector<std::string> missing;
    for (const FeaturePoint& point : face.points)
        if (!find_column(take, point.id)) missing.push_back(point.id);
    return missing;
}

namespace {

bool moves_freely(const FeaturePoint& point) {
    return point.moves == Axes{};
}

// The place that the take has for a point, but along the axes on which it is carried.
Vec3 carried(const FeaturePoint& point, Vec3 sample, const Vec3& place) {
    if (!point.moves.x) sample.x = place.x;
    if (!point.moves.y) sample.y = place.y;
    if (!point.moves.z) sample.z = place.z;
    return sample;
}

}  // namespace

Take complete(const Face& face, const Take& take) {
    const std::vector<std::string> missing = missing_points(face, take);
    if (missing.empty() && std::all_of(face.points.begin(), face.points.end(), moves_freely)) return take;
    const Face driven = with_points(face, take.points);
    if (driven.points.empty()) throw Error("complete: the take drives none of the face's feature points");
    BiharmonicOptions every_influence;
    every_influence.influences = 0;
    const Rig carrier = rig_biharmonic(driven, every_influence);
    const TakeBinding binding = bind_take(carrier, take);

    Take result = take;
    result.points.insert(result.points.end(), missing.begin(), missing.end());
    result.samples.clear();
    std::vector<Vec3f> moved(carrier.points.size());
    const auto place = [&](const FeaturePoint& point) {
        return point.position + displacement_at(carrier, point.vertex, moved);
    };
    for (std::size_t r = 0; r < row_count(take); ++r) {
        displacements(carrier, binding, row(take, r), moved);
        const std::size_t first = result.samples.size();
        result.samples.insert(result.samples.end(), row(take, r).begin(), row(take, r).end());
        for (const FeaturePoint& point : driven.points) {
            if (moves_freely(point)) continue;
            Vec3& sample = result.samples[first + *find_column(take, point.id)];
            sample = carried(point, sample, place(point));
        }
        for (const std::string& id : missing)
            result.samples.push_back(place(face.points[*find_point(face.points, id)]));
    }
    return result;
}

}  // namespace mien
