// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace mien {

/// One kept entry of a row of weights.
struct KeptWeight {
    std::uint32_t column = 0;
    double weight = 0;
};

/// The row cut to its `keep` largest weights, refitted so that the motion changes least when the points move with
/// covariance `covariance` (symmetric, positive definite, columns x columns): solves C_KK w' = (C w)_K for the kept
/// columns K. Columns ascend. Keeping all or more gives the row itself, without zeros.
std::vector<KeptWeight> refit_row(const Eigen::VectorXd& row, const Eigen::MatrixXd& covariance, std::uint32_t keep);

}  // namespace mien
