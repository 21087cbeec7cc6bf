// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The walls of a pocket hang on two things: its rim, and the skin on the other side of the flesh. Energy over the
// walls: w'Lw + (w - share * outside)'A(w - share * outside) / softness^2, so that the rim decides near it and the
// flesh deeper down. The share falls with the thickness of the flesh: bone lies in what is thick.

#include "algorithms/fill_pockets.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "algorithms/island.hpp"
#include "algorithms/laplacian.hpp"
#include "algorithms/nearest_places.hpp"
#include "algorithms/pockets.hpp"
#include "algorithms/sparse_solve.hpp"

#include "mien/algorithms/surface_distance.hpp"

namespace mien {

namespace {

constexpr double softness = 0.1;  // in eye distances, as below
constexpr double flesh = 0.4;
constexpr double straight = 0.7;    // cosine to the normals: the other lip is not through the flesh
constexpr std::size_t tried = 256;  // places of the skin for each of a wall
constexpr double looked_at = 0.5;   // ways along the surface from a wall to the skin round the rim

struct Skin {
    std::vector<std::uint32_t> places;
    std::vector<Vec3> positions, normals;
};

Skin open_skin(const Face& face, const Weld& weld, const std::vector<bool>& solved, const std::vector<bool>& pocket,
               const std::vector<Vec3>& normals) {
    Skin skin;
    for (std::uint32_t p = 0; p < solved.size(); ++p) {
        if (!solved[p] || pocket[p]) continue;
        skin.places.push_back(p);
        skin.positions.push_back(position(face.mesh, weld, p));
        skin.normals.push_back(normals[p]);
    }
    return skin;
}

// Two lips that touch may seem to be the two sides of one: near the rim, the way to the other side of the flesh along
// the surface is not much longer than out of the pocket and as far back again.
double longest_way(double out, double thick) {
    return 2 * out + 3 * thick;
}

class WaysRound {
public:
    WaysRound(const EdgeGraph& graph, const std::vector<bool>& marked, std::uint32_t wall, double scale)
        : ways_(surface_distances(graph, wall, looked_at * scale)), limit_(looked_at * scale) {
        for (std::uint32_t p = 0; p < ways_.size(); ++p)
            if (!marked[p]) out_ = std::min(out_, ways_[p]);
    }
    [[nodiscard]] bool is_round_the_rim(std::uint32_t place, double thick) const {
        const double longest = longest_way(out_, thick);
        return longest > limit_ || ways_[place] <= longest;
    }

private:
    std::vector<double> ways_;
    double limit_;
    double out_ = std::numeric_limits<double>::infinity();
};

}  // namespace

Pockets line_pockets(const Face& face, const Weld& weld, const std::vector<bool>& solved,
                     const std::vector<bool>& marked, double scale) {
    std::vector<Vec3> normals = outward_normals(face.mesh, weld, solved);
    for (Vec3& n : normals)
        if (length(n) > 0) n = n / length(n);
    const Skin skin = open_skin(face, weld, solved, marked, normals);
    const NearestPlaces nearest(skin.positions);
    const EdgeGraph graph = edge_graph(face.mesh, weld);
    Pockets pockets{{}, {}, {}, softness * scale};
    for (std::uint32_t p = 0; p < marked.size(); ++p) {
        if (!marked[p]) continue;
        const Vec3 at = position(face.mesh, weld, p);
        const std::vector<std::uint32_t> near = nearest.nearest(at, tried);
        std::optional<WaysRound> ways;  // only for walls that may be near the rim
        const auto found = std::find_if(near.begin(), near.end(), [&](std::uint32_t i) {
            const Vec3 way = skin.positions[i] - at;
            const double off = straight * length(way);
            if (!(dot(way, normals[p]) < -off) || !(dot(way, skin.normals[i]) > off)) return false;
            const double least_out = distance(skin.positions[near.front()], at);
            if (longest_way(least_out, length(way)) > looked_at * scale) return true;
            if (!ways) ways.emplace(graph, marked, p, scale);
            return ways->is_round_the_rim(skin.places[i], length(way));
        });
        pockets.places.push_back(p);
        pockets.outside.push_back(found == near.end() ? p : skin.places[*found]);
        const double thick = found == near.end() ? 0 : distance(skin.positions[*found], at) / (flesh * scale);
        pockets.shares.push_back(std::exp(-thick * thick));
    }
    return pockets;
}

Eigen::MatrixXd fill_pockets(const Mesh& mesh, const Weld& weld, const Pockets& pockets,
                             const Eigen::MatrixXd& weights) {
    const Laplacian surface = laplacian(mesh, weld, Cotangents::positive);
    const Eigen::SparseMatrix<double> pick = picks(surface.stiffness.rows(), pockets.places);
    Eigen::MatrixXd around = weights;
    for (const std::uint32_t p : pockets.places) around.row(p).setZero();
    Eigen::MatrixXd right = -(pick.transpose() * (surface.stiffness * around));
    Eigen::VectorXd pull = Eigen::VectorXd::Zero(right.rows());
    for (Eigen::Index i = 0; i < right.rows(); ++i) {
        const std::uint32_t p = pockets.places[static_cast<std::size_t>(i)];
        const std::uint32_t outside = pockets.outside[static_cast<std::size_t>(i)];
        if (outside == p) continue;
        pull[i] = surface.areas[p] / (pockets.softness * pockets.softness);
        right.row(i) += pull[i] * pockets.shares[static_cast<std::size_t>(i)] * weights.row(outside);
    }
    Eigen::SparseMatrix<double> matrix = pick.transpose() * surface.stiffness * pick;
    matrix += Eigen::SparseMatrix<double>(pull.asDiagonal());
    return solve_checked(matrix, right, "pockets of the skin");
}

}  // namespace mien
