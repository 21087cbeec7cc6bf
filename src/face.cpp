// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/face.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <utility>

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

namespace {

// The subject's left, then right.
constexpr std::array<std::pair<std::string_view, std::string_view>, 32> mirror_pairs{
    {{"2.4", "2.5"},    {"2.6", "2.7"},   {"2.8", "2.9"},   {"2.11", "2.12"}, {"2.13", "2.14"}, {"3.1", "3.2"},
     {"3.3", "3.4"},    {"3.5", "3.6"},   {"3.7", "3.12"},  {"3.9", "3.10"},  {"3.11", "3.8"},  {"3.13", "3.14"},
     {"4.1", "4.2"},    {"4.3", "4.4"},   {"4.5", "4.6"},   {"5.1", "5.2"},   {"5.3", "5.4"},   {"6.3", "6.4"},
     {"8.3", "8.4"},    {"8.5", "8.6"},   {"8.7", "8.8"},   {"8.10", "8.9"},  {"9.1", "9.2"},   {"9.5", "9.4"},
     {"9.7", "9.6"},    {"9.13", "9.14"}, {"10.1", "10.2"}, {"10.3", "10.4"}, {"10.5", "10.6"}, {"10.7", "10.8"},
     {"10.9", "10.10"}, {"11.3", "11.2"}}};

constexpr std::array<std::string_view, 20> midline{"2.1",  "2.2",  "2.3",  "2.10", "6.1",  "6.2",  "7.1",
                                                   "8.1",  "8.2",  "9.3",  "9.8",  "9.9",  "9.10", "9.11",
                                                   "9.12", "9.15", "11.1", "11.4", "11.5", "11.6"};

}  // namespace

std::string_view mirror_point(std::string_view id) {
    for (const auto& [left, right] : mirror_pairs) {
        if (id == left) return right;
        if (id == right) return left;
    }
    const auto found = std::find(midline.begin(), midline.end(), id);
    return found == midline.end() ? std::string_view{} : *found;
}

}  // namespace mien
