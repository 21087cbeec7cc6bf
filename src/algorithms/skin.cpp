// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// A rig's signed weights per axis as the skin that engines play: one weight per vertex and joint, none negative, at
// most `influences` joints, sum 1.
//
// Per vertex a quadratic program: with d(r) the displacements of the points in row r of the take and t(r) = L d(r)
// those of the joints (they differ only along constrained axes, rig.hpp), find s >= 0, sum s <= 1 that minimises
//     sum_r |sum_j s_j t_j(r) - sum_k w_k d_k(r)|^2  =  s' C s - 2 s' b + const
// over the points of the vertex's row; the still joint takes 1 - sum s. C and b come from the take's own covariance of
// the points, so weights that always move alike may be traded for each other, plus a small share of a covariance that
// only knows distance: it keeps the weights of points that rest in this take where the rig has them, so that the skin
// serves other takes too. Without a take that share is all there is.
//
// Joints are cut one by one, the one that contributes least first, and the others refitted each time. Taking the four
// heaviest weights and normalising them instead loses more; the tests compare the two.
//
// Non-negative least squares: Lawson and Hanson, Solving Least Squares Problems, chapter 23, on the normal equations.

#include "mien/algorithms/skin.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <limits>
#include <numeric>
#include <span>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <vector>

#include "mien/error.hpp"

namespace mien {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

// Share of the distance-only covariance beside that of the take.
constexpr double prior_share = 1e-3;
// Weights below this are left to the still joint: a millionth of a motion is not seen, a joint slot is.
constexpr double negligible = 1e-6;

// Displacements over the rows of a take, one column of numbers per (point, axis): column 3 k + a.
struct Motion {
    Matrix points;  ///< d
    Matrix joints;  ///< t
};

// Rows that move each point alone by one unit along each axis.
Matrix unit_rows(std::size_t points) {
    return Matrix::Identity(static_cast<Eigen::Index>(3 * points), static_cast<Eigen::Index>(3 * points));
}

Matrix take_rows(const Rig& rig, const Take& take) {
    const TakeBinding binding = bind_take(rig, take);
    Matrix rows(row_count(take), 3 * rig.points.size());
    std::vector<Vec3f> moved(rig.points.size());
    for (std::size_t r = 0; r < row_count(take); ++r) {
        displacements(rig, binding, row(take, r), moved);
        for (std::size_t k = 0; k < moved.size(); ++k) rows.block<1, 3>(r, 3 * k) << moved[k].x, moved[k].y, moved[k].z;
    }
    return rows;
}

// t = L d per axis: the identity, except that a constrained point is carried as its vertex is.
std::array<Matrix, 3> joint_maps(const Rig& rig) {
    const auto n = static_cast<Eigen::Index>(rig.points.size());
    std::array<Matrix, 3> maps{Matrix::Identity(n, n), Matrix::Identity(n, n), Matrix::Identity(n, n)};
    for (Eigen::Index i = 0; i < n; ++i) {
        const FeaturePoint& point = rig.points[i];
        const std::array<bool, 3> moves{point.moves.x, point.moves.y, point.moves.z};
        for (std::size_t a = 0; a < 3; ++a) {
            if (moves[a]) continue;
            maps[a].row(i).setZero();
            for (std::uint32_t e = rig.row_starts[point.vertex]; e < rig.row_starts[point.vertex + 1]; ++e) {
                const Vec3f& w = rig.weights[e];
                maps[a](i, rig.row_points[e]) += std::array{w.x, w.y, w.z}[a];
            }
        }
    }
    return maps;
}

Matrix axis_columns(const Matrix& rows, Eigen::Index axis) {
    Matrix columns(rows.rows(), rows.cols() / 3);
    for (Eigen::Index k = 0; k < columns.cols(); ++k) columns.col(k) = rows.col(3 * k + axis);
    return columns;
}

Motion motion_of(Matrix rows, const std::array<Matrix, 3>& maps) {
    Motion motion{std::move(rows), {}};
    motion.joints.resizeLike(motion.points);
    for (Eigen::Index a = 0; a < 3; ++a) {
        const Matrix moved = axis_columns(motion.points, a) * maps[a].transpose();
        for (Eigen::Index k = 0; k < moved.cols(); ++k) motion.joints.col(3 * k + a) = moved.col(k);
    }
    return motion;
}

// Near points move alike: exp(-distance / eye distance).
Matrix prior_covariance(std::span<const FeaturePoint> points) {
    const double eyes = eye_distance(points);
    const auto n = static_cast<Eigen::Index>(points.size());
    Matrix covariance = Matrix::Identity(n, n);
    if (!(eyes > 0)) return covariance;
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j)
            covariance(i, j) = std::exp(-distance(points[i].position, points[j].position) / eyes);
    return covariance;
}

// What the fit needs to know of the motion: C over the joints, and per axis the covariance of joints with points.
struct Metric {
    Matrix joints;                ///< C = sum_a t_a t_a'
    std::array<Matrix, 3> mixed;  ///< t_a d_a'
};

Metric metric_of(const Rig& rig, const Matrix& rows, const std::array<Matrix, 3>& maps) {
    std::array<Matrix, 3> covariance;
    Vector energy = Vector::Zero(static_cast<Eigen::Index>(rig.points.size()));
    for (Eigen::Index a = 0; a < 3; ++a) {
        const Matrix d = axis_columns(rows, a);
        covariance[a] = d.transpose() * d;
        energy += covariance[a].diagonal();
    }
    const auto moving = (energy.array() > 0).count();
    const double scale = moving > 0 ? energy.sum() / static_cast<double>(moving) : 0;
    const Matrix prior = prior_covariance(rig.points) / 3;
    const auto n = static_cast<Eigen::Index>(rig.points.size());
    Metric metric{Matrix::Zero(n, n), {}};
    for (std::size_t a = 0; a < 3; ++a) {
        covariance[a] = scale > 0 ? Matrix(covariance[a] / scale + prior_share * prior) : prior;
        metric.mixed[a] = maps[a] * covariance[a];
        metric.joints += metric.mixed[a] * maps[a].transpose();
    }
    return metric;
}

// Solves A x = b over the entries of `open`; the others are zero.
Vector solve_open(const Matrix& A, const Vector& b, const std::vector<Eigen::Index>& open) {
    const Matrix part = A(open, open);
    const Vector x = part.ldlt().solve(Vector(b(open)));
    Vector all = Vector::Zero(b.size());
    for (std::size_t i = 0; i < open.size(); ++i) all(open[i]) = x(static_cast<Eigen::Index>(i));
    return all;
}

// Goes from x towards z as far as no entry turns negative, and closes the entries that reach zero.
void step_to_border(Vector& x, const Vector& z, std::vector<Eigen::Index>& open) {
    double share = 1;
    for (const Eigen::Index i : open)
        if (z(i) <= 0) share = std::min(share, x(i) / (x(i) - z(i)));
    x += share * (z - x);
    std::vector<Eigen::Index> left;
    for (const Eigen::Index i : open) {
        const bool stays = x(i) > 1e-12;
        if (stays) left.push_back(i);
        if (!stays) x(i) = 0;
    }
    // Rounding may keep every entry just above zero; the loop must still end.
    if (left.size() == open.size())
        left.erase(std::min_element(left.begin(), left.end(), [&](auto i, auto j) { return z(i) < z(j); }));
    open = std::move(left);
}

Eigen::Index steepest_closed(const Vector& gradient, const std::vector<Eigen::Index>& open, double least) {
    Eigen::Index best = -1;
    for (Eigen::Index i = 0; i < gradient.size(); ++i)
        if (gradient(i) > least && std::find(open.begin(), open.end(), i) == open.end())
            if (best < 0 || gradient(i) > gradient(best)) best = i;
    return best;
}

// x >= 0 that minimises x'Ax - 2x'b.
Vector nonnegative(const Matrix& A, const Vector& b) {
    const double least = 1e-12 * b.cwiseAbs().maxCoeff();
    Vector x = Vector::Zero(b.size());
    std::vector<Eigen::Index> open;
    for (Eigen::Index round = 0; round < 3 * b.size(); ++round) {
        const Eigen::Index entering = steepest_closed(b - A * x, open, least);
        if (entering < 0) break;
        open.push_back(entering);
        Vector z = solve_open(A, b, open);
        while (!open.empty() && (z.array() < 0).any()) {
            step_to_border(x, z, open);
            z = open.empty() ? Vector(Vector::Zero(b.size())) : solve_open(A, b, open);
        }
        x = z;
    }
    return x;
}

enum class Sum { at_most_one, one };

// The same with the sum held; as an equation of great weight, and exact by a last division.
Vector fit_weights(const Matrix& A, const Vector& b, Sum sum) {
    if (sum == Sum::at_most_one) {
        Vector x = nonnegative(A, b);
        if (x.sum() <= 1) return x;
    }
    const double weight = 1e6 * A.diagonal().maxCoeff();
    const Vector x = nonnegative(A.array() + weight, b.array() + weight);
    return x / x.sum();
}

// The fit of one vertex: weights over some of its candidate joints.
struct Fit {
    std::vector<Eigen::Index> joints;  ///< positions in the candidate list, ascending
    Vector weights;                    ///< one per entry of `joints`
    double cost = 0;                   ///< s'Cs - 2s'b
};

Fit fit_some(const Matrix& C, const Vector& b, std::vector<Eigen::Index> candidates, Sum sum) {
    const Vector x = fit_weights(C(candidates, candidates), b(candidates), sum);
    std::vector<Eigen::Index> used;
    for (Eigen::Index i = 0; i < x.size(); ++i)
        if (x(i) > negligible) used.push_back(i);
    const Vector s = x(used);
    for (Eigen::Index& i : used) i = candidates[i];
    const double cost = s.dot(C(used, used) * s) - 2 * s.dot(Vector(b(used)));
    return {std::move(used), s, cost};
}

// Drops the joint that contributes least, refits, and so on.
Fit cut_to(Fit fit, std::size_t joints, const Matrix& C, const Vector& b, Sum sum) {
    while (fit.joints.size() > joints) {
        Eigen::Index least = 0;
        double smallest = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < fit.joints.size(); ++i) {
            const double s = fit.weights(static_cast<Eigen::Index>(i));
            const double contribution = s * s * C(fit.joints[i], fit.joints[i]);
            if (contribution < smallest) least = static_cast<Eigen::Index>(i);
            smallest = std::min(smallest, contribution);
        }
        fit.joints.erase(fit.joints.begin() + least);
        fit = fit_some(C, b, std::move(fit.joints), sum);
    }
    return fit;
}

// The still joint takes a slot unless the others sum to one: the better of both ways is kept.
Fit fit_vertex(const Matrix& C, const Vector& b, std::size_t influences) {
    std::vector<Eigen::Index> all(static_cast<std::size_t>(b.size()));
    std::iota(all.begin(), all.end(), 0);
    Fit free = fit_some(C, b, all, Sum::at_most_one);
    if (free.joints.size() < influences) return free;
    const Fit with_still = cut_to(free, influences - 1, C, b, Sum::at_most_one);
    Fit without = cut_to(free, influences, C, b, Sum::one);
    without = fit_some(C, b, without.joints, Sum::one);
    return with_still.cost <= without.cost ? with_still : without;
}

struct Influence {
    std::uint16_t joint;
    float weight;
};

// Rounds to float so that the weights sum to one again: the still joint or else the heaviest takes the difference.
std::vector<Influence> rounded(std::vector<Influence> influences, std::uint16_t still) {
    double sum = 0;
    for (const Influence& i : influences) sum += i.weight;
    if (1 - sum > negligible) influences.push_back({still, static_cast<float>(1 - sum)});
    std::stable_sort(influences.begin(), influences.end(),
                     [](const Influence& a, const Influence& b) { return a.weight > b.weight; });
    if (std::abs(1 - sum) <= negligible)
        influences.front().weight = static_cast<float>(influences.front().weight + (1 - sum));
    return influences;
}

// A vertex's row of the rig.
struct Row {
    std::span<const std::uint16_t> points;
    std::span<const Vec3f> weights;
};

Row row_of(const Rig& rig, std::size_t vertex) {
    const std::size_t first = rig.row_starts[vertex], count = rig.row_starts[vertex + 1] - first;
    return {std::span(rig.row_points).subspan(first, count), std::span(rig.weights).subspan(first, count)};
}

std::vector<Influence> influences_of(const Row& row, const Metric& metric, std::size_t influences,
                                     std::uint16_t still) {
    std::vector<Influence> result;
    if (!row.points.empty()) {
        const std::vector<Eigen::Index> candidates(row.points.begin(), row.points.end());
        Vector b = Vector::Zero(static_cast<Eigen::Index>(candidates.size()));
        for (std::size_t k = 0; k < candidates.size(); ++k) {
            const std::array<float, 3> w{row.weights[k].x, row.weights[k].y, row.weights[k].z};
            for (std::size_t a = 0; a < 3; ++a) b += w[a] * metric.mixed[a](candidates, candidates[k]);
        }
        const Fit fit = fit_vertex(metric.joints(candidates, candidates), b, influences);
        for (std::size_t i = 0; i < fit.joints.size(); ++i)
            result.push_back(
                {row.points[fit.joints[i]], static_cast<float>(fit.weights(static_cast<Eigen::Index>(i)))});
    }
    return rounded(std::move(result), still);
}

// The eyeball of each vertex, or -1.
std::vector<std::int32_t> eyeball_of_vertices(const Rig& rig) {
    std::vector<std::int32_t> eyeballs(vertex_count(rig), -1);
    for (std::size_t e = 0; e < rig.eyeballs.size(); ++e)
        for (const std::uint32_t v : rig.eyeballs[e].vertices) eyeballs[v] = static_cast<std::int32_t>(e);
    return eyeballs;
}

// Squared distance between skin and rig at one vertex, one entry per row.
Vector squared_errors(const Row& row, std::span<const std::uint16_t> joints, std::span<const float> weights,
                      const Motion& motion) {
    Vector squared = Vector::Zero(motion.points.rows());
    Vector error(motion.points.rows());
    const std::size_t still = static_cast<std::size_t>(motion.points.cols()) / 3;
    for (Eigen::Index a = 0; a < 3; ++a) {
        error.setZero();
        for (std::size_t k = 0; k < row.points.size(); ++k) {
            const Vec3f& w = row.weights[k];
            error += double{std::array{w.x, w.y, w.z}[a]} * motion.points.col(3 * Eigen::Index{row.points[k]} + a);
        }
        for (std::size_t j = 0; j < joints.size(); ++j)
            if (joints[j] < still) error -= double{weights[j]} * motion.joints.col(3 * Eigen::Index{joints[j]} + a);
        squared += error.cwiseAbs2();
    }
    return squared;
}

// Eyeballs hang on their joint alone and are exact.
void measure(Skin& skin, const Rig& rig, const Motion& motion, std::span<const std::int32_t> eyeballs) {
    const std::size_t n = vertex_count(rig);
    std::vector<double> sums(n), largest(n);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n), [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t v = range.begin(); v < range.end(); ++v) {
            if (eyeballs[v] >= 0 || row_of(rig, v).points.empty()) continue;
            const Vector squared =
                squared_errors(row_of(rig, v), std::span(skin.joints).subspan(v * skin.influences, skin.influences),
                               std::span(skin.weights).subspan(v * skin.influences, skin.influences), motion);
            sums[v] = squared.sum();
            largest[v] = squared.maxCoeff();
        }
    });
    const double count = static_cast<double>(n) * static_cast<double>(motion.points.rows());
    skin.mean_error = count > 0 ? std::sqrt(std::accumulate(sums.begin(), sums.end(), 0.0) / count) : 0;
    skin.max_error = n > 0 ? std::sqrt(*std::max_element(largest.begin(), largest.end())) : 0;
}

void check(const Rig& rig, const SkinOptions& options) {
    if (options.influences < 4 || options.influences > 16 || options.influences % 4 != 0)
        throw Error(fmt::format("skin influences: expected 4, 8, 12 or 16, found {}", options.influences));
    if (joint_count(rig) > std::numeric_limits<std::uint16_t>::max())
        throw Error(fmt::format("skin: expected at most 65535 joints, found {}", joint_count(rig)));
}

}  // namespace

Skin make_skin(const Rig& rig, const Take& take, const SkinOptions& options) {
    check(rig, options);
    const std::array<Matrix, 3> maps = joint_maps(rig);
    Matrix rows = take_rows(rig, take);
    const Metric metric = metric_of(rig, rows, maps);
    if (rows.rows() == 0) rows = unit_rows(rig.points.size());
    const Motion motion = motion_of(std::move(rows), maps);

    const std::size_t n = vertex_count(rig);
    const auto still = static_cast<std::uint16_t>(rig.points.size());
    const std::vector<std::int32_t> eyeballs = eyeball_of_vertices(rig);
    Skin skin{options.influences, std::vector<std::uint16_t>(n * options.influences),
              std::vector<float>(n * options.influences), 0, 0};
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n), [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t v = range.begin(); v < range.end(); ++v) {
            const std::vector<Influence> influences =
                eyeballs[v] >= 0 ? std::vector<Influence>{{static_cast<std::uint16_t>(still + 1 + eyeballs[v]), 1.0F}}
                                 : influences_of(row_of(rig, v), metric, options.influences, still);
            for (std::size_t i = 0; i < influences.size(); ++i) {
                skin.joints[v * options.influences + i] = influences[i].joint;
                skin.weights[v * options.influences + i] = influences[i].weight;
            }
        }
    });
    measure(skin, rig, motion, eyeballs);
    return skin;
}

}  // namespace mien
