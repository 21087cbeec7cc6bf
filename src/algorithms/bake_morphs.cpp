// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// A motion as a few shapes: the truncated singular value decomposition of D, the displacements of the moving vertices
// (one row per time, three columns per vertex), which leaves the least squared error of all sums of so many shapes.
//
// D is met a block of rows at a time. The Gram matrix G = S S' of the rows S held so far is small; with its
// eigenvectors u the rows u' S are orthogonal, of length sigma, and the weak ones among them can go: Eckart and Young,
// The approximation of one matrix by another of lower rank, 1936. What stays is stacked on the next block. So a take
// of any length is served in the memory of two blocks; up to 256 rows, or a rank of 256, nothing is lost by it. What
// was dropped is summed, so the number of targets follows from the error that is left.
//
// Then the small deltas of the shapes go, the weights are fitted again by least squares to what remained, and shapes
// and weights are scaled so that the largest weight is +1. The error is measured on the floats that are given out.
//
// G is summed in double over columns in fixed order, tile by tile: the same bytes with any number of threads.

#include "mien/algorithms/bake_morphs.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <limits>
#include <span>
#include <tbb/parallel_for.h>
#include <utility>
#include <vector>

#include "mien/error.hpp"

namespace mien {
namespace {

using Index = Eigen::Index;
using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;
using Rows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Tile = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;  // as Rows lie in memory

constexpr Index block_rows = 256;
constexpr Index tile_rows = 64, tile_columns = 1024;
// Eigenvalues below this share of the largest are rounding of the Gram matrix.
constexpr double rounding = 1e-14;

// What a first look over all rows tells.
struct Motion {
    std::vector<std::uint32_t> vertices;  ///< those that ever move, ascending
    double largest = 0;                   ///< largest distance of any vertex from its neutral position
    double reach = 0;                     ///< largest coordinate: how coarse its floats are
};

Index columns(const Motion& motion) {
    return 3 * static_cast<Index>(motion.vertices.size());
}

Index row_count(const MeshSequence& sequence) {
    return static_cast<Index>(sequence.times.size());
}

double largest_coordinate(const Vec3f& p) {
    return double{std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)})};
}

Motion look_over(const MeshSequence& sequence) {
    const std::vector<Vec3f>& neutral = sequence.mesh.positions;
    std::vector<Vec3f> frame(neutral.size());
    std::vector<char> moves(neutral.size());
    Motion motion;
    for (std::size_t r = 0; r < sequence.times.size(); ++r) {
        sequence.positions(r, frame);
        for (std::size_t v = 0; v < frame.size(); ++v) {
            const Vec3f moved = frame[v] - neutral[v];
            if (!is_finite(moved))
                throw Error(fmt::format("mesh sequence row {}, vertex {}: expected finite coordinates, found {} {} {}",
                                        r, v, frame[v].x, frame[v].y, frame[v].z));
            if (moved != Vec3f{}) moves[v] = 1;
            motion.largest = std::max(motion.largest, length(to_double(moved)));
            motion.reach = std::max(motion.reach, largest_coordinate(frame[v]));
        }
    }
    for (std::uint32_t v = 0; v < moves.size(); ++v)
        if (moves[v] != 0) motion.vertices.push_back(v);
    return motion;
}

// Displacements of the moving vertices in the rows from `first`, as many as `rows` has.
void read_rows(const MeshSequence& sequence, const Motion& motion, Index first, Eigen::Ref<Rows> rows) {
    std::vector<Vec3f> frame(vertex_count(sequence.mesh));
    for (Index r = 0; r < rows.rows(); ++r) {
        sequence.positions(static_cast<std::size_t>(first + r), frame);
        Index column = 0;
        for (const std::uint32_t v : motion.vertices) {
            const Vec3f moved = frame[v] - sequence.mesh.positions[v];
            for (const float d : {moved.x, moved.y, moved.z}) rows(r, column++) = d;
        }
    }
}

// One tile of the Gram matrix.
Matrix products(const Rows& rows, Index i, Index height, Index j, Index width) {
    Matrix sum = Matrix::Zero(height, width);
    for (Index c = 0; c < rows.cols(); c += tile_columns) {
        const Index n = std::min(tile_columns, rows.cols() - c);
        const Tile a = rows.block(i, c, height, n).cast<double>(), b = rows.block(j, c, width, n).cast<double>();
        sum.noalias() += a * b.transpose();
    }
    return sum;
}

// S S'; its lower triangle, which is all that the solvers read.
Matrix gram(const Rows& rows) {
    const Index tiles = (rows.rows() + tile_rows - 1) / tile_rows;
    Matrix G = Matrix::Zero(rows.rows(), rows.rows());
    tbb::parallel_for(Index{0}, tiles * tiles, [&](Index tile) {
        const Index i = tile / tiles * tile_rows, j = tile % tiles * tile_rows;
        if (j > i) return;
        const Index height = std::min(tile_rows, rows.rows() - i), width = std::min(tile_rows, rows.rows() - j);
        G.block(i, j, height, width) = products(rows, i, height, j, width);
    });
    return G;
}

// Orthogonal shapes, strongest first.
struct Shapes {
    Rows rows;        ///< u'S: length sigma
    Vector squared;   ///< sigma squared
    double lost = 0;  ///< squared length of all that was dropped
};

// Replaces the rows by at most `most` orthogonal ones that span nearly the same.
void compress(Shapes& shapes, Index most) {
    const Eigen::SelfAdjointEigenSolver<Matrix> eigen(gram(shapes.rows));
    const Vector values = eigen.eigenvalues().reverse().cwiseMax(0);
    const Index kept = std::min<Index>(most, (values.array() > rounding * values(0)).count());
    const Matrix U = eigen.eigenvectors().rowwise().reverse().leftCols(kept);
    const Index tiles = (shapes.rows.cols() + tile_columns - 1) / tile_columns;
    tbb::parallel_for(Index{0}, tiles, [&](Index tile) {
        const Index c = tile * tile_columns, n = std::min(tile_columns, shapes.rows.cols() - c);
        const Tile whole = shapes.rows.middleCols(c, n).cast<double>();
        const Tile turned = U.transpose() * whole;
        shapes.rows.block(0, c, kept, n) = turned.cast<float>();
    });
    shapes.rows.conservativeResize(kept, Eigen::NoChange);
    shapes.squared = values.head(kept);
    shapes.lost += values.tail(values.size() - kept).sum();
}

Shapes decompose(const MeshSequence& sequence, const Motion& motion, Index most) {
    Shapes shapes{Rows(0, columns(motion)), {}, 0};
    if (motion.vertices.empty()) return shapes;
    for (Index first = 0; first < row_count(sequence); first += block_rows) {
        const Index kept = shapes.rows.rows(), count = std::min(block_rows, row_count(sequence) - first);
        shapes.rows.conservativeResize(kept + count, Eigen::NoChange);
        read_rows(sequence, motion, first, shapes.rows.bottomRows(count));
        compress(shapes, most);
    }
    return shapes;
}

// Fewest shapes that leave no more than the tolerance. What is finer than the rounding of the positions is no motion.
Index enough(const Shapes& shapes, const Motion& motion, Index rows, const BakeOptions& options) {
    const double noise = motion.reach * double{std::numeric_limits<float>::epsilon()} / 2;
    const double error = std::max(noise, options.tolerance * motion.largest);
    const double allowed = error * error * static_cast<double>(rows) * static_cast<double>(motion.vertices.size());
    double left = shapes.lost;
    Index count = shapes.rows.rows();
    while (count > 0 && left + shapes.squared(count - 1) <= allowed) left += shapes.squared(--count);
    return std::min<Index>(count, options.morphs);
}

// Least squares weights of the targets, rows x targets.
Matrix fit_weights(const MeshSequence& sequence, const Motion& motion, const Rows& targets) {
    if (targets.rows() == 0) return Matrix(row_count(sequence), 0);
    Matrix b(targets.rows(), row_count(sequence));
    for (Index first = 0; first < b.cols(); first += block_rows) {
        Rows block(std::min(block_rows, b.cols() - first), columns(motion));
        read_rows(sequence, motion, first, block);
        tbb::parallel_for(Index{0}, block.rows(), [&](Index r) {
            for (Index k = 0; k < targets.rows(); ++k)
                b(k, first + r) = targets.row(k).cast<double>().dot(block.row(r).cast<double>());
        });
    }
    return gram(targets).ldlt().solve(b).transpose();
}

// Scales each target so that its largest weight is +1.
void scale_to_one(Rows& targets, Matrix& weights) {
    for (Index k = 0; k < targets.rows(); ++k) {
        Index peak = 0;
        weights.col(k).cwiseAbs().maxCoeff(&peak);
        const double most = weights(peak, k);
        if (most == 0) continue;
        targets.row(k) = (targets.row(k).cast<double>() * most).cast<float>();
        weights.col(k) /= most;
    }
}

// Drops deltas shorter than `least`, and targets of which nothing remains.
Rows sparse(Rows targets, double least) {
    std::vector<Index> kept;
    for (Index k = 0; k < targets.rows(); ++k) {
        for (Index c = 0; c < targets.cols(); c += 3)
            if (targets.row(k).segment<3>(c).cast<double>().norm() < least) targets.row(k).segment<3>(c).setZero();
        if ((targets.row(k).array() != 0).any()) kept.push_back(k);
    }
    return targets(kept, Eigen::all);
}

MorphTarget morph_target(const Rows& targets, Index k, const Motion& motion) {
    MorphTarget target{fmt::format("morph_{:02}", k + 1), {}, {}};
    for (std::size_t i = 0; i < motion.vertices.size(); ++i) {
        const auto delta = targets.row(k).segment<3>(3 * static_cast<Index>(i));
        if ((delta.array() == 0).all()) continue;
        target.vertices.push_back(motion.vertices[i]);
        target.deltas.push_back({delta(0), delta(1), delta(2)});
    }
    return target;
}

// Squared distances of the moving vertices in one row to the sum of the targets: their sum and the largest.
std::pair<double, double> squared_errors(const Rows& targets, std::span<const float> weights,
                                         const Eigen::Ref<const Eigen::RowVectorXf>& moved) {
    Eigen::RowVectorXd left = moved.cast<double>();
    for (Index k = 0; k < targets.rows(); ++k) left -= double{weights[k]} * targets.row(k).cast<double>();
    const Eigen::RowVectorXd squared = left.reshaped(3, left.size() / 3).colwise().squaredNorm();
    return {squared.sum(), squared.size() > 0 ? squared.maxCoeff() : 0};
}

void measure(MorphTrack& track, const MeshSequence& sequence, const Motion& motion, const Rows& targets) {
    double sum = 0, largest = 0;
    const std::size_t n = track.targets.size();
    for (Index first = 0; first < row_count(sequence); first += block_rows) {
        Rows block(std::min(block_rows, row_count(sequence) - first), columns(motion));
        read_rows(sequence, motion, first, block);
        std::vector<std::pair<double, double>> errors(static_cast<std::size_t>(block.rows()));
        tbb::parallel_for(Index{0}, block.rows(), [&](Index r) {
            const auto weights = std::span(track.weights).subspan(static_cast<std::size_t>(first + r) * n, n);
            errors[r] = squared_errors(targets, weights, block.row(r));
        });
        for (const auto& [squared, most] : errors) {
            sum += squared;
            largest = std::max(largest, most);
        }
    }
    const double count = static_cast<double>(track.times.size()) * static_cast<double>(vertex_count(sequence.mesh));
    track.mean_error = count > 0 ? std::sqrt(sum / count) : 0;
    track.max_error = std::sqrt(largest);
}

}  // namespace

MorphTrack bake_morphs(const MeshSequence& sequence, const BakeOptions& options) {
    if (sequence.times.empty()) throw Error("mesh sequence: expected at least one row, found none");
    const Motion motion = look_over(sequence);
    Shapes shapes = decompose(sequence, motion, std::max<Index>(block_rows, options.morphs));
    shapes.rows.conservativeResize(enough(shapes, motion, row_count(sequence), options), Eigen::NoChange);
    Rows targets = std::move(shapes.rows);

    Matrix weights = fit_weights(sequence, motion, targets);
    scale_to_one(targets, weights);
    targets = sparse(std::move(targets), options.sparsity * motion.largest);
    weights = fit_weights(sequence, motion, targets);
    scale_to_one(targets, weights);

    MorphTrack track;
    track.times = sequence.times;
    for (Index k = 0; k < targets.rows(); ++k) track.targets.push_back(morph_target(targets, k, motion));
    for (Index r = 0; r < weights.rows(); ++r)
        for (Index k = 0; k < weights.cols(); ++k) track.weights.push_back(static_cast<float>(weights(r, k)));
    measure(track, sequence, motion, targets);
    return track;
}

}  // namespace mien
