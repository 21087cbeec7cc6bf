// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Best turns between point sets: the orthogonal Procrustes problem solved through a singular value decomposition
// (Kabsch 1976, Horn 1987), with the sign that keeps a mirror image out.

#include "algorithms/rotation.hpp"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <cmath>

namespace mien {

namespace {

using Svd = Eigen::JacobiSVD<Eigen::Matrix3d>;

Eigen::Vector3d eigen(const Vec3& v) {
    return {v.x, v.y, v.z};
}

Quaternion quaternion(const Eigen::Quaterniond& q) {
    const Eigen::Quaterniond unit = q.normalized();
    const double sign = unit.w() < 0 ? -1 : 1;
    return {sign * unit.x(), sign * unit.y(), sign * unit.z(), sign * unit.w()};
}

// Sum of b a^T over the pairs, each seen from its centre.
Eigen::Matrix3d covariance(std::span<const Vec3> a, std::span<const Vec3> b) {
    const Vec3 centre_a = centre(a);
    const Vec3 centre_b = centre(b);
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (std::size_t i = 0; i < a.size(); ++i) sum += eigen(b[i] - centre_b) * eigen(a[i] - centre_a).transpose();
    return sum;
}

Eigen::Matrix3d without_mirror(const Svd& svd) {
    const Eigen::Matrix3d product = svd.matrixU() * svd.matrixV().transpose();
    const Eigen::Vector3d signs(1, 1, product.determinant() < 0 ? -1 : 1);
    return svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
}

}  // namespace

Vec3 centre(std::span<const Vec3> points) {
    Vec3 sum;
    for (const Vec3& p : points) sum += p;
    return points.empty() ? sum : sum / static_cast<double>(points.size());
}

std::array<double, 3> spreads(std::span<const Vec3> points) {
    const Eigen::Vector3d squares = Svd(covariance(points, points)).singularValues();
    return {std::sqrt(squares[0]), std::sqrt(squares[1]), std::sqrt(squares[2])};
}

Quaternion best_rotation(std::span<const Vec3> from, std::span<const Vec3> to) {
    const Svd svd(covariance(from, to), Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Eigen::Vector3d& s = svd.singularValues();
    if (!(s[0] > 0)) return {};
    if (s[1] > 1e-12 * s[0]) return quaternion(Eigen::Quaterniond(without_mirror(svd)));
    return quaternion(Eigen::Quaterniond::FromTwoVectors(svd.matrixV().col(0), svd.matrixU().col(0)));
}

Quaternion best_rotation_in_plane(std::span<const Vec3> from, std::span<const Vec3> to) {
    const Eigen::Matrix3d c = covariance(from, to);
    const double angle = std::atan2(c(1, 0) - c(0, 1), c(0, 0) + c(1, 1));
    return {0, 0, std::sin(angle / 2), std::cos(angle / 2)};
}

Quaternion nearest_rotation(const std::array<Vec3, 3>& columns) {
    Eigen::Matrix3d m;
    for (int i = 0; i < 3; ++i) m.col(i) = eigen(columns[static_cast<std::size_t>(i)]);
    return quaternion(Eigen::Quaterniond(without_mirror(Svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV))));
}

}  // namespace mien
