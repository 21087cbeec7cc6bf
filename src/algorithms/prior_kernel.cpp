// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// How places move together, from a smooth sheet and example shapes (docs/methods.md, "From example shapes"):
//
//     mu = sum_j |A_j|^2, smoothed: (M + ms^2 L) mu' = M mu      q = (mu' / mean over the points + mf)^(gs/2)
//     G(v,f) = g q(v) q(f) (L M^-1 L + a L)^-1 (v,f), mean of G(f,f) brought to g
//     B(v,f) = s sum_j A_j(v) . A_j(f) exp(-|v - f|^2 / (2 sw^2))
//
// The dot product in B forgets in which direction a shape moves two places and keeps how strongly they move together.
// The sheet ends 1.6 eye distances from the points and at closed pockets, where it follows their rims. Where nothing is
// as far, it may drift as a whole: a little of M keeps that finite.

#include "algorithms/prior_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <tbb/parallel_for.h>

#include "algorithms/face_check.hpp"
#include "algorithms/island.hpp"
#include "algorithms/laplacian.hpp"
#include "algorithms/sparse_solve.hpp"

#include "mien/algorithms/attach.hpp"
#include "mien/algorithms/surface_distance.hpp"

namespace mien {

namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Places = std::span<const std::uint32_t>;

constexpr double far_radius = 1.6;
constexpr double drift = 1;  // of M, per eye distance to the fourth

double squared_at(std::span<const Field> shapes, Places places) {
    double sum = 0;
    for (const Field& shape : shapes)
        for (const std::uint32_t p : places) sum += shape.row(p).squaredNorm();
    return sum;
}

void add_scaled(std::vector<Field>& all, std::span<const Field> shapes, const std::vector<double>& factors,
                double factor) {
    for (std::size_t k = 0; k < shapes.size(); ++k) all.emplace_back(factor * factors[k] * shapes[k]);
}

double total_size(std::span<const Field> shapes, const std::vector<double>& factors) {
    double sum = 0;
    for (std::size_t k = 0; k < shapes.size(); ++k) sum += factors[k] * factors[k] * squared_size(shapes[k]);
    return sum;
}

Eigen::VectorXd mobility_of(const Ground& ground, std::span<const Field> all, const PriorSetting& setting) {
    const Laplacian surface = laplacian(ground.face.mesh, ground.joined);
    Eigen::VectorXd mu = Eigen::VectorXd::Zero(surface.areas.size());
    for (const Field& shape : all) mu += shape.rowwise().squaredNorm();
    Sparse step = std::pow(setting.ms * ground.scale, 2) * surface.stiffness;
    step += Sparse(surface.areas.asDiagonal());
    const Eigen::VectorXd smooth = solve_checked(step, surface.areas.asDiagonal() * mu, "rig prior").cwiseMax(0);
    double mean = 0;
    for (const std::uint32_t p : ground.points) mean += smooth[p] / static_cast<double>(ground.points.size());
    if (!(mean > 0)) return Eigen::VectorXd::Constant(mu.size(), std::pow(1 + setting.mf, setting.gs / 2));
    return (smooth.array() / mean + setting.mf).pow(setting.gs / 2);
}

// The solved places that a mover reaches along the surface.
std::vector<std::uint32_t> near_places(const Ground& ground, Places movers) {
    const EdgeGraph graph = edge_graph(ground.skin.solved, ground.joined);
    const double radius = far_radius * ground.scale;
    std::vector<bool> is_near(ground.solved.size(), false);
    for (const std::uint32_t place : movers) {
        const std::vector<double> d = surface_distances(graph, place, radius);
        for (std::size_t p = 0; p < d.size(); ++p)
            if (d[p] <= radius && ground.solved[p]) is_near[p] = true;
    }
    std::vector<std::uint32_t> near;
    for (std::uint32_t p = 0; p < is_near.size(); ++p)
        if (is_near[p]) near.push_back(p);
    return near;
}

Eigen::MatrixXd smooth_part(const Ground& ground, const Movers& movers, const Eigen::VectorXd& q,
                            const PriorSetting& setting) {
    const double scale = ground.scale;
    const Laplacian surface = laplacian(ground.skin.solved, ground.joined);
    Sparse energy = surface.stiffness * Eigen::VectorXd(surface.areas.cwiseInverse()).asDiagonal() * surface.stiffness;
    energy += setting.a / (scale * scale) * surface.stiffness;
    energy += drift / std::pow(scale, 4) * Sparse(surface.areas.asDiagonal());
    const Sparse to_near = picks(energy.rows(), near_places(ground, movers.places));
    const Sparse near_to_movers = to_near.transpose() * picks(energy.rows(), movers.places);
    const Sparse within = to_near.transpose() * energy * to_near;
    Eigen::MatrixXd G = to_near * solve_checked(within, Eigen::MatrixXd(near_to_movers), "rig prior");
    if (const Pockets& pockets = ground.skin.pockets; !pockets.places.empty())
        G(pockets.places, Eigen::all) = Eigen::MatrixXd(fill_pockets(ground.face.mesh, ground.joined, pockets, G));
    G = (q.asDiagonal() * G).eval();
    double mean = 0;
    for (Eigen::Index f = 0; f < G.cols(); ++f) {
        const std::uint32_t place = movers.places[static_cast<std::size_t>(f)];
        G.col(f) *= q[place];
        mean += G(place, f) / static_cast<double>(G.cols());
    }
    return setting.g / mean * G;
}

// The fields beside each other: places x 3 shapes.
Eigen::MatrixXd side_by_side(std::span<const Field> shapes, Eigen::Index places) {
    Eigen::MatrixXd all(places, 3 * std::ssize(shapes));
    for (std::size_t k = 0; k < shapes.size(); ++k) all.middleCols<3>(3 * static_cast<Eigen::Index>(k)) = shapes[k];
    return all;
}

void add_copy(Eigen::MatrixXd& S, const Ground& ground, const Movers& movers, std::span<const Field> shapes,
              const PriorSetting& setting) {
    const Eigen::MatrixXd all = side_by_side(shapes, S.rows());
    const auto at_place = [&](std::uint32_t p) { return position(ground.face.mesh, ground.joined, p); };
    tbb::parallel_for(std::size_t{0}, movers.places.size(), [&](std::size_t f) {
        const std::uint32_t at = movers.places[f];
        const Eigen::VectorXd own = all.row(at).transpose();
        const Vec3 from = at_place(at);
        for (std::uint32_t p = 0; p < S.rows(); ++p) {
            const double d = distance(at_place(p), from) / (ground.scale * setting.sw);
            S(p, static_cast<Eigen::Index>(f)) += setting.s * all.row(p).dot(own) * std::exp(-d * d / 2);
        }
    });
}

}  // namespace

Ground ground_of(const Face& face) {
    Ground ground{face, weld(face.mesh), {}, {}, face_scale(face), {}};
    check_face(face, ground.joined);
    ground.solved = solved_places(face, ground.joined);
    for (const FeaturePoint& point : face.points)
        if (ground.solved[ground.joined.place[point.vertex]])
            ground.points.push_back(ground.joined.place[point.vertex]);
    ground.skin = sheet_skin(face, ground.joined, ground.solved, ground.scale);
    return ground;
}

double squared_size(const Field& field) {
    return field.squaredNorm();
}

std::vector<double> evening_factors(std::span<const Field> shapes, Places places, double beta) {
    double mean = 0;
    for (const Field& shape : shapes) mean += std::sqrt(squared_size(shape)) / static_cast<double>(shapes.size());
    std::vector<double> factors;
    double motion = 0;
    for (const Field& shape : shapes) {
        factors.push_back(std::pow(std::sqrt(squared_size(shape)) / mean, -beta));
        motion += factors.back() * factors.back() * squared_at({&shape, 1}, places);
    }
    if (motion > 0)
        for (double& factor : factors) factor *= std::sqrt(static_cast<double>(places.size()) / motion);
    return factors;
}

Learnt learn(const Ground& ground, std::span<const Field> own, std::span<const Field> helpers,
             const PriorSetting& setting) {
    const Places places = ground.points;
    Learnt learnt;
    const std::vector<double> factors = evening_factors(own, places, setting.beta);
    add_scaled(learnt.all, own, factors, 1);
    if (!helpers.empty()) {
        const std::vector<double> more = evening_factors(helpers, places, setting.beta);
        const double size = total_size(own, factors), helper_size = total_size(helpers, more);
        add_scaled(learnt.all, helpers, more, std::sqrt(setting.x * size / helper_size));
    }
    const double motion = squared_at(learnt.all, places);
    if (motion > 0)
        for (Field& shape : learnt.all) shape *= std::sqrt(static_cast<double>(places.size()) / motion);
    learnt.mobility = mobility_of(ground, learnt.all, setting);
    return learnt;
}

Eigen::MatrixXd kernel(const Ground& ground, const Movers& movers, const Learnt& learnt, const PriorSetting& setting) {
    Eigen::MatrixXd S = smooth_part(ground, movers, learnt.mobility, setting);
    add_copy(S, ground, movers, learnt.all, setting);
    return S / 3;
}

}  // namespace mien
