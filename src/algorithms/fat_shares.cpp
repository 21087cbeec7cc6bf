// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Which parameter moved a vertex how far, when several moved at once. Laftsidis et al., section 2.2, leave that to
// growth over the mesh; here it is a least-squares problem with one row per frame. For a vertex with displacements y
// and the courses X of all intervals the shares w minimise
//
//     |y - X w|^2 / frames  +  sum_k lambda_k |w_k - e_k|^2,
//
// e_k what the default rig does with the parameter's point and lambda_k growing with the distance of the vertex from
// it. Where the animation tells the parameters apart the first term decides; where it does not, the second. Shares too
// small to be seen are dropped and the rest is fitted again.

#include "algorithms/fat_shares.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tbb/parallel_for.h>

namespace mien {

namespace {

constexpr double infinite = 1e12;

// The pull: of a share near the parameter's point, how much more of one at `near` eye distances from it, and where it
// grows no more. On real heads larger pulls cost accuracy and smaller ones let shares wander
// (docs/papers/laftsidis.md).
constexpr double pull_here = 1e-6, pull_away = 30, near = 0.25, farthest = 8;

using Index = Eigen::Index;

// The finest intervals that a parameter may get: bent at 0 and halfway to its largest value on either side.
std::vector<Interval> finest(const FapColumns& columns) {
    std::vector<Interval> intervals;
    for (std::size_t k = 0; k < columns.faps.size(); ++k) {
        const auto values = columns.values.col(static_cast<Index>(k));
        const double low = values.minCoeff(), high = values.maxCoeff();
        const double half_low = std::trunc(low / 2), half_high = std::trunc(high / 2);
        if (low < 0) {
            if (half_low < 0) intervals.push_back({k, -infinite, half_low});
            intervals.push_back({k, half_low < 0 ? half_low : -infinite, 0});
        }
        if (high > 0) {
            intervals.push_back({k, 0, half_high > 0 ? half_high : infinite});
            if (half_high > 0) intervals.push_back({k, half_high, infinite});
        }
    }
    return intervals;
}

Eigen::MatrixXd courses(const FapColumns& columns, std::span<const Interval> intervals) {
    Eigen::MatrixXd result(columns.values.rows(), static_cast<Index>(intervals.size()));
    for (std::size_t i = 0; i < intervals.size(); ++i)
        for (Index r = 0; r < result.rows(); ++r)
            result(r, static_cast<Index>(i)) =
                piece(columns.values(r, static_cast<Index>(intervals[i].column)), intervals[i].low, intervals[i].high);
    return result;
}

// Sums over all frames, a few at a time.
Eigen::MatrixXd sum_right(const MeshSequence& sequence, const FapColumns& columns, const Eigen::MatrixXd& course,
                          std::span<const std::uint32_t> vertices, Eigen::VectorXd& motion) {
    constexpr std::size_t at_once = 64;
    const double frames = static_cast<double>(columns.rows.size());
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(course.cols(), static_cast<Index>(3 * vertices.size()));
    motion = Eigen::VectorXd::Zero(right.cols());
    for (std::size_t first = 0; first < columns.rows.size(); first += at_once) {
        const std::size_t count = std::min(at_once, columns.rows.size() - first);
        const Eigen::MatrixXd moves =
            displacements_of(sequence, std::span(columns.rows).subspan(first, count), vertices);
        const Eigen::MatrixXd here =
            course.middleRows(static_cast<Index>(first), static_cast<Index>(count)).transpose() / frames;
        constexpr Index wide = 512;
        tbb::parallel_for(Index{0}, (right.cols() + wide - 1) / wide, [&](Index block) {
            const Index from = block * wide, width = std::min(wide, right.cols() - from);
            right.middleCols(from, width).noalias() += here * moves.middleCols(from, width);
        });
        motion += moves.colwise().squaredNorm().transpose() / frames;
    }
    return right;
}

// The same model with some neighbouring intervals of one parameter joined to one.
struct Joined {
    std::vector<Interval> intervals;
    Eigen::MatrixXd sums;  // finest x joined: 1 where it is part of it
};

// How a parameter is bent: not at all, at 0, or at 0 and halfway.
enum class Bend { none, at_zero, halfway };

Joined join(std::span<const Interval> fine, std::span<const Bend> bends) {
    Joined joined;
    std::vector<std::pair<std::size_t, std::size_t>> parts;
    for (std::size_t i = 0; i < fine.size(); ++i) {
        const Bend bend = bends[fine[i].column];
        const bool goes_on = !joined.intervals.empty() && joined.intervals.back().column == fine[i].column &&
                             (bend == Bend::none || (bend == Bend::at_zero && fine[i].low != 0));
        if (goes_on)
            joined.intervals.back().high = fine[i].high;
        else
            joined.intervals.push_back(fine[i]);
        parts.emplace_back(i, joined.intervals.size() - 1);
    }
    joined.sums = Eigen::MatrixXd::Zero(static_cast<Index>(fine.size()), static_cast<Index>(joined.intervals.size()));
    for (const auto& [i, j] : parts) joined.sums(static_cast<Index>(i), static_cast<Index>(j)) = 1;
    return joined;
}

constexpr double rounding = 1e-9;  // of the mean square of a course: what keeps singular sums solvable

// How much of all motion a choice of intervals explains. `outer`: right right^T of the finest ones.
double explained(const Joined& joined, const Eigen::MatrixXd& gram, const Eigen::MatrixXd& outer) {
    Eigen::MatrixXd g = joined.sums.transpose() * gram * joined.sums;
    const Eigen::VectorXd scale = g.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    g = scale.asDiagonal() * g * scale.asDiagonal();
    g.diagonal().array() += rounding;
    const Eigen::MatrixXd m = scale.asDiagonal() * (joined.sums.transpose() * outer * joined.sums) * scale.asDiagonal();
    return g.ldlt().solve(m).trace();
}

// Bends parameters one after the other, each time the one that explains most, until none explains enough of what is
// left.
std::vector<Bend> choose_bends(std::span<const Interval> fine, std::size_t columns, const Eigen::MatrixXd& gram,
                               const Eigen::MatrixXd& outer, double all) {
    constexpr double worth = 0.05;    // of what is left
    constexpr double noticed = 2e-5;  // of all motion: less is no error but noise
    std::vector<Bend> bends(columns, Bend::none);
    double now = explained(join(fine, bends), gram, outer);
    while (all - now > noticed * all) {
        double best = now;
        std::vector<Bend> chosen;
        for (std::size_t k = 0; k < columns; ++k)
            for (const Bend bend : {Bend::at_zero, Bend::halfway}) {
                if (bend <= bends[k]) continue;
                std::vector<Bend> trial = bends;
                trial[k] = bend;
                const double then = explained(join(fine, trial), gram, outer);
                if (then <= best) continue;
                best = then;
                chosen = std::move(trial);
            }
        if (chosen.empty() || best - now < worth * (all - now)) break;
        bends = std::move(chosen);
        now = best;
    }
    return bends;
}

}  // namespace

Model fit_model(const MeshSequence& sequence, const FapColumns& columns, std::span<const std::uint32_t> vertices,
                Eigen::VectorXd& motion) {
    const std::vector<Interval> fine = finest(columns);
    Eigen::MatrixXd course = courses(columns, fine);
    const double frames = static_cast<double>(columns.rows.size());
    const Eigen::MatrixXd gram = course.transpose() * course / frames;
    const Eigen::MatrixXd right = sum_right(sequence, columns, course, vertices, motion);
    const Eigen::MatrixXd outer = right * right.transpose();
    const std::vector<Bend> bends = choose_bends(fine, columns.faps.size(), gram, outer, motion.sum());
    const Joined joined = join(fine, bends);
    Model model;
    model.intervals = joined.intervals;
    model.course = course * joined.sums;
    model.sizes = (model.course.colwise().squaredNorm().transpose() / frames).cwiseSqrt();
    const Eigen::VectorXd scale = model.sizes.cwiseMax(1e-300).cwiseInverse();
    model.course = model.course * scale.asDiagonal();
    model.gram = scale.asDiagonal() * (joined.sums.transpose() * gram * joined.sums) * scale.asDiagonal();
    model.right = scale.asDiagonal() * (joined.sums.transpose() * right);
    return model;
}

namespace {

// Of one place.
Eigen::MatrixXd solve(const Model& model, const Eigen::MatrixXd& right, const Eigen::MatrixXd& expected,
                      const Eigen::VectorXd& pull, std::span<const Index> kept) {
    const auto n = static_cast<Index>(kept.size());
    Eigen::MatrixXd a(n, n), b(n, 3);
    for (Index i = 0; i < n; ++i) {
        const Index k = kept[static_cast<std::size_t>(i)];
        for (Index j = 0; j < n; ++j) a(i, j) = model.gram(k, kept[static_cast<std::size_t>(j)]);
        a(i, i) += pull[k];
        b.row(i) = right.row(k) + pull[k] * expected.row(k);
    }
    return a.llt().solve(b);
}

}  // namespace

namespace {

Eigen::VectorXd pull_of(const Expectation& expectation, Index place) {
    const Eigen::ArrayXd away = (expectation.distances.col(place).array() / near).min(farthest);
    return pull_here * (1 + pull_away * away.square());
}

// Shares that move the place too little to be seen are dropped, and the others fitted again.
void share_place(const Model& model, const Expectation& expectation, const Eigen::VectorXd& peaks, Index place,
                 Eigen::MatrixXd& result) {
    constexpr int rounds = 4;
    const Eigen::MatrixXd right = model.right.middleCols(3 * place, 3);
    const Eigen::MatrixXd expected = expectation.fields.middleCols(3 * place, 3);
    const Eigen::VectorXd pull = pull_of(expectation, place);
    std::vector<Index> kept(static_cast<std::size_t>(model.gram.rows()));
    std::iota(kept.begin(), kept.end(), Index{0});
    Eigen::MatrixXd w;
    for (int round = 0; round < rounds && !kept.empty(); ++round) {
        w = solve(model, right, expected, pull, kept);
        std::vector<Index> still;
        for (std::size_t i = 0; i < kept.size(); ++i)
            if (w.row(static_cast<Index>(i)).norm() * peaks[kept[i]] >= expectation.least[kept[i]])
                still.push_back(kept[i]);
        if (still.size() == kept.size() || round + 1 == rounds) break;
        kept = std::move(still);
    }
    for (std::size_t i = 0; i < kept.size(); ++i) result.block(kept[i], 3 * place, 1, 3) = w.row(static_cast<Index>(i));
}

}  // namespace

Eigen::MatrixXd shares(const Model& model, const Expectation& expectation) {
    const Index places = model.right.cols() / 3;
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(model.gram.rows(), 3 * places);
    const Eigen::VectorXd peaks = model.course.cwiseAbs().colwise().maxCoeff().transpose();
    tbb::parallel_for(Index{0}, places, [&](Index p) { share_place(model, expectation, peaks, p, result); });
    return result;
}

Eigen::VectorXd left_by(const Model& model, const Eigen::MatrixXd& shares, const Eigen::VectorXd& motion) {
    const Eigen::MatrixXd given = model.gram * shares - 2 * model.right;
    const Eigen::VectorXd left = motion + shares.cwiseProduct(given).colwise().sum().transpose();
    Eigen::VectorXd of_place(left.size() / 3);
    for (Index p = 0; p < of_place.size(); ++p) of_place[p] = std::max(left.segment(3 * p, 3).sum(), 0.0);
    return of_place;
}

Eigen::VectorXd beyond_of(const Model& model, const Eigen::VectorXd& motion) {
    if (model.right.size() == 0) return motion;
    Eigen::MatrixXd gram = model.gram;
    gram.diagonal().array() += rounding;
    const Eigen::MatrixXd best = gram.ldlt().solve(model.right);
    return (motion - best.cwiseProduct(model.right).colwise().sum().transpose()).cwiseMax(0);
}

}  // namespace mien
