// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Scattered data interpolation (docs/methods.md). With C the points and the still places of one island, the system is
//
//     [K 1; 1' 0] [w; m] = [k; 1]      linear kernel, K = -|c_i - c_j|: positive definite on what sums to zero
//     K w = k                          surface kernel, K = exp(-d_ij / 2s), its spectrum clipped from below
//
// and the weights of the points are the first entries of w. The energy by which rows are refitted is the points' block
// of the inverse.

#include "mien/algorithms/rig_rbf.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <span>
#include <tbb/parallel_for.h>
#include <vector>

#include "algorithms/island.hpp"
#include "algorithms/movers.hpp"
#include "algorithms/refit.hpp"

#include "mien/algorithms/surface_distance.hpp"
#include "mien/error.hpp"

namespace mien {

namespace {

using Kernel = RbfRigOptions::Kernel;

constexpr double far_radius = 1.6;  // in eye distances
constexpr std::size_t still_count = 40;
constexpr double tie = 1e-5;
constexpr double least_eigenvalue = 1e-6;  // of the largest
constexpr double largest_residual = 1e-6;

// One island that holds points: its places, and which of the movers are on it.
struct Piece {
    std::vector<std::uint32_t> places;  // ascending
    std::vector<std::uint32_t> movers;  // index into the movers
};

std::vector<Piece> pieces(const Mesh& mesh, const Weld& weld, const Movers& movers) {
    const std::vector<std::uint32_t> island = islands(mesh, weld);
    std::map<std::uint32_t, Piece> by_island;
    for (std::uint32_t m = 0; m < movers.places.size(); ++m) by_island[island[movers.places[m]]].movers.push_back(m);
    for (std::uint32_t p = 0; p < island.size(); ++p)
        if (const auto found = by_island.find(island[p]); found != by_island.end()) found->second.places.push_back(p);
    std::vector<Piece> list;
    list.reserve(by_island.size());
    for (auto& [number, piece] : by_island) list.push_back(std::move(piece));
    return list;
}

// About 40 places far from all centres, each as far as possible from those before. Places that tie are taken together,
// so that neither the order of vertices nor a side of the face is preferred.
std::vector<std::uint32_t> still_places(const Face& face, const Weld& weld, const Piece& piece, const Movers& movers,
                                        double radius) {
    std::vector<double> away(piece.places.size(), std::numeric_limits<double>::infinity());
    const auto come_near = [&](std::uint32_t centre) {
        const Vec3 at = position(face.mesh, weld, centre);
        for (std::size_t i = 0; i < away.size(); ++i)
            away[i] = std::min(away[i], distance(position(face.mesh, weld, piece.places[i]), at));
    };
    for (const std::uint32_t m : piece.movers) come_near(movers.places[m]);
    std::vector<bool> is_far(away.size());
    for (std::size_t i = 0; i < away.size(); ++i) is_far[i] = away[i] > radius;
    std::vector<std::uint32_t> still;
    while (still.size() < still_count) {
        double farthest = 0;
        for (std::size_t i = 0; i < away.size(); ++i)
            if (is_far[i]) farthest = std::max(farthest, away[i]);
        if (!(farthest > tie * radius)) break;
        std::vector<std::uint32_t> tied;
        for (std::size_t i = 0; i < away.size(); ++i)
            if (is_far[i] && away[i] >= (1 - tie) * farthest) tied.push_back(piece.places[i]);
        for (const std::uint32_t p : tied) come_near(p);
        still.insert(still.end(), tied.begin(), tied.end());
    }
    return still;
}

// Distances from every centre to every place of the piece: places x centres.
Eigen::MatrixXd distances(const Mesh& mesh, const Weld& weld, const Piece& piece,
                          std::span<const std::uint32_t> centres, Kernel kernel) {
    const EdgeGraph graph = kernel == Kernel::surface ? edge_graph(mesh, weld) : EdgeGraph{};
    Eigen::MatrixXd d(std::ssize(piece.places), std::ssize(centres));
    tbb::parallel_for(std::size_t{0}, centres.size(), [&](std::size_t c) {
        std::vector<double> along;
        if (kernel == Kernel::surface) along = surface_distances(graph, centres[c]);
        const Vec3 at = position(mesh, weld, centres[c]);
        for (std::size_t i = 0; i < piece.places.size(); ++i)
            d(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(c)) =
                along.empty() ? distance(position(mesh, weld, piece.places[i]), at) : along[piece.places[i]];
    });
    return d;
}

// Mean distance of a mover to the nearest other; `alone` for a single one.
double mean_nearest(const Eigen::MatrixXd& between, Eigen::Index movers, double alone) {
    if (movers < 2) return alone;
    Eigen::MatrixXd d = between.topLeftCorner(movers, movers);
    d.diagonal().setConstant(std::numeric_limits<double>::infinity());
    return d.rowwise().minCoeff().mean();
}

// A distance along a surface is no distance in a flat space, so exp(-d) may have negative eigenvalues.
Eigen::MatrixXd clipped_inverse(const Eigen::MatrixXd& k) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> spectrum(k);
    const Eigen::VectorXd values =
        spectrum.eigenvalues().cwiseMax(least_eigenvalue * spectrum.eigenvalues().maxCoeff());
    return spectrum.eigenvectors() * values.cwiseInverse().asDiagonal() * spectrum.eigenvectors().transpose();
}

Eigen::MatrixXd bordered_inverse(const Eigen::MatrixXd& k) {
    const Eigen::Index n = k.rows();
    Eigen::MatrixXd bordered = Eigen::MatrixXd::Zero(n + 1, n + 1);
    bordered.topLeftCorner(n, n) = k;
    bordered.block(0, n, n, 1).setOnes();
    bordered.block(n, 0, 1, n).setOnes();
    Eigen::MatrixXd inverse = bordered.fullPivLu().inverse();
    const double off = (bordered * inverse - Eigen::MatrixXd::Identity(n + 1, n + 1)).cwiseAbs().maxCoeff();
    if (!(off <= largest_residual))
        throw Error(
            fmt::format("rbf rig: expected a residual of at most {}, found {:.3g}; some feature points may lie "
                        "almost on one place",
                        largest_residual, off));
    return inverse;
}

struct PieceWeights {
    Eigen::MatrixXd weights;     // places x movers of the piece
    Eigen::MatrixXd covariance;  // movers x movers
};

PieceWeights solve_piece(const Face& face, const Weld& weld, const Piece& piece, const Movers& movers, Kernel kernel) {
    const double eyes = face_scale(face);
    std::vector<std::uint32_t> centres;
    for (const std::uint32_t m : piece.movers) centres.push_back(movers.places[m]);
    const auto n = std::ssize(centres);
    const std::vector<std::uint32_t> still = still_places(face, weld, piece, movers, far_radius * eyes);
    centres.insert(centres.end(), still.begin(), still.end());

    const Eigen::MatrixXd d = distances(face.mesh, weld, piece, centres, kernel);
    Eigen::MatrixXd between(std::ssize(centres), std::ssize(centres));
    for (Eigen::Index c = 0; c < between.rows(); ++c) {
        const auto at =
            std::lower_bound(piece.places.begin(), piece.places.end(), centres[static_cast<std::size_t>(c)]);
        between.row(c) = d.row(at - piece.places.begin());
    }
    between = (between + between.transpose()) / 2;

    PieceWeights result;
    if (kernel == Kernel::surface) {
        const double s = 2 * mean_nearest(between, n, eyes);
        const Eigen::MatrixXd inverse = clipped_inverse((-between / s).array().exp());
        result.weights = (-d / s).array().exp().matrix() * inverse.leftCols(n);
        result.covariance = covariance_of(inverse.topLeftCorner(n, n));
    } else {
        const Eigen::MatrixXd inverse = bordered_inverse(-between / eyes);
        result.weights = -d / eyes * inverse.topLeftCorner(between.rows(), n);
        result.weights.rowwise() += inverse.row(between.rows()).head(n);
        result.covariance = covariance_of(inverse.topLeftCorner(n, n));
    }
    return result;
}

// The rows of all pieces in one matrix; a piece has no weights for the movers of others.
WeightRows rows_of(const Face& face, const Weld& weld, const Movers& movers, const RbfRigOptions& options) {
    const auto count = std::ssize(movers.points);
    const std::vector<Piece> list = pieces(face.mesh, weld, movers);
    std::map<std::uint32_t, Eigen::RowVectorXd> by_place;
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(count, count);
    for (const Piece& piece : list) {
        const PieceWeights solved = solve_piece(face, weld, piece, movers, options.kernel);
        covariance(piece.movers, piece.movers) = solved.covariance;
        for (std::size_t i = 0; i < piece.places.size(); ++i) {
            Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(count);
            row(piece.movers) = solved.weights.row(static_cast<Eigen::Index>(i));
            by_place.emplace(piece.places[i], std::move(row));
        }
    }
    for (const std::uint32_t place : movers.places) by_place.erase(place);
    std::vector<std::uint32_t> places;
    Eigen::MatrixXd weights(std::ssize(by_place), count);
    for (const auto& [place, row] : by_place) {
        weights.row(std::ssize(places)) = row;
        places.push_back(place);
    }
    return refit_rows(weld.vertex.size(), movers, places, weights, covariance, options.influences);
}

}  // namespace

Rig rig_rbf(const Face& face, const RbfRigOptions& options) {
    const char* name = options.kernel == Kernel::linear ? "rbf" : "rbf-surface";
    return rig_by_axes(name, face, [&](const Weld& weld, const std::vector<bool>&, const Movers& movers) {
        return rows_of(face, weld, movers, options);
    });
}

}  // namespace mien
