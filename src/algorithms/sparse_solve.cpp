// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Supernodal Cholesky of CHOLMOD in METIS order: for a sheet of 180,000 places seven times faster than the simplicial
// one of Eigen, and for larger ones the gap widens.

#include "algorithms/sparse_solve.hpp"

#include <Eigen/CholmodSupport>
#include <fmt/format.h>

#include "mien/error.hpp"

namespace mien {

namespace {

constexpr double largest_residual = 1e-8;

double scaled_residual(const Eigen::SparseMatrix<double>& matrix, const Eigen::MatrixXd& x,
                       const Eigen::MatrixXd& right) {
    const Eigen::MatrixXd terms = matrix.cwiseAbs() * x.cwiseAbs() + right.cwiseAbs();
    const double largest = terms.size() > 0 ? terms.maxCoeff() : 0;
    return largest > 0 ? (matrix * x - right).cwiseAbs().maxCoeff() / largest : 0;
}

}  // namespace

Eigen::MatrixXd solve_checked(const Eigen::SparseMatrix<double>& matrix, const Eigen::MatrixXd& right,
                              std::string_view what) {
    if (matrix.rows() == 0 || right.cols() == 0) return Eigen::MatrixXd::Zero(matrix.rows(), right.cols());
    Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>> solver;
    solver.cholmod().nmethods = 1;
    solver.cholmod().method[0].ordering = CHOLMOD_METIS;
    solver.cholmod().postorder = 1;
    solver.cholmod().print = 0;
    solver.compute(matrix);
    if (solver.info() != Eigen::Success)
        throw Error(
            fmt::format("{}: expected a positive definite system, found one that is not; the mesh may have "
                        "faces without area or coordinates of very different sizes",
                        what));
    Eigen::MatrixXd x = solver.solve(right);
    const double residual = scaled_residual(matrix, x, right);
    if (!(residual <= largest_residual))
        throw Error(
            fmt::format("{}: expected a residual of at most {}, found {:.3g}", what, largest_residual, residual));
    return x;
}

Eigen::SparseMatrix<double> picks(Eigen::Index rows, std::span<const std::uint32_t> picked) {
    Eigen::SparseMatrix<double> pick(rows, std::ssize(picked));
    pick.reserve(Eigen::VectorXi::Constant(std::ssize(picked), 1));
    for (Eigen::Index i = 0; i < std::ssize(picked); ++i) pick.insert(picked[static_cast<std::size_t>(i)], i) = 1;
    return pick;
}

}  // namespace mien
