// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Retargeting by a radial basis function network: Dutreve et al., section 2, eq. 1-3.
//
// Eq. 1 sums over the centres i but writes the scale with the index j of the evaluated point. It is read here as the
// scale of the centre, sc_i = distance of s_i to the nearest other centre: only so F is a map of space that can be
// applied to points that move. A single point has no other centre; its scale is taken as 1.
//
// Paper's reading: t = F(s) = sum_i w_i sqrt(|s - s_i|^2 + sc_i^2), nothing else. Remedied: the same network with an
// affine term, so that a face maps to itself and the target's origin does not matter. It is fitted to what the best
// similarity between the two neutral faces leaves over, with an affine term only in the directions in which the source
// points spread. Where they spread in all three, that is the usual interpolant with side conditions sum w_i = 0, sum
// w_i s_i = 0; for flat sets the direction without points follows the similarity instead of an arbitrary slope.

#include "algorithms/retarget_rbf.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <span>

#include "algorithms/similarity.hpp"

#include "mien/algorithms/retarget.hpp"
#include "mien/error.hpp"
#include "mien/mesh.hpp"

namespace mien {

namespace {

// sc_i: distance to the nearest other centre.
std::vector<double> centre_scales(std::span<const Vec3> centres) {
    std::vector<double> scales(centres.size(), 1);
    for (std::size_t i = 0; i < centres.size(); ++i) {
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t j = 0; j < centres.size(); ++j)
            if (j != i) nearest = std::min(nearest, distance(centres[i], centres[j]));
        if (centres.size() > 1) scales[i] = nearest;
    }
    return scales;
}

// h of eq. 1 for centre i.
double multiquadric(const Retarget& map, std::size_t i, const Vec3& p) {
    const Vec3 d = p - map.source_neutral[i];
    return std::sqrt(dot(d, d) + map.scales[i] * map.scales[i]);
}

// H of eq. 3, one row per evaluated point, in units of `length`.
Eigen::MatrixXd kernel_matrix(const Retarget& map, double length) {
    const auto n = static_cast<Eigen::Index>(map.points.size());
    Eigen::MatrixXd h(n, n);
    for (Eigen::Index j = 0; j < n; ++j)
        for (Eigen::Index i = 0; i < n; ++i)
            h(j, i) = multiquadric(map, static_cast<std::size_t>(i), map.source_neutral[static_cast<std::size_t>(j)]) /
                      length;
    return h;
}

Eigen::RowVector3d eigen(const Vec3& v) {
    return {v.x, v.y, v.z};
}
Vec3 vec(const Eigen::RowVector3d& v) {
    return {v[0], v[1], v[2]};
}

// Eq. 3 as written: H W = T, one column per axis.
void solve_as_written(Retarget& map) {
    Eigen::MatrixXd t(map.points.size(), 3);
    for (std::size_t i = 0; i < map.points.size(); ++i)
        t.row(static_cast<Eigen::Index>(i)) = eigen(map.target_neutral[i]);
    const Eigen::MatrixXd w = kernel_matrix(map, 1).colPivHouseholderQr().solve(t);
    for (Eigen::Index i = 0; i < w.rows(); ++i) map.weights.push_back(vec(w.row(i)));
}

// Directions in which the source points spread, as columns; none for a single point.
Eigen::MatrixXd principal_axes(const Retarget& map, const Similarity& base) {
    Eigen::MatrixXd s(map.points.size(), 3);
    for (std::size_t i = 0; i < map.points.size(); ++i)
        s.row(static_cast<Eigen::Index>(i)) = eigen(map.source_neutral[i] - base.from);
    Eigen::JacobiSVD<Eigen::MatrixXd> svd(s, Eigen::ComputeThinU | Eigen::ComputeThinV);
    svd.setThreshold(1e-6);
    return svd.singularValues()[0] > 0 ? Eigen::MatrixXd(svd.matrixV().leftCols(svd.rank())) : Eigen::MatrixXd(3, 0);
}

// a and A of the base similarity plus `slope` (3 x 3, acting on row vectors p - base.from) and `constant`.
void set_affine(Retarget& map, const Similarity& base, const Eigen::Matrix3d& slope, const Vec3& constant) {
    const std::array<Vec3, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    for (std::size_t k = 0; k < 3; ++k)
        map.columns[k] = base.ratio * rotate(base.rotation, axes[k]) + vec(slope.row(static_cast<Eigen::Index>(k)));
    const Vec3& c = base.from;
    map.offset = base.to + constant - (c.x * map.columns[0] + c.y * map.columns[1] + c.z * map.columns[2]);
}

// [H P; P^T 0] [W; A] = [T - base(S); 0] with P = (1, s along the principal axes), in units of the source's radius.
void solve_with_affine(Retarget& map) {
    const Similarity base = best_similarity(map);
    const double size = source_radius(map);
    const double length = size > 0 ? size : 1;
    const Eigen::MatrixXd axes = principal_axes(map, base);
    const auto n = static_cast<Eigen::Index>(map.points.size());
    const Eigen::Index all = n + 1 + axes.cols();
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(all, all);
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(all, 3);
    system.topLeftCorner(n, n) = kernel_matrix(map, length);
    for (Eigen::Index i = 0; i < n; ++i) {
        const auto k = static_cast<std::size_t>(i);
        system(i, n) = 1;
        system.row(i).tail(axes.cols()) = eigen(map.source_neutral[k] - base.from) * axes / length;
        right.row(i) = eigen(map.target_neutral[k] - apply(base, map.source_neutral[k]));
    }
    system.bottomLeftCorner(1 + axes.cols(), n) = system.topRightCorner(n, 1 + axes.cols()).transpose();
    const Eigen::MatrixXd x = system.completeOrthogonalDecomposition().solve(right);
    for (Eigen::Index i = 0; i < n; ++i) map.weights.push_back(vec(x.row(i)) / length);
    set_affine(map, base, axes * x.bottomRows(axes.cols()) / length, vec(x.row(n)));
}

void check_residual(Retarget& map) {
    double cancelled = length(map.offset);
    for (std::size_t i = 0; i < map.points.size(); ++i) {
        const double miss = distance(retarget(map, map.source_neutral[i]), map.target_neutral[i]);
        if (!(miss <= map.residual)) map.residual = miss;
        cancelled = std::max(cancelled, length(map.target_neutral[i]));
    }
    // What coordinates far from the origin lose by rounding is not the solver's.
    const double limit = 1e-6 * diagonal(bounding_box(map.target_neutral)) + 1e-12 * cancelled;
    if (!(map.residual <= limit))
        throw Error(fmt::format(
            "retarget: expected the map to meet the {} target points within {:g}, found a residual of {:g}; "
            "are some points nearly at the same place?",
            map.points.size(), limit, map.residual));
}

}  // namespace

void fit_as_written(Retarget& map) {
    map.scales = centre_scales(map.source_neutral);
    solve_as_written(map);
    check_residual(map);
}

void fit_with_affine(Retarget& map) {
    map.scales = centre_scales(map.source_neutral);
    solve_with_affine(map);
    check_residual(map);
}

Vec3 retarget(const Retarget& map, const Vec3& p) noexcept {
    const Vec3 s{p.x, p.y, map.planar ? 0 : p.z};
    Vec3 sum = map.offset + s.x * map.columns[0] + s.y * map.columns[1] + s.z * map.columns[2];
    for (std::size_t i = 0; i < map.weights.size(); ++i) sum += multiquadric(map, i, s) * map.weights[i];
    return sum;
}

}  // namespace mien
