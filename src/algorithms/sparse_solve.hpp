// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <Eigen/SparseCore>
#include <string_view>

namespace mien {

/// Solves `matrix` X = `right` for a symmetric positive definite matrix, all columns with one factorisation. The result
/// does not depend on the number of threads. Throws Error beginning with `what` when the matrix is not positive
/// definite or the residual exceeds 1e-8 of what the terms of a row add up to.
Eigen::MatrixXd solve_checked(const Eigen::SparseMatrix<double>& matrix, const Eigen::MatrixXd& right,
                              std::string_view what);

}  // namespace mien
