// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The step that follows eq. 5 of Kshirsagar et al. in the remedied reading: the weights of the paper have creases where
// the set of influencing points changes, and none at all where no point reaches.

#include "algorithms/weight_smoothing.hpp"

#include <algorithm>
#include <vector>

#include "algorithms/laplacian.hpp"
#include "algorithms/sparse_solve.hpp"

namespace mien {

namespace {

constexpr double smallest_weight = 1e-4;

std::vector<std::uint32_t> free_places(const std::vector<bool>& solved, std::span<const HeldPlace> held) {
    std::vector<bool> is_free(solved);
    for (const HeldPlace& h : held) is_free[h.place] = false;
    std::vector<std::uint32_t> places;
    for (std::uint32_t p = 0; p < is_free.size(); ++p)
        if (is_free[p]) places.push_back(p);
    return places;
}

// places x held: the weights as they are.
Eigen::MatrixXd dense(const WeightRows& rows, std::span<const HeldPlace> held) {
    std::vector<Eigen::Index> column(65536, -1);
    for (std::size_t i = 0; i < held.size(); ++i) column[held[i].point] = static_cast<Eigen::Index>(i);
    Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(std::ssize(rows.starts) - 1, std::ssize(held));
    for (Eigen::Index p = 0; p < weights.rows(); ++p)
        for (std::uint32_t e = rows.starts[p]; e < rows.starts[p + 1]; ++e)
            weights(p, column[rows.points[e]]) = rows.weights[e];
    return weights;
}

WeightRows sparse(const Eigen::MatrixXd& weights, std::span<const HeldPlace> held) {
    WeightRows rows;
    for (Eigen::Index p = 0; p < weights.rows(); ++p) {
        for (std::size_t i = 0; i < held.size(); ++i) {
            const double weight = weights(p, static_cast<Eigen::Index>(i));
            if (weight < smallest_weight) continue;
            rows.points.push_back(held[i].point);
            rows.weights.push_back(weight);
        }
        rows.starts.push_back(static_cast<std::uint32_t>(rows.points.size()));
    }
    return rows;
}

}  // namespace

WeightRows smooth_weights(const WeightRows& rows, const Mesh& mesh, const Weld& weld, const std::vector<bool>& solved,
                          std::span<const HeldPlace> held, double length) {
    const Laplacian surface = laplacian(mesh, weld, Cotangents::positive);
    const std::vector<std::uint32_t> free = free_places(solved, held);
    Eigen::MatrixXd weights = dense(rows, held);
    const Eigen::MatrixXd moved = surface.areas.asDiagonal() * weights;
    for (const std::uint32_t p : free) weights.row(p).setZero();

    // (M + t L) W' = M W on the free places, with what is held on the right side.
    Eigen::SparseMatrix<double> step = length * length * surface.stiffness;
    const Eigen::MatrixXd right = moved - step * weights;
    step += Eigen::SparseMatrix<double>(surface.areas.asDiagonal());
    const Eigen::SparseMatrix<double> pick = picks(step.rows(), free);
    weights += pick * solve_checked(pick.transpose() * step * pick, pick.transpose() * right, "surface distance rig");
    return sparse(weights, held);
}

}  // namespace mien
