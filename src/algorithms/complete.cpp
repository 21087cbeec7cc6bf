// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/complete.hpp"

#include <cstddef>
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

// A column of a whole take that the skin carries, along the axes on which `point` does not move.
struct CarriedColumn {
    std::size_t column;
    FeaturePoint point;
};

std::vector<CarriedColumn> carried_columns(const Face& face, const Take& take) {
    std::vector<CarriedColumn> carried;
    std::size_t added = take.points.size();
    for (const FeaturePoint& point : face.points) {
        const auto column = find_column(take, point.id);
        if (column && point.moves == Axes{}) continue;
        carried.push_back({column ? *column : added++, point});
        if (!column) carried.back().point.moves = {false, false, false};
    }
    return carried;
}

void carry(Vec3& sample, const Axes& moves, const Vec3& place) {
    if (!moves.x) sample.x = place.x;
    if (!moves.y) sample.y = place.y;
    if (!moves.z) sample.z = place.z;
}

}  // namespace

Take complete(const Face& face, const Take& take) {
    const std::vector<CarriedColumn> carried = carried_columns(face, take);
    if (carried.empty()) return take;
    const Face driven = with_points(face, take.points);
    if (driven.points.empty()) throw Error("complete: the take drives none of the face's feature points");
    BiharmonicOptions every_influence;
    every_influence.influences = 0;
    const Rig carrier = rig_biharmonic(driven, every_influence);
    const TakeBinding binding = bind_take(carrier, take);

    Take result = take;
    const std::vector<std::string> missing = missing_points(face, take);
    result.points.insert(result.points.end(), missing.begin(), missing.end());
    result.samples.clear();
    std::vector<Vec3f> moved(carrier.points.size());
    for (std::size_t r = 0; r < row_count(take); ++r) {
        displacements(carrier, binding, row(take, r), moved);
        const std::size_t first = result.samples.size();
        result.samples.insert(result.samples.end(), row(take, r).begin(), row(take, r).end());
        result.samples.resize(first + result.points.size());
        for (const auto& [column, point] : carried)
            carry(result.samples[first + column], point.moves,
                  point.position + displacement_at(carrier, point.vertex, moved));
    }
    return result;
}

}  // namespace mien
