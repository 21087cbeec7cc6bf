// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/movers.hpp"

namespace mien {

/// One kept entry of a row of weights.
struct KeptWeight {
    std::uint32_t column = 0;
    double weight = 0;
};

/// The row cut to `keep` weights, refitted so that the motion changes least when the points move with covariance
/// `covariance` (symmetric, positive definite, columns x columns): solves C_KK w' = (C w)_K for the kept columns K.
/// From the three times as many largest weights those are left out one by one that are missed least. Columns ascend.
/// Keeping all or more gives the row itself, without zeros.
std::vector<KeptWeight> refit_row(const Eigen::VectorXd& row, const Eigen::MatrixXd& covariance, std::uint32_t keep);

/// The covariance under which motions of little energy are likely, for an energy of the movers' positions (symmetric,
/// positive semidefinite, columns x columns). An energy that is singular, because shifts cost nothing, is helped by a
/// little of the identity: its inverse still gives shifts by far the largest variance.
Eigen::MatrixXd covariance_of(const Eigen::MatrixXd& energy);

/// The rows of all places: {1} at a mover; at `places` (none of them a mover's) the row of `weights` cut to
/// `influences` entries by `refit_row`, 0 for all; nothing elsewhere. `weights`: places x movers.
WeightRows refit_rows(std::size_t place_count, const Movers& movers, std::span<const std::uint32_t> places,
                      const Eigen::MatrixXd& weights, const Eigen::MatrixXd& covariance, std::uint32_t influences);

}  // namespace mien
