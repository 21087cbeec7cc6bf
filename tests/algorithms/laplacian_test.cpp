// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "algorithms/laplacian.hpp"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "algorithms/refit.hpp"
#include "algorithms/sparse_solve.hpp"
#include "shapes.hpp"

#include "mien/error.hpp"

namespace mien {
namespace {

Eigen::MatrixXd stiffness(const Mesh& mesh) {
    return Eigen::MatrixXd(laplacian(mesh, weld(mesh)).stiffness);
}

TEST(Laplacian, ARightAngledTriangleHasTheCotangentsOfItsCorners) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    add_face(mesh, std::array{0U, 1U, 2U});
    Eigen::Matrix3d expected;  // cot 90 = 0 across the long side, cot 45 = 1 across the others, halved
    expected << 1, -0.5, -0.5, -0.5, 0.5, 0, -0.5, 0, 0.5;
    EXPECT_LT((stiffness(mesh) - expected).norm(), 1e-12);
}

TEST(Laplacian, VanishesOnConstantsAndIsNowhereNegative) {
    Mesh mesh = shapes::ball({}, 1);
    mesh.positions[5].x += 0.4F;  // obtuse corners
    const Eigen::MatrixXd l = stiffness(mesh);
    EXPECT_LT((l * Eigen::VectorXd::Ones(l.rows())).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_EQ((l - l.transpose()).norm(), 0);
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(l).eigenvalues().minCoeff(), -1e-9);
}

TEST(Laplacian, AreasAddUpToTheSurface) {
    const Mesh mesh = shapes::grid(6, 4, 0.5F);
    EXPECT_NEAR(laplacian(mesh, weld(mesh)).areas.sum(), 6, 1e-6);
}

TEST(Laplacian, TrianglesWithoutAreaStillConnect) {
    Mesh mesh = shapes::grid(1, 1);
    mesh.positions.push_back({0.5F, 0, 0});
    add_face(mesh, std::array{0U, 1U, 4U});
    const Laplacian surface = laplacian(mesh, weld(mesh));
    EXPECT_GT(surface.stiffness.coeff(4, 4), 0);
    EXPECT_GT(surface.areas[4], 0);
    EXPECT_TRUE(surface.stiffness.coeffs().isFinite().all());
}

TEST(SparseSolve, RefusesWhatIsNotPositiveDefinite) {
    Eigen::SparseMatrix<double> matrix(2, 2);
    matrix.insert(0, 0) = 1;
    matrix.insert(1, 1) = -1;
    EXPECT_THROW(solve_checked(matrix, Eigen::MatrixXd::Ones(2, 1), "test"), Error);
}

TEST(SparseSolve, SolvesEveryColumn) {
    Eigen::SparseMatrix<double> matrix(2, 2);
    matrix.insert(0, 0) = 2;
    matrix.insert(1, 0) = 1;
    matrix.insert(0, 1) = 1;
    matrix.insert(1, 1) = 3;
    const Eigen::MatrixXd inverse = solve_checked(matrix, Eigen::MatrixXd::Identity(2, 2), "test");
    Eigen::Matrix2d expected;
    expected << 0.6, -0.2, -0.2, 0.4;
    EXPECT_LT((inverse - expected).norm(), 1e-12);
}

TEST(Refit, IndependentPointsAreSimplyCut) {
    const Eigen::Vector4d row(0.5, -0.3, 0.1, 0.2);
    const auto kept = refit_row(row, Eigen::Matrix4d::Identity(), 2);
    ASSERT_EQ(kept.size(), 2U);
    EXPECT_EQ(kept[0].column, 0U);
    EXPECT_DOUBLE_EQ(kept[0].weight, 0.5);
    EXPECT_EQ(kept[1].column, 1U);
    EXPECT_DOUBLE_EQ(kept[1].weight, -0.3);
}

TEST(Refit, APointThatMovesWithOneLeftOutTakesItsShare) {
    Eigen::Matrix3d together = Eigen::Matrix3d::Identity();
    together(0, 2) = together(2, 0) = 0.999999;
    const auto kept = refit_row(Eigen::Vector3d(0.5, 0.4, 0.25), together, 2);
    ASSERT_EQ(kept.size(), 2U);
    EXPECT_NEAR(kept[0].weight, 0.75, 1e-5);
    EXPECT_NEAR(kept[1].weight, 0.4, 1e-5);
}

TEST(Refit, OfTwoPointsThatMoveTogetherOneIsEnough) {
    Eigen::Matrix3d together = Eigen::Matrix3d::Identity();
    together(0, 1) = together(1, 0) = 0.99;
    const auto kept = refit_row(Eigen::Vector3d(0.5, 0.45, 0.3), together, 2);
    ASSERT_EQ(kept.size(), 2U);
    EXPECT_EQ(kept[0].column, 0U);
    EXPECT_NEAR(kept[0].weight, 0.5 + 0.99 * 0.45, 1e-12);
    EXPECT_EQ(kept[1].column, 2U);
    EXPECT_NEAR(kept[1].weight, 0.3, 1e-12);
}

TEST(Refit, LeavingOutOneByOneIsRefittingWhatIsLeft) {
    Eigen::MatrixXd half(12, 12);
    for (int i = 0; i < 12; ++i)
        for (int j = 0; j < 12; ++j) half(i, j) = std::sin(1.0 + 3.7 * i + 1.9 * j * j) + (i == j ? 2 : 0);
    const Eigen::MatrixXd covariance = half * half.transpose();
    const Eigen::VectorXd row = half.col(3) / 3;
    const auto kept = refit_row(row, covariance, 4);
    ASSERT_EQ(kept.size(), 4U);
    Eigen::VectorXd off = -row;
    for (const KeptWeight& k : kept) off[k.column] += k.weight;
    const Eigen::VectorXd left = covariance * off;
    for (const KeptWeight& k : kept) EXPECT_NEAR(left[k.column], 0, 1e-9 * covariance.norm());
}

TEST(Refit, OfTwoEqualWeightsNeitherIsPreferred) {
    const auto kept = refit_row(Eigen::Vector3d(0.5, 0.25, 0.25), Eigen::Matrix3d::Identity(), 2);
    ASSERT_EQ(kept.size(), 1U);
    EXPECT_EQ(kept[0].column, 0U);
}

TEST(Refit, KeepingAllChangesNothing) {
    const Eigen::Vector3d row(0.5, -0.25, 0.125);
    const auto kept = refit_row(row, Eigen::Matrix3d::Constant(1) + Eigen::Matrix3d::Identity(), 3);
    ASSERT_EQ(kept.size(), 3U);
    for (const KeptWeight& k : kept) EXPECT_EQ(k.weight, row[k.column]);
}

}  // namespace
}  // namespace mien
