// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "algorithms/shape_style.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <string_view>

#include "mien/algorithms/partial.hpp"

namespace mien {

namespace {

constexpr double ridge = 0.3;
constexpr double least_gain = 0.3, most_gain = 3;
constexpr std::array<std::string_view, 6> region_names{"mouth", "jaw", "brows", "lids", "nose", "cheeks"};
constexpr std::size_t whole_face = region_names.size();

Eigen::Vector3d eigen(const Vec3& v) {
    return {v.x, v.y, v.z};
}

std::vector<std::size_t> regions_of(std::span<const FeaturePoint> points) {
    Take names;
    for (const FeaturePoint& point : points) names.points.push_back(point.id);
    std::vector<std::size_t> regions(points.size(), whole_face);
    for (std::size_t r = 0; r < region_names.size(); ++r)
        for (const std::size_t c : part_columns(names, region_names[r])) regions[c] = r;
    return regions;
}

// Displacements of points on the right as the mirror shows them, so that both sides speak of one map.
struct Sides {
    std::vector<Side> side;
    Vec3 across;
};

Sides sides_of(std::span<const FeaturePoint> points, const Vec3& across) {
    Sides sides{{}, across};
    for (const FeaturePoint& point : points) {
        const auto all = standard_points();
        const auto found =
            std::find_if(all.begin(), all.end(), [&](const StandardPoint& p) { return p.id == point.id; });
        sides.side.push_back(found == all.end() ? Side::middle : found->side);
    }
    return sides;
}

Vec3 mirrored(const Vec3& d, const Vec3& across) {
    return d - (2 * dot(across, d)) * across;
}

struct Sums {
    Eigen::Matrix3d theirs_ours = Eigen::Matrix3d::Zero(), ours_ours = Eigen::Matrix3d::Zero();
};

void add(Sums& sums, const Vec3& theirs, const Vec3& ours) {
    sums.theirs_ours += eigen(theirs) * eigen(ours).transpose();
    sums.ours_ours += eigen(ours) * eigen(ours).transpose();
}

double gain(const Sums& sums, double otherwise) {
    const double size = sums.ours_ours.trace();
    return size > 0 ? std::clamp(sums.theirs_ours.trace() / size, least_gain, most_gain) : otherwise;
}

Eigen::Matrix3d map_of(const Sums& sums, double g) {
    const double weight = ridge * sums.ours_ours.trace() / 3;
    const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
    if (!(weight > 0)) return g * one;
    return (sums.ours_ours + weight * one).ldlt().solve((sums.theirs_ours + g * weight * one).transpose()).transpose();
}

}  // namespace

Style fit_style(std::span<const FeaturePoint> points, std::span<const StylePair> pairs, const Vec3& across) {
    const std::vector<std::size_t> region = regions_of(points);
    const Sides sides = sides_of(points, across);
    std::array<Sums, region_names.size() + 1> sums;
    for (const StylePair& pair : pairs)
        for (std::size_t i = 0; i < points.size(); ++i)
            for (const bool other : {false, true}) {
                // A point of the middle speaks for both sides, one of a side for its own.
                if (other != (sides.side[i] == Side::right) && sides.side[i] != Side::middle) continue;
                const Vec3 theirs = other ? mirrored(pair.theirs[i], across) : pair.theirs[i];
                const Vec3 ours = other ? mirrored(pair.ours[i], across) : pair.ours[i];
                add(sums[region[i]], theirs, ours);
                if (region[i] != whole_face) add(sums[whole_face], theirs, ours);
            }
    const double all = gain(sums[whole_face], 1);
    std::array<Eigen::Matrix3d, region_names.size() + 1> maps;
    for (std::size_t r = 0; r < whole_face; ++r) maps[r] = map_of(sums[r], gain(sums[r], all));
    maps[whole_face] = all * Eigen::Matrix3d::Identity();

    Style style;
    const Eigen::Matrix3d X = Eigen::Matrix3d::Identity() - 2 * eigen(across) * eigen(across).transpose();
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Eigen::Matrix3d& left = maps[region[i]];
        const Eigen::Matrix3d right = X * left * X;
        const Eigen::Matrix3d A = sides.side[i] == Side::left    ? left
                                  : sides.side[i] == Side::right ? right
                                                                 : Eigen::Matrix3d((left + right) / 2);
        style.maps.push_back(
            {Vec3{A(0, 0), A(1, 0), A(2, 0)}, {A(0, 1), A(1, 1), A(2, 1)}, {A(0, 2), A(1, 2), A(2, 2)}});
    }
    return style;
}

std::vector<Vec3> styled(const Style& style, std::span<const Vec3> motions) {
    std::vector<Vec3> result;
    for (std::size_t i = 0; i < motions.size(); ++i)
        result.push_back(motions[i].x * style.maps[i][0] + motions[i].y * style.maps[i][1] +
                         motions[i].z * style.maps[i][2]);
    return result;
}

}  // namespace mien
