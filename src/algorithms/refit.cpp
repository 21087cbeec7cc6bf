// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "algorithms/refit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <tbb/parallel_for.h>

namespace mien {

namespace {

constexpr double smallest_weight = 1e-7;
constexpr double tie = 1e-5;  // of the largest weight

// Weights that tie with the largest one left out go too, so that neither the order of the points nor rounding chooses
// between them: a place on the midline drops both of a pair.
std::vector<std::uint32_t> largest_columns(const Eigen::VectorXd& row, std::uint32_t keep) {
    std::vector<std::uint32_t> columns;
    for (std::uint32_t c = 0; c < row.size(); ++c)
        if (std::abs(row[c]) > smallest_weight) columns.push_back(c);
    if (columns.size() <= keep) return columns;
    std::stable_sort(columns.begin(), columns.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return std::abs(row[a]) > std::abs(row[b]); });
    const double left_out = std::abs(row[columns[keep]]) + tie * std::abs(row[columns[0]]);
    const auto tied = std::find_if(columns.begin(), columns.begin() + keep,
                                   [&](std::uint32_t c) { return std::abs(row[c]) <= left_out; });
    columns.erase(tied == columns.begin() ? columns.begin() + keep : tied, columns.end());
    std::sort(columns.begin(), columns.end());
    return columns;
}

}  // namespace

std::vector<KeptWeight> refit_row(const Eigen::VectorXd& row, const Eigen::MatrixXd& covariance, std::uint32_t keep) {
    const std::vector<std::uint32_t> columns = largest_columns(row, keep);
    const auto n = std::ssize(columns);
    const bool is_cut = n < (row.array().abs() > smallest_weight).count();
    Eigen::VectorXd weights(n);
    for (Eigen::Index i = 0; i < n; ++i) weights[i] = row[columns[i]];
    if (is_cut) {
        const Eigen::MatrixXd among = covariance(columns, columns);
        const Eigen::VectorXd with_row = covariance(columns, Eigen::all) * row;
        weights = among.ldlt().solve(with_row);
    }
    std::vector<KeptWeight> kept;
    for (Eigen::Index i = 0; i < n; ++i) kept.push_back({columns[i], weights[i]});
    return kept;
}

Eigen::MatrixXd covariance_of(const Eigen::MatrixXd& energy) {
    const Eigen::Index n = energy.rows();
    const Eigen::MatrixXd regular =
        (energy + energy.transpose()) / 2 + 1e-6 * energy.diagonal().mean() * Eigen::MatrixXd::Identity(n, n);
    return regular.ldlt().solve(Eigen::MatrixXd::Identity(n, n));
}

WeightRows refit_rows(std::size_t place_count, const Movers& movers, std::span<const std::uint32_t> places,
                      const Eigen::MatrixXd& weights, const Eigen::MatrixXd& covariance, std::uint32_t influences) {
    const auto keep = influences == 0 ? static_cast<std::uint32_t>(movers.points.size()) : influences;
    std::vector<std::vector<KeptWeight>> kept(place_count);
    tbb::parallel_for(std::size_t{0}, places.size(), [&](std::size_t i) {
        kept[places[i]] = refit_row(weights.row(static_cast<Eigen::Index>(i)).transpose(), covariance, keep);
    });
    for (std::uint32_t m = 0; m < movers.places.size(); ++m) kept[movers.places[m]] = {{m, 1}};
    WeightRows rows;
    for (const auto& row : kept) {
        for (const KeptWeight& entry : row) {
            rows.points.push_back(movers.points[entry.column]);
            rows.weights.push_back(entry.weight);
        }
        rows.starts.push_back(static_cast<std::uint32_t>(rows.points.size()));
    }
    return rows;
}

}  // namespace mien
