// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Parts that hang on the jaw. Their pose in every row is the best rigid one. Turn vectors are fitted to the parameters
// of the jaw by least squares; the centre c and the shifts b_k follow from t = (I - R) c + sum_k f_k b_k, drawn a
// little towards the middle of the part where a turn leaves c open along its axis.

#include "algorithms/rigid_parts.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>

#include "algorithms/island.hpp"
#include "algorithms/rotation.hpp"

namespace mien {

namespace {

using Index = Eigen::Index;

constexpr double keeps_shape = 0.02;  // of how far it moves
constexpr double moves = 0.005;       // eye distances
constexpr std::array jaw_faps{3, 14, 15};

std::vector<Vec3> places_in(std::span<const Vec3f> row, std::span<const std::uint32_t> vertices) {
    std::vector<Vec3> result;
    result.reserve(vertices.size());
    for (const std::uint32_t v : vertices) result.push_back(to_double(row[v]));
    return result;
}

Pose pose_between(std::span<const Vec3> from, std::span<const Vec3> to) {
    const Quaternion turn = best_rotation(from, to);
    return {turn, centre(to) - rotate(turn, centre(from))};
}

double off_by(const Pose& pose, std::span<const Vec3> from, std::span<const Vec3> to) {
    double squares = 0;
    for (std::size_t i = 0; i < from.size(); ++i) {
        const Vec3 off = apply(pose, from[i]) - to[i];
        squares += dot(off, off) / static_cast<double>(from.size());
    }
    return std::sqrt(squares);
}

// An island over the rows.
struct Candidate {
    RigidPart part;
    std::vector<std::vector<Vec3>> rows;
    std::vector<Vec3> rest;
    double reach = 0, off = 0;  // largest of all rows
};

bool is_rigid(const Candidate& candidate, double scale) {
    return candidate.reach > moves * scale && candidate.off < keeps_shape * candidate.reach;
}

bool moves_alike(const Candidate& a, const Candidate& b) {
    for (std::size_t r = 0; r < a.rows.size(); ++r)
        if (off_by(a.part.poses[r], b.rest, b.rows[r]) > keeps_shape * std::max(a.reach, b.reach)) return false;
    return true;
}

std::vector<Candidate> candidates(const UprightSequence& upright, const Weld& weld, const std::vector<bool>& others) {
    const Face face{upright.sequence.mesh, upright.points};
    const std::vector<Island> list = list_islands(face, weld);
    std::vector<std::uint32_t> island(weld.vertex.size(), 0);
    std::size_t largest = 0;
    for (std::uint32_t i = 0; i < list.size(); ++i) {
        for (const std::uint32_t place : list[i].places) island[place] = i;
        if (list[i].places.size() > list[largest].places.size()) largest = i;
    }
    std::vector<Candidate> all(list.size());
    std::vector<bool> taken(list.size(), false);
    for (std::uint32_t v = 0; v < weld.place.size(); ++v) {
        const std::uint32_t i = island[weld.place[v]];
        all[i].part.vertices.push_back(v);
        if (others[v]) taken[i] = true;
    }
    constexpr std::size_t least = 4;
    std::vector<Candidate> result;
    for (std::uint32_t i = 0; i < list.size(); ++i) {
        if (i == largest || taken[i] || !list[i].has_faces || list[i].places.size() < least) continue;
        all[i].part.name = list[i].part.empty() ? fmt::format("part {}", i) : list[i].part;
        all[i].rest = places_in(face.mesh.positions, all[i].part.vertices);
        result.push_back(std::move(all[i]));
    }
    return result;
}

}  // namespace

std::vector<RigidPart> rigid_parts(const UprightSequence& upright, const Weld& weld, std::span<const std::size_t> rows,
                                   const std::vector<bool>& others) {
    std::vector<Candidate> all = candidates(upright, weld, others);
    if (all.empty()) return {};
    std::vector<Vec3f> row(vertex_count(upright.sequence.mesh));
    for (const std::size_t r : rows) {
        upright.sequence.positions(r, row);
        for (Candidate& candidate : all) {
            candidate.rows.push_back(places_in(row, candidate.part.vertices));
            candidate.part.poses.push_back(pose_between(candidate.rest, candidate.rows.back()));
            candidate.reach = std::max(candidate.reach, off_by({}, candidate.rest, candidate.rows.back()));
            candidate.off =
                std::max(candidate.off, off_by(candidate.part.poses.back(), candidate.rest, candidate.rows.back()));
        }
    }
    const double scale = face_scale({upright.sequence.mesh, upright.points});
    std::vector<Candidate> kept;
    for (Candidate& candidate : all) {
        if (!is_rigid(candidate, scale)) continue;
        const auto same = std::find_if(kept.begin(), kept.end(),
                                       [&](const Candidate& other) { return moves_alike(other, candidate); });
        if (same == kept.end()) {
            kept.push_back(std::move(candidate));
            continue;
        }
        std::vector<std::uint32_t>& vertices = same->part.vertices;
        vertices.insert(vertices.end(), candidate.part.vertices.begin(), candidate.part.vertices.end());
        std::sort(vertices.begin(), vertices.end());
    }
    std::vector<RigidPart> parts;
    parts.reserve(kept.size());
    for (Candidate& candidate : kept) parts.push_back(std::move(candidate.part));
    return parts;
}

namespace {

Vec3 turn_vector(const Quaternion& q) {
    const Vec3 v = (q.w < 0 ? -1.0 : 1.0) * Vec3{q.x, q.y, q.z};
    const double s = length(v);
    return s > 0 ? (2 * std::atan2(s, std::abs(q.w)) / s) * v : Vec3{};
}

Quaternion turn_of(const Vec3& vector) {
    const double angle = length(vector);
    if (!(angle > 0)) return {};
    const Vec3 v = (std::sin(angle / 2) / angle) * vector;
    return {v.x, v.y, v.z, std::cos(angle / 2)};
}

Eigen::Vector3d eigen(const Vec3& v) {
    return {v.x, v.y, v.z};
}

// The values of the jaw's parameters: rows x parameters that have a column.
Eigen::MatrixXd jaw_values(const FapColumns& columns, std::vector<int>& numbers) {
    std::vector<Index> picked;
    for (const int fap : jaw_faps) {
        const auto at = std::find(columns.faps.begin(), columns.faps.end(), fap);
        if (at == columns.faps.end()) continue;
        numbers.push_back(fap);
        picked.push_back(at - columns.faps.begin());
    }
    Eigen::MatrixXd values(columns.values.rows(), static_cast<Index>(picked.size()));
    for (std::size_t k = 0; k < picked.size(); ++k) values.col(static_cast<Index>(k)) = columns.values.col(picked[k]);
    return values;
}

Eigen::MatrixXd least_squares(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
    Eigen::MatrixXd normal = a.transpose() * a;
    normal.diagonal() *= 1 + 1e-9;
    normal.diagonal().array() += 1e-12;
    return normal.ldlt().solve(a.transpose() * b);
}

// Centre and shifts, the centre seen from `middle`.
Eigen::VectorXd centre_and_shifts(const RigidPart& part, const Eigen::MatrixXd& values, const Vec3& middle) {
    const Index rows = values.rows(), k = values.cols();
    constexpr double pull = 1e-6;
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(3 * rows + 3, 3 + 3 * k);
    Eigen::VectorXd b = Eigen::VectorXd::Zero(3 * rows + 3);
    for (Index r = 0; r < rows; ++r) {
        const Pose& pose = part.poses[static_cast<std::size_t>(r)];
        const std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
        for (Index j = 0; j < 3; ++j) {
            const Vec3& axis = axes[static_cast<std::size_t>(j)];
            a.block(3 * r, j, 3, 1) = eigen(axis - rotate(pose.rotation, axis));
            for (Index i = 0; i < k; ++i) a(3 * r + j, 3 + 3 * i + j) = values(r, i);
        }
        b.segment(3 * r, 3) = eigen(apply(pose, middle) - middle);
    }
    a.bottomLeftCorner(3, 3) = pull * std::sqrt(static_cast<double>(rows)) * Eigen::Matrix3d::Identity();
    return least_squares(a, b);
}

}  // namespace

PartFit fit_part(const RigidPart& part, const Mesh& mesh, const FapColumns& columns) {
    std::vector<int> numbers;
    const Eigen::MatrixXd values = jaw_values(columns, numbers);
    const std::vector<Vec3> rest = places_in(mesh.positions, part.vertices);
    const Vec3 middle = centre(rest);
    PartFit fit{middle, {}, std::numeric_limits<double>::infinity()};
    if (numbers.empty()) return fit;
    Eigen::MatrixXd turns(values.rows(), 3);
    for (Index r = 0; r < values.rows(); ++r)
        turns.row(r) = eigen(turn_vector(part.poses[static_cast<std::size_t>(r)].rotation)).transpose();
    const Eigen::MatrixXd per_unit = least_squares(values, turns);
    const Eigen::VectorXd where = centre_and_shifts(part, values, middle);
    fit.centre = middle + Vec3{where[0], where[1], where[2]};
    const auto vector_of = [&](Index k) { return Vec3{per_unit(k, 0), per_unit(k, 1), per_unit(k, 2)}; };
    const auto shift_of = [&](Index k) { return Vec3{where[3 + 3 * k], where[4 + 3 * k], where[5 + 3 * k]}; };
    for (Index k = 0; k < values.cols(); ++k) {
        const Vec3 turn = vector_of(k), shift = shift_of(k);
        const int fap = numbers[static_cast<std::size_t>(k)];
        if (const double angle = length(turn); angle > 0)
            fit.transforms.push_back({fap, {0, TransformField::rotation, turn / angle, angle, {}, {}}});
        fit.transforms.push_back({fap, {0, TransformField::translation, {0, 0, 1}, 0, shift, {}}});
    }
    double squares = 0;
    for (Index r = 0; r < values.rows(); ++r) {
        Quaternion turn;
        Vec3 shift;
        for (Index k = 0; k < values.cols(); ++k) {
            turn = turn_of(values(r, k) * vector_of(k)) * turn;
            shift += values(r, k) * shift_of(k);
        }
        const Pose made{turn, fit.centre - rotate(turn, fit.centre) + shift};
        std::vector<Vec3> now;
        now.reserve(rest.size());
        for (const Vec3& p : rest) now.push_back(apply(part.poses[static_cast<std::size_t>(r)], p));
        const double off = off_by(made, rest, now);
        squares += off * off / static_cast<double>(values.rows());
    }
    fit.error = std::sqrt(squares);
    return fit;
}

}  // namespace mien
