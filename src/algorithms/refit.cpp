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
constexpr double tie = 1e-5;            // of the largest weight, and of the least loss
constexpr std::uint32_t looked_at = 3;  // times the weights that are kept

using Columns = std::vector<std::uint32_t>;

// Weights that tie with the largest one left out go too, so that neither the order of the points nor rounding chooses
// between them: a place on the midline drops both of a pair.
Columns largest_columns(const Eigen::VectorXd& row, std::uint32_t keep) {
    Columns columns;
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

// A row over some columns, refitted: w' = C_KK^-1 (C w)_K.
struct Refit {
    Columns columns;            // ascending
    Eigen::MatrixXd precision;  // C_KK^-1
    Eigen::VectorXd weights;
};

Refit refit(const Eigen::VectorXd& row, const Eigen::MatrixXd& covariance, Columns columns) {
    const auto n = std::ssize(columns);
    const Eigen::LDLT<Eigen::MatrixXd> among(covariance(columns, columns));
    const Eigen::VectorXd with_row = covariance(columns, Eigen::all) * row;
    return {std::move(columns), among.solve(Eigen::MatrixXd::Identity(n, n)), among.solve(with_row)};
}

// Leaves column i out, the others refitted: its weight becomes 0, and so do its rows of the precision.
void leave_out(Refit& fit, Eigen::Index i) {
    const Eigen::VectorXd share = fit.precision.col(i) / fit.precision(i, i);
    fit.weights -= fit.weights[i] * share;
    fit.precision -= share * fit.precision.row(i).eval();
    fit.weights[i] = 0;
    fit.precision.row(i).setZero();
    fit.precision.col(i).setZero();
}

// Leaves out the column without which the motion changes least, |w_i| / sqrt((C_KK^-1)_ii), and those that tie with it,
// until few enough are left.
void cut_to(Refit& fit, std::uint32_t keep) {
    std::vector<Eigen::Index> in(fit.columns.size());
    std::iota(in.begin(), in.end(), 0);
    while (in.size() > keep) {
        Eigen::VectorXd loss(std::ssize(in));
        for (std::size_t i = 0; i < in.size(); ++i)
            loss[static_cast<Eigen::Index>(i)] = std::abs(fit.weights[in[i]]) / std::sqrt(fit.precision(in[i], in[i]));
        const double least = loss.minCoeff() + tie * loss.maxCoeff();
        std::vector<Eigen::Index> rest;
        for (std::size_t i = 0; i < in.size(); ++i)
            if (loss[static_cast<Eigen::Index>(i)] > least) rest.push_back(in[i]);
        if (rest.empty()) rest.assign(in.begin(), in.begin() + keep);  // all alike
        for (const Eigen::Index i : in)
            if (!std::binary_search(rest.begin(), rest.end(), i)) leave_out(fit, i);
        in = std::move(rest);
    }
    Columns kept;
    for (const Eigen::Index i : in) kept.push_back(fit.columns[static_cast<std::size_t>(i)]);
    fit.columns = std::move(kept);
    fit.weights = fit.weights(in).eval();
}

}  // namespace

std::vector<KeptWeight> refit_row(const Eigen::VectorXd& row, const Eigen::MatrixXd& covariance, std::uint32_t keep) {
    std::vector<KeptWeight> kept;
    Columns columns = largest_columns(row, looked_at * keep);
    const bool is_cut = std::ssize(columns) < (row.array().abs() > smallest_weight).count();
    if (is_cut || columns.size() > keep) {
        Refit fit = refit(row, covariance, std::move(columns));
        cut_to(fit, keep);
        for (std::size_t i = 0; i < fit.columns.size(); ++i)
            kept.push_back({fit.columns[i], fit.weights[static_cast<Eigen::Index>(i)]});
        return kept;
    }
    for (const std::uint32_t c : columns) kept.push_back({c, row[c]});
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
