// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Retargeting by a radial basis function network: Dutreve et al., section 2, eq. 1-3, and section 4.
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
//
// Section 4 writes T_f = F(S_f). Here a sample goes to t_i + F(s_f) - F(s_i), which is the same number where
// F(s_i) = t_i.

#include "mien/algorithms/retarget.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <utility>

#include "algorithms/rotation.hpp"

#include "mien/error.hpp"

namespace mien {

namespace {

// x -> ratio * rotate(rotation, x - from) + to: the best similarity between two faces.
struct Similarity {
    Vec3 from, to;
    double ratio = 1;
    Quaternion rotation;
};

Vec3 apply(const Similarity& map, const Vec3& p) {
    return map.ratio * rotate(map.rotation, p - map.from) + map.to;
}

// Root mean square distance to the centre; in the picture's plane for a planar source.
double radius(std::vector<Vec3> points, bool planar) {
    if (planar)
        for (Vec3& p : points) p.z = 0;
    const std::array<double, 3> s = spreads(points);
    return std::hypot(s[0], s[1], s[2]) / std::sqrt(static_cast<double>(points.size()));
}

Similarity similarity(const Retarget& map) {
    Similarity result{centre(map.source_neutral), centre(map.target_neutral), 1, {}};
    const double source = radius(map.source_neutral, map.planar);
    const double target = radius(map.target_neutral, map.planar);
    if (source > 0 && target > 0) result.ratio = target / source;
    result.rotation = map.planar ? best_rotation_in_plane(map.source_neutral, map.target_neutral)
                                 : best_rotation(map.source_neutral, map.target_neutral);
    return result;
}

// Ids, s_i and t_i of the points that are on the face and seen in the take, in the face's order.
Retarget shared_points(const Take& take, const Face& face, const NeutralOptions& options) {
    Retarget map;
    map.planar = take.planar;
    const std::vector<Vec3> source = neutral(take, options);
    for (const FeaturePoint& point : face.points) {
        const std::optional<std::size_t> column = find_column(take, point.id);
        if (!column || !is_finite(source[*column])) continue;
        const Vec3 s = source[*column];
        map.points.push_back(point.id);
        map.source_neutral.push_back(take.planar ? Vec3{s.x, s.y, 0} : s);
        map.target_neutral.push_back(point.position);
    }
    if (map.points.empty())
        throw Error(
            fmt::format("retarget: expected feature points that the take and the face share, found none among {} "
                        "columns of the take and {} points of the face; is a marker map missing?",
                        take.points.size(), face.points.size()));
    return map;
}

double box_diagonal(std::span<const Vec3> points) {
    Vec3 low = points[0], high = points[0];
    for (const Vec3& p : points) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    return distance(low, high);
}

// Equal centres make eq. 3 singular, and a solver need not notice: their rows are looked for before.
void refuse_coinciding(const std::vector<std::string>& ids, std::span<const Vec3> points, const char* where) {
    const double nearest = 1e-6 * box_diagonal(points);
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t j = i + 1; j < points.size(); ++j)
            if (!(distance(points[i], points[j]) > nearest))
                throw Error(
                    fmt::format("retarget: expected points at different places, found {} and {} at the same place "
                                "({:g} {:g} {:g}) of the {}; leave one of them out",
                                ids[i], ids[j], points[i].x, points[i].y, points[i].z, where));
}

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
void fit_as_written(Retarget& map) {
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
void fit_with_affine(Retarget& map) {
    const Similarity base = similarity(map);
    const double size = radius(map.source_neutral, map.planar);
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
    const double limit = 1e-6 * box_diagonal(map.target_neutral) + 1e-12 * cancelled;
    if (!(map.residual <= limit))
        throw Error(fmt::format(
            "retarget: expected the map to meet the {} target points within {:g}, found a residual of {:g}; "
            "are some points nearly at the same place?",
            map.points.size(), limit, map.residual));
}

}  // namespace

Retarget fit_retarget(const Take& take, const Face& face, const RetargetOptions& options) {
    Retarget map = shared_points(take, face, options.neutral);
    refuse_coinciding(map.points, map.source_neutral, "take's neutral");
    refuse_coinciding(map.points, map.target_neutral, "face");
    map.scales = centre_scales(map.source_neutral);
    if (options.reading == Reading::paper)
        fit_as_written(map);
    else
        fit_with_affine(map);
    check_residual(map);
    return map;
}

Vec3 retarget(const Retarget& map, const Vec3& p) noexcept {
    const Vec3 s{p.x, p.y, map.planar ? 0 : p.z};
    Vec3 sum = map.offset + s.x * map.columns[0] + s.y * map.columns[1] + s.z * map.columns[2];
    for (std::size_t i = 0; i < map.points.size(); ++i) sum += multiquadric(map, i, s) * map.weights[i];
    return sum;
}

namespace {

std::vector<std::size_t> columns_of(const Retarget& map, const Take& take) {
    std::vector<std::size_t> columns;
    for (const std::string& id : map.points) {
        const std::optional<std::size_t> column = find_column(take, id);
        if (!column)
            throw Error(
                fmt::format("retarget: expected a column {} in the take, as the map was fitted with one; found none "
                            "among its {} columns",
                            id, take.points.size()));
        columns.push_back(*column);
    }
    return columns;
}

// The same motion of the head as the target makes it: back through the similarity, the pose, and forth again.
Pose pose_on_target(const Similarity& map, const Pose& pose) {
    const Quaternion rotation = map.rotation * pose.rotation * conjugate(map.rotation);
    return {rotation, apply(map, apply(pose, map.from)) - rotate(rotation, map.to)};
}

}  // namespace

Take retarget(const Retarget& map, const Take& take) {
    const std::vector<std::size_t> columns = columns_of(map, take);
    std::vector<Vec3> at_rest;
    for (const Vec3& s : map.source_neutral) at_rest.push_back(retarget(map, s));

    Take result{map.points, take.times, {}, {}, {}, false, take.repeated_rows};
    result.samples.reserve(row_count(take) * columns.size());
    for (std::size_t r = 0; r < row_count(take); ++r)
        for (std::size_t i = 0; i < columns.size(); ++i) {
            const Vec3& p = row(take, r)[columns[i]];
            const Vec3 moved = map.target_neutral[i] + (retarget(map, p) - at_rest[i]);
            result.samples.push_back(is_finite(p) ? moved : lost_sample);
        }
    const Similarity base = similarity(map);
    for (const Pose& pose : take.head) result.head.push_back(pose_on_target(base, pose));
    return result;
}

}  // namespace mien
