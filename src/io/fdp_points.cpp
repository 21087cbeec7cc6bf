// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "io/fdp_points.hpp"

#include <algorithm>

namespace mien {

namespace {

// The distance of two points along an axis; 0 where one is missing or the distance is none.
double apart(std::span<const FeaturePoint> points, std::string_view from, std::string_view to, double Vec3::*axis) {
    const auto a = find_point(points, from), b = find_point(points, to);
    return a && b ? std::max(points[*a].position.*axis - points[*b].position.*axis, 0.0) : 0.0;
}

}  // namespace

Fapu units_of_points(std::span<const FeaturePoint> points) {
    Fapu fapu;
    fapu.irisd = apart(points, "3.1", "3.3", &Vec3::y);
    fapu.es = apart(points, "3.5", "3.6", &Vec3::x);
    fapu.ens = apart(points, "3.5", "9.15", &Vec3::y);
    fapu.mns = apart(points, "9.15", "2.2", &Vec3::y);
    fapu.mw = apart(points, "8.3", "8.4", &Vec3::x);
    return fapu;
}

void name_vertices(std::vector<FeaturePoint>& points, const Mesh& mesh) {
    for (FeaturePoint& point : points) {
        const auto nearer = [&](const Vec3f& a, const Vec3f& b) {
            return distance(to_double(a), point.position) < distance(to_double(b), point.position);
        };
        const auto nearest = std::min_element(mesh.positions.begin(), mesh.positions.end(), nearer);
        if (nearest == mesh.positions.end()) continue;
        point.vertex = static_cast<std::uint32_t>(nearest - mesh.positions.begin());
        point.snapped = distance(to_double(*nearest), point.position);
    }
}

}  // namespace mien
