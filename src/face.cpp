// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/face.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace mien {

std::optional<std::size_t> find_point(std::span<const FeaturePoint> points, std::string_view id) {
    const auto found = std::find_if(points.begin(), points.end(), [&](const FeaturePoint& p) { return p.id == id; });
    if (found == points.end()) return std::nullopt;
    return static_cast<std::size_t>(found - points.begin());
}

Face with_points(const Face& face, std::span<const std::string> ids) {
    Face result{face.mesh, {}};
    std::copy_if(face.points.begin(), face.points.end(), std::back_inserter(result.points),
                 [&](const FeaturePoint& p) { return std::find(ids.begin(), ids.end(), p.id) != ids.end(); });
    return result;
}

namespace {

std::optional<Vec3> middle(std::span<const FeaturePoint> points, std::string_view a, std::string_view b) {
    const auto i = find_point(points, a);
    const auto j = find_point(points, b);
    if (!i || !j) return std::nullopt;
    return 0.5 * (points[*i].position + points[*j].position);
}

// The eye's centre from the first pair of points that is there: corners, pupil, lids, one lid.
std::optional<Vec3> eye(std::span<const FeaturePoint> points, std::initializer_list<std::string_view> pairs) {
    for (auto id = pairs.begin(); id != pairs.end(); id += 2)
        if (const auto centre = middle(points, id[0], id[1])) return centre;
    return std::nullopt;
}

double root_mean_square_radius(std::span<const FeaturePoint> points) {
    if (points.empty()) return 0;
    Vec3 mean;
    for (const FeaturePoint& p : points) mean += p.position;
    mean = mean / static_cast<double>(points.size());
    double sum = 0;
    for (const FeaturePoint& p : points) sum += dot(p.position - mean, p.position - mean);
    return std::sqrt(sum / static_cast<double>(points.size()));
}

}  // namespace

double eye_distance(std::span<const FeaturePoint> points) {
    const auto left =
        eye(points, {"3.7", "3.11", "3.5", "3.5", "3.1", "3.3", "3.9", "3.13", "3.1", "3.1", "3.3", "3.3"});
    const auto right =
        eye(points, {"3.8", "3.12", "3.6", "3.6", "3.2", "3.4", "3.10", "3.14", "3.2", "3.2", "3.4", "3.4"});
    if (left && right && *left != *right) return distance(*left, *right);
    return 0.6 * root_mean_square_radius(points);
}

}  // namespace mien
