// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The nearest point of the skin to a lash, brow or hair: a binary tree of boxes, halved at the middle triangle along
// the longest side, searched nearest box first.

#include "algorithms/surface_tree.hpp"

#include <algorithm>
#include <cmath>

namespace mien {

namespace {

// Share of b in the point of segment ab that is nearest to p.
double along(const Vec3& p, const Vec3& a, const Vec3& b) {
    const Vec3 ab = b - a;
    const double squared = dot(ab, ab);
    return squared > 0 ? std::clamp(dot(p - a, ab) / squared, 0.0, 1.0) : 0;
}

struct Foot {
    double distance = std::numeric_limits<double>::infinity();
    std::array<double, 3> shares{};
};

Foot foot_at(const Vec3& p, const std::array<Vec3, 3>& corners, const std::array<double, 3>& shares) {
    return {distance(p, shares[0] * corners[0] + shares[1] * corners[1] + shares[2] * corners[2]), shares};
}

// The foot of the perpendicular when it falls inside, else the nearest of the three sides.
Foot foot_on_triangle(const Vec3& p, const std::array<Vec3, 3>& corners) {
    const Vec3 ab = corners[1] - corners[0], ac = corners[2] - corners[0], ap = p - corners[0];
    const Vec3 normal = cross(ab, ac);
    const double squared = dot(normal, normal);
    if (squared > 0) {
        const double b = dot(cross(ap, ac), normal) / squared;
        const double c = dot(cross(ab, ap), normal) / squared;
        if (b >= 0 && c >= 0 && b + c <= 1) return foot_at(p, corners, {1 - b - c, b, c});
    }
    Foot best;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t next = (k + 1) % 3;
        std::array<double, 3> shares{};
        shares[next] = along(p, corners[k], corners[next]);
        shares[k] = 1 - shares[next];
        const Foot foot = foot_at(p, corners, shares);
        if (foot.distance < best.distance) best = foot;
    }
    return best;
}

double distance_to_box(const Vec3& p, const Box& box) {
    const auto outside = [](double x, double low, double high) { return std::max({low - x, 0.0, x - high}); };
    return length(Vec3{outside(p.x, box.low.x, box.high.x), outside(p.y, box.low.y, box.high.y),
                       outside(p.z, box.low.z, box.high.z)});
}

void widen(Box& box, const Vec3& p) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
}

double longest_axis_value(const Vec3& p, const Vec3& extent) {
    if (extent.x >= extent.y && extent.x >= extent.z) return p.x;
    return extent.y >= extent.z ? p.y : p.z;
}

}  // namespace

SurfaceTree::SurfaceTree(const Mesh& mesh, const Weld& weld, const std::vector<bool>& marked) {
    const auto at = [&](std::uint32_t place) { return to_double(mesh.positions[weld.vertex[place]]); };
    for (std::size_t f = 0; f < face_count(mesh); ++f) {
        const auto corners = face(mesh, f);
        if (!std::all_of(corners.begin(), corners.end(), [&](std::uint32_t v) { return marked[weld.place[v]]; }))
            continue;
        for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
            const std::array<std::uint32_t, 3> places{weld.place[corners[0]], weld.place[corners[k]],
                                                      weld.place[corners[k + 1]]};
            triangles_.push_back({places, {at(places[0]), at(places[1]), at(places[2])}});
        }
    }
    if (!triangles_.empty()) build(0, static_cast<std::uint32_t>(triangles_.size()));
}

std::uint32_t SurfaceTree::build(std::uint32_t first, std::uint32_t last) {
    Node node{{triangles_[first].corners[0], triangles_[first].corners[0]}, first, last - first, 0, 0};
    for (std::uint32_t t = first; t < last; ++t)
        for (const Vec3& corner : triangles_[t].corners) widen(node.box, corner);
    if (node.count > 8) {
        const Vec3 extent = node.box.high - node.box.low;
        const auto value = [&](const Triangle& t) {
            return longest_axis_value(t.corners[0] + t.corners[1] + t.corners[2], extent);
        };
        const std::uint32_t middle = first + node.count / 2;
        std::stable_sort(triangles_.begin() + first, triangles_.begin() + last,
                         [&](const Triangle& a, const Triangle& b) { return value(a) < value(b); });
        node.count = 0;
        node.left = build(first, middle);
        node.right = build(middle, last);
    }
    nodes_.push_back(node);
    return static_cast<std::uint32_t>(nodes_.size() - 1);
}

SurfacePoint SurfaceTree::nearest(const Vec3& p) const {
    SurfacePoint best;
    std::vector<std::uint32_t> open;
    if (!nodes_.empty()) open.push_back(static_cast<std::uint32_t>(nodes_.size() - 1));
    while (!open.empty()) {
        const Node& node = nodes_[open.back()];
        open.pop_back();
        if (distance_to_box(p, node.box) >= best.distance) continue;
        for (std::uint32_t t = node.first; t < node.first + node.count; ++t) {
            const Foot foot = foot_on_triangle(p, triangles_[t].corners);
            if (foot.distance < best.distance) best = {foot.distance, triangles_[t].places, foot.shares};
        }
        if (node.count > 0) continue;
        const bool left_is_near =
            distance_to_box(p, nodes_[node.left].box) <= distance_to_box(p, nodes_[node.right].box);
        open.push_back(left_is_near ? node.right : node.left);
        open.push_back(left_is_near ? node.left : node.right);
    }
    return best;
}

}  // namespace mien
