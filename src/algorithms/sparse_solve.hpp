// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <Eigen/SparseCore>
#include <cstdint>
#include <span>
#include <string_view>

namespace mien {

/// Solves `matrix` X = `right` for a symmetric positive definite matrix, all columns with one factorisation. The result
/// does not depend on the number of threads. Throws Error beginning with `what` when the matrix is not positive
/// definite or the residual exceeds 1e-8 of what the terms of a row add up to.
Eigen::MatrixXd solve_checked(const Eigen::SparseMatrix<double>& matrix, const Eigen::MatrixXd& right,
                              std::string_view what);

/// The matrix that picks rows: `rows` x picked, so that P' A P is the block of A of the picked rows and columns.
Eigen::SparseMatrix<double> picks(Eigen::Index rows, std::span<const std::uint32_t> picked);

}  // namespace mien
