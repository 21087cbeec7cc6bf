// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Shapes from head to head (docs/methods.md, "From the shapes of another head"). Lengths are in each head's own eye
// distances.
//
// 1. Warp: x -> A x + b + sum_i w_i |x - s_i|, through the shared points.
// 2. A place is described by where it is (after the warp) and by half of its weights of tension biharmonic
//    interpolation, each head's on its own surface: they keep upper from lower lip and lid.
// 3. For each place of the target the nearest of that description within the source's nearest triangles.
// 4. Motion is turned by the linear part of the best affine map from the source's points to the target's, and smoothed
//    by one implicit step of 0.02.
//
// Skin that the source does not have, its partner being far, gets less and less, and nothing beyond 0.5.

#include "mien/algorithms/carry_shapes.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "algorithms/island.hpp"
#include "algorithms/laplacian.hpp"
#include "algorithms/nearest_places.hpp"
#include "algorithms/sparse_solve.hpp"

#include "mien/algorithms/attach.hpp"
#include "mien/algorithms/rig_biharmonic.hpp"
#include "mien/error.hpp"

namespace mien {

namespace {

constexpr double weight_share = 0.5;
constexpr double smoothing = 0.02;
constexpr double near_gap = 0.2, far_gap = 0.5;
constexpr std::size_t candidates = 24;  // triangles looked at
constexpr int steps = 6;                // along a side of a triangle: where its points are looked at

using Points = Eigen::Matrix<double, Eigen::Dynamic, 3>;

Eigen::RowVector3d row_of(const Vec3& p) {
    return {p.x, p.y, p.z};
}

// One head as it takes part: places in eye distances, and their weights.
struct Party {
    Weld joined;
    std::vector<bool> solved;
    double scale;
    Points points;          // the shared feature points
    Points places;          // all places
    Eigen::MatrixXd looks;  // per place: position, then half of its weights
};

Eigen::MatrixXd weights_on_places(const Face& face, const Weld& joined) {
    BiharmonicOptions all;
    all.influences = 0;
    all.cut_pockets = false;
    const Rig rig = rig_biharmonic(face, all);
    Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(std::ssize(joined.vertex), std::ssize(face.points));
    for (std::size_t p = 0; p < joined.vertex.size(); ++p)
        for (std::uint32_t e = rig.row_starts[joined.vertex[p]]; e < rig.row_starts[joined.vertex[p] + 1]; ++e)
            weights(static_cast<Eigen::Index>(p), rig.row_points[e]) = rig.weights[e].x;
    return weights;
}

// `face`: with the shared points alone, free to move.
Party party_of(const Face& face) {
    Party party{weld(face.mesh), {}, face_scale(face), {}, {}, {}};
    const Eigen::MatrixXd weights = weights_on_places(face, party.joined);
    party.solved = solved_places(face, party.joined);
    party.points.resize(std::ssize(face.points), 3);
    for (std::size_t i = 0; i < face.points.size(); ++i)
        party.points.row(static_cast<Eigen::Index>(i)) =
            row_of(to_double(face.mesh.positions[face.points[i].vertex]) / party.scale);
    party.places.resize(weights.rows(), 3);
    for (std::uint32_t p = 0; p < party.joined.vertex.size(); ++p)
        party.places.row(p) = row_of(position(face.mesh, party.joined, p) / party.scale);
    party.looks.resize(weights.rows(), 3 + weights.cols());
    party.looks << party.places, weight_share * weights;
    return party;
}

// Rows of (distance to each centre, 1, x, y, z).
Eigen::MatrixXd warp_terms(const Points& at, const Points& centres) {
    Eigen::MatrixXd terms(at.rows(), centres.rows() + 4);
    for (Eigen::Index i = 0; i < centres.rows(); ++i) terms.col(i) = (at.rowwise() - centres.row(i)).rowwise().norm();
    terms.col(centres.rows()).setOnes();
    terms.rightCols<3>() = at;
    return terms;
}

// The source's places where the warp takes them.
Points warped(const Points& places, const Points& from, const Points& to) {
    const Eigen::Index n = from.rows();
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + 4, n + 4);
    system.topRows(n) = warp_terms(from, from);
    system.bottomLeftCorner(4, n) = system.topRightCorner(n, 4).transpose();
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(n + 4, 3);
    right.topRows(n) = to;
    // Points in one plane leave the affine part open across it; the smallest one is taken.
    return warp_terms(places, from) * system.completeOrthogonalDecomposition().solve(right);
}

// The linear part of the affine map from points to points that is best in least squares.
Eigen::Matrix3d best_linear(const Points& from, const Points& to) {
    const Points s = from.rowwise() - from.colwise().mean(), t = to.rowwise() - to.colwise().mean();
    const Eigen::Matrix3d within = s.transpose() * s;
    const double ridge = 1e-3 * within.trace();
    const double ratio = std::sqrt(t.squaredNorm() / s.squaredNorm());
    const Eigen::Matrix3d both = s.transpose() * t + ratio * ridge * Eigen::Matrix3d::Identity();
    return (within + ridge * Eigen::Matrix3d::Identity()).ldlt().solve(both).transpose();
}

using Triangle = std::array<std::uint32_t, 3>;

std::vector<Triangle> skin_triangles(const Mesh& mesh, const Party& party) {
    std::vector<Triangle> triangles;
    for (std::size_t f = 0; f < face_count(mesh); ++f) {
        const auto corners = face(mesh, f);
        const auto place = [&](std::size_t k) { return party.joined.place[corners[k]]; };
        if (!party.solved[place(0)]) continue;
        for (std::size_t k = 1; k + 1 < corners.size(); ++k) triangles.push_back({place(0), place(k), place(k + 1)});
    }
    return triangles;
}

NearestPlaces middles(const std::vector<Triangle>& triangles, const Points& places) {
    std::vector<Vec3> middles;
    for (const Triangle& t : triangles) {
        const Eigen::RowVector3d sum = places.row(t[0]) + places.row(t[1]) + places.row(t[2]);
        middles.push_back(Vec3{sum[0], sum[1], sum[2]} / 3);
    }
    return NearestPlaces(std::move(middles));
}

// Where on the source a place of the target has its partner.
struct Partner {
    double difference = std::numeric_limits<double>::infinity();  // squared, of the descriptions
    Triangle places{};
    Eigen::RowVector3d shares = Eigen::RowVector3d::Zero();
};

// The best point of one triangle: the squared difference at shares b is b'Db.
void look_at(Partner& best, const Triangle& triangle, const Eigen::MatrixXd& looks, const Eigen::RowVectorXd& wanted) {
    Eigen::MatrixXd off(3, wanted.size());
    for (Eigen::Index k = 0; k < 3; ++k) off.row(k) = looks.row(triangle[static_cast<std::size_t>(k)]) - wanted;
    const Eigen::Matrix3d D = off * off.transpose();
    for (int i = 0; i <= steps; ++i)
        for (int j = 0; i + j <= steps; ++j) {
            const Eigen::RowVector3d b = Eigen::RowVector3d(i, j, steps - i - j) / steps;
            const double difference = (b * D).dot(b);
            if (difference < best.difference) best = {difference, triangle, b};
        }
}

std::vector<Partner> partners(const Mesh& source_mesh, const Party& source, const Party& target) {
    const std::vector<Triangle> triangles = skin_triangles(source_mesh, source);
    const NearestPlaces tree = middles(triangles, source.looks.leftCols<3>());
    std::vector<Partner> found(target.solved.size());
    tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t p) {
        if (!target.solved[p]) return;
        const Eigen::RowVectorXd wanted = target.looks.row(static_cast<Eigen::Index>(p));
        for (const std::uint32_t t : tree.nearest({wanted[0], wanted[1], wanted[2]}, candidates))
            look_at(found[p], triangles[t], source.looks, wanted);
    });
    return found;
}

// How much of its partner's motion a place takes: none where the source has no skin.
double share_of(const Partner& partner, const Party& source, const Party& target, std::size_t place) {
    Eigen::RowVector3d at = Eigen::RowVector3d::Zero();
    for (std::size_t k = 0; k < 3; ++k)
        at += partner.shares[static_cast<Eigen::Index>(k)] * source.looks.row(partner.places[k]).head<3>();
    const double gap = (at - target.places.row(static_cast<Eigen::Index>(place))).norm();
    return std::clamp((far_gap - gap) / (far_gap - near_gap), 0.0, 1.0);
}

// Places x 3 shapes, in eye distances.
Eigen::MatrixXd motions(std::span<const MorphTarget> shapes, const Party& party) {
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(std::ssize(party.joined.vertex), 3 * std::ssize(shapes));
    for (std::size_t k = 0; k < shapes.size(); ++k)
        for (std::size_t i = 0; i < shapes[k].vertices.size(); ++i) {
            const std::uint32_t v = shapes[k].vertices[i], place = party.joined.place.at(v);
            if (party.joined.vertex[place] == v)
                all.block<1, 3>(place, 3 * static_cast<Eigen::Index>(k)) =
                    row_of(to_double(shapes[k].deltas[i]) / party.scale);
        }
    return all;
}

Eigen::MatrixXd smoothed(const Eigen::MatrixXd& moved, const Mesh& mesh, const Party& party) {
    const Laplacian surface = laplacian(mesh, party.joined, Cotangents::positive);
    Eigen::SparseMatrix<double> step = std::pow(smoothing * party.scale, 2) * surface.stiffness;
    step += Eigen::SparseMatrix<double>(surface.areas.asDiagonal());
    return solve_checked(step, surface.areas.asDiagonal() * moved, "carry shapes");
}

Eigen::MatrixXd carried(const Eigen::MatrixXd& all, const Mesh& source_mesh, const Party& source, const Party& target) {
    const Eigen::Matrix3d turn = best_linear(source.points, target.points);
    const std::vector<Partner> partner = partners(source_mesh, source, target);
    Eigen::MatrixXd moved = Eigen::MatrixXd::Zero(std::ssize(partner), all.cols());
    tbb::parallel_for(std::size_t{0}, partner.size(), [&](std::size_t p) {
        if (!std::isfinite(partner[p].difference)) return;
        Eigen::RowVectorXd motion = Eigen::RowVectorXd::Zero(all.cols());
        for (std::size_t k = 0; k < 3; ++k)
            motion += partner[p].shares[static_cast<Eigen::Index>(k)] * all.row(partner[p].places[k]);
        motion *= share_of(partner[p], source, target, p);
        for (Eigen::Index k = 0; k < all.cols(); k += 3)
            moved.block<1, 3>(static_cast<Eigen::Index>(p), k) = motion.segment<3>(k) * turn.transpose();
    });
    return moved;
}

MorphTarget target_of(const std::string& name, const Eigen::MatrixXd& moved, Eigen::Index first, const Party& party) {
    constexpr double smallest = 1e-5;
    MorphTarget target{name, {}, {}};
    for (std::uint32_t v = 0; v < party.joined.place.size(); ++v) {
        const std::uint32_t place = party.joined.place[v];
        const Eigen::RowVector3d motion = moved.block<1, 3>(place, first);
        if (!party.solved[place] || motion.norm() < smallest) continue;
        target.vertices.push_back(v);
        target.deltas.push_back(to_float(party.scale * Vec3{motion[0], motion[1], motion[2]}));
    }
    return target;
}

// The face with the points that the other has too, free along all axes.
Face sharing(const Face& face, const Face& other) {
    Face shared{face.mesh, {}};
    for (const FeaturePoint& point : face.points)
        if (find_point(other.points, point.id)) shared.points.push_back(point);
    for (FeaturePoint& point : shared.points) point.moves = {};
    std::sort(shared.points.begin(), shared.points.end(),
              [](const FeaturePoint& a, const FeaturePoint& b) { return a.id < b.id; });
    return shared;
}

// Points on an eyeball move no skin and say nothing about it.
void keep_skin_points(Face& a, Face& b) {
    const auto drop = [](Face& face, Face& other) {
        const Weld joined = weld(face.mesh);
        const std::vector<bool> solved = solved_places(face, joined);
        for (std::size_t i = face.points.size(); i-- > 0;) {
            if (solved[joined.place[face.points[i].vertex]]) continue;
            face.points.erase(face.points.begin() + static_cast<std::ptrdiff_t>(i));
            other.points.erase(other.points.begin() + static_cast<std::ptrdiff_t>(i));
        }
    };
    drop(a, b);
    drop(b, a);
}

}  // namespace

std::vector<MorphTarget> carry_shapes(const Face& source, std::span<const MorphTarget> shapes, const Face& target) {
    Face from = sharing(source, target), to = sharing(target, source);
    keep_skin_points(from, to);
    if (from.points.size() < 4)
        throw Error(fmt::format("carry shapes: expected at least 4 feature points on the skin of both heads, found {}",
                                from.points.size()));
    for (const MorphTarget& shape : shapes)
        for (const std::uint32_t v : shape.vertices)
            if (v >= vertex_count(source.mesh))
                throw Error(fmt::format("shape \"{}\": expected vertices below {}, found {}", shape.name,
                                        vertex_count(source.mesh), v));
    Party own = party_of(from);
    const Party other = party_of(to);
    own.looks.leftCols<3>() = warped(own.places, own.points, other.points);
    const Eigen::MatrixXd moved = smoothed(carried(motions(shapes, own), from.mesh, own, other), to.mesh, other);
    std::vector<MorphTarget> result;
    for (std::size_t k = 0; k < shapes.size(); ++k)
        result.push_back(target_of(shapes[k].name, moved, 3 * static_cast<Eigen::Index>(k), other));
    return result;
}

}  // namespace mien
