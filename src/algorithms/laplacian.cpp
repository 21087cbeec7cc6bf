// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Cotangent weights (Pinkall and Polthier 1993) with lumped areas. Each triangle adds a positive semidefinite part, so
// that obtuse corners, whose cotangents are negative, do no harm to the sum; a sliver is scaled as a whole to keep it
// so.

#include "algorithms/laplacian.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

namespace mien {

namespace {

constexpr double largest_cotangent = 100;
constexpr double soft_cotangent = 0.01;  // all three sides of a triangle without area
constexpr double smallest_area = 1e-3;   // as a share of the mean

using Triplets = std::vector<Eigen::Triplet<double>>;
using Triangle = std::array<std::uint32_t, 3>;

std::array<double, 3> cotangents_of(const std::array<Vec3, 3>& p, double twice_area) {
    std::array<double, 3> cot{};
    double largest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        cot[k] = dot(p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]) / twice_area;
        largest = std::max(largest, std::abs(cot[k]));
    }
    if (!std::isfinite(largest)) return {soft_cotangent, soft_cotangent, soft_cotangent};
    for (double& c : cot) c *= std::min(1.0, largest_cotangent / largest);
    return cot;
}

void add_side(Triplets& entries, std::uint32_t a, std::uint32_t b, double weight) {
    if (a == b) return;
    const auto i = static_cast<int>(a), j = static_cast<int>(b);
    entries.emplace_back(i, i, weight);
    entries.emplace_back(j, j, weight);
    entries.emplace_back(i, j, -weight);
    entries.emplace_back(j, i, -weight);
}

struct Surface {
    const Mesh& mesh;
    const Weld& weld;
    double least_cotangent;
    Triplets entries;
    Eigen::VectorXd areas;
};

void add_triangle(Surface& surface, const Triangle& t, double share) {
    std::array<Vec3, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = to_double(surface.mesh.positions[surface.weld.vertex[t[k]]]);
    const double twice_area = length(cross(p[1] - p[0], p[2] - p[0]));
    const auto cot = cotangents_of(p, twice_area);
    for (std::size_t k = 0; k < 3; ++k) {
        surface.areas[t[k]] += share * twice_area / 6;
        add_side(surface.entries, t[(k + 1) % 3], t[(k + 2) % 3],
                 share * std::max(cot[k], surface.least_cotangent) / 2);
    }
}

// One fan is enough for a polygon of many corners.
void add_polygon(Surface& surface, std::span<const std::uint32_t> corners) {
    const std::size_t n = corners.size(), fans = n == 3 || n > 8 ? 1 : n;
    const auto place = [&](std::size_t corner) { return surface.weld.place[corners[corner % n]]; };
    for (std::size_t apex = 0; apex < fans; ++apex)
        for (std::size_t k = 1; k + 1 < n; ++k)
            add_triangle(surface, {place(apex), place(apex + k), place(apex + k + 1)}, 1.0 / static_cast<double>(fans));
}

}  // namespace

Laplacian laplacian(const Mesh& mesh, const Weld& weld, Cotangents cotangents) {
    const auto places = static_cast<Eigen::Index>(weld.vertex.size());
    const double least = cotangents == Cotangents::positive ? 0 : -largest_cotangent;
    Surface surface{mesh, weld, least, {}, Eigen::VectorXd::Zero(places)};
    for (std::size_t f = 0; f < face_count(mesh); ++f) add_polygon(surface, face(mesh, f));
    Laplacian result{Eigen::SparseMatrix<double>(places, places), {}};
    result.stiffness.setFromTriplets(surface.entries.begin(), surface.entries.end());
    result.areas = surface.areas.cwiseMax(smallest_area * surface.areas.mean());
    return result;
}

}  // namespace mien
