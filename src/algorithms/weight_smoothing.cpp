// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The step that follows eq. 5 of Kshirsagar et al. in the remedied reading: the weights of the paper have creases where
// the set of influencing points changes, and none at all where no point reaches.

#include "algorithms/weight_smoothing.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>

namespace mien {

namespace {

struct Operators {
    std::vector<double> areas;                  // one per place
    std::vector<Eigen::Triplet<double>> sides;  // (a, b, weight), both ways
};

double cotangent(const Vec3& at, const Vec3& b, const Vec3& c) {
    const double across = length(cross(b - at, c - at));
    return across > 0 ? std::clamp(dot(b - at, c - at) / across, 0.0, 100.0) : 0;
}

void add_triangle(Operators& operators, const Mesh& mesh, const Weld& weld, const std::array<std::uint32_t, 3>& t,
                  double share) {
    std::array<Vec3, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = to_double(mesh.positions[weld.vertex[t[k]]]);
    const double area = length(cross(p[1] - p[0], p[2] - p[0])) / 2;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
        operators.areas[t[k]] += share * area / 3;
        const double weight = share * cotangent(p[k], p[a], p[b]) / 2;
        if (t[a] == t[b]) continue;
        operators.sides.emplace_back(t[a], t[b], weight);
        operators.sides.emplace_back(t[b], t[a], weight);
    }
}

// The mean over the fans from all corners, so that no diagonal is preferred; one fan for a polygon of many corners.
void add_polygon(Operators& operators, const Mesh& mesh, const Weld& weld, std::span<const std::uint32_t> corners) {
    const std::size_t n = corners.size();
    const std::size_t fans = n == 3 || n > 8 ? 1 : n;
    for (std::size_t apex = 0; apex < fans; ++apex)
        for (std::size_t k = 1; k + 1 < n; ++k)
            add_triangle(operators, mesh, weld,
                         {weld.place[corners[apex]], weld.place[corners[(apex + k) % n]],
                          weld.place[corners[(apex + k + 1) % n]]},
                         1.0 / static_cast<double>(fans));
}

Operators operators_of(const Mesh& mesh, const Weld& weld) {
    Operators operators{std::vector<double>(weld.vertex.size(), 0), {}};
    for (std::size_t f = 0; f < face_count(mesh); ++f) add_polygon(operators, mesh, weld, face(mesh, f));
    return operators;
}

// Which row of the system each place has: -1 where it is not solved, or held.
std::vector<Eigen::Index> number_unknowns(const std::vector<bool>& solved, std::span<const HeldPlace> held) {
    std::vector<Eigen::Index> unknown(solved.size(), -1);
    std::vector<bool> is_free(solved);
    for (const HeldPlace& h : held) is_free[h.place] = false;
    Eigen::Index count = 0;
    for (std::size_t p = 0; p < solved.size(); ++p)
        if (is_free[p]) unknown[p] = count++;
    return unknown;
}

struct System {
    Eigen::SparseMatrix<double> matrix;
    Eigen::MatrixXd right;
};

System assemble(const WeightRows& rows, const Operators& operators, std::span<const Eigen::Index> unknown,
                std::span<const HeldPlace> held, double time) {
    const Eigen::Index unknowns = std::max<Eigen::Index>(0, *std::max_element(unknown.begin(), unknown.end()) + 1);
    std::vector<Eigen::Index> column(65536, -1);
    for (std::size_t i = 0; i < held.size(); ++i) column[held[i].point] = static_cast<Eigen::Index>(i);
    std::vector<Eigen::Index> held_at(unknown.size(), -1);
    for (const HeldPlace& h : held) held_at[h.place] = column[h.point];

    System system{Eigen::SparseMatrix<double>(unknowns, unknowns), Eigen::MatrixXd::Zero(unknowns, std::ssize(held))};
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t p = 0; p < unknown.size(); ++p) {
        if (unknown[p] < 0) continue;
        const double area = std::max(operators.areas[p], 1e-12 * time);
        entries.emplace_back(unknown[p], unknown[p], area);
        for (std::uint32_t e = rows.starts[p]; e < rows.starts[p + 1]; ++e)
            system.right(unknown[p], column[rows.points[e]]) += area * rows.weights[e];
    }
    for (const auto& side : operators.sides) {
        const Eigen::Index a = unknown[side.row()], b = unknown[side.col()];
        if (a < 0) continue;
        entries.emplace_back(a, a, time * side.value());
        if (b >= 0) entries.emplace_back(a, b, -time * side.value());
        if (held_at[side.col()] >= 0) system.right(a, held_at[side.col()]) += time * side.value();
    }
    system.matrix.setFromTriplets(entries.begin(), entries.end());
    return system;
}

}  // namespace

WeightRows smooth_weights(const WeightRows& rows, const Mesh& mesh, const Weld& weld, const std::vector<bool>& solved,
                          std::span<const HeldPlace> held, double length) {
    const std::vector<Eigen::Index> unknown = number_unknowns(solved, held);
    const System system = assemble(rows, operators_of(mesh, weld), unknown, held, length * length);
    if (system.matrix.rows() == 0) return rows;
    const Eigen::MatrixXd weights =
        Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(system.matrix).solve(system.right);
    WeightRows smooth;
    for (std::size_t p = 0; p < unknown.size(); ++p) {
        for (std::uint32_t e = rows.starts[p]; unknown[p] < 0 && e < rows.starts[p + 1]; ++e) {
            smooth.points.push_back(rows.points[e]);
            smooth.weights.push_back(rows.weights[e]);
        }
        for (std::size_t i = 0; unknown[p] >= 0 && i < held.size(); ++i) {
            const double weight = weights(unknown[p], static_cast<Eigen::Index>(i));
            if (weight < 1e-4) continue;
            smooth.points.push_back(held[i].point);
            smooth.weights.push_back(weight);
        }
        smooth.starts.push_back(static_cast<std::uint32_t>(smooth.points.size()));
    }
    return smooth;
}

}  // namespace mien
