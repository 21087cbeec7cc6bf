// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Retargeting by one linear map per point: how the target's neutral lies to the source's near that point.
//
// Each neutral is put into its own face's axes and divided by its eye distance. With s and t the points then, and
// w_i = 1 / (|s_i - s_j|^2 + 1), normalised, about the weighted means a and b:
//
//     M = sum w (s - a)(s - a)^T,  N = sum w (t - b)(s - a)^T,  r = 0.25 trace M,  A_j = (N + r G I)(M + r I)^-1
//
// with G the ratio of the root mean square radii. The ridge r pulls the map towards a change of size alone where the
// points say little: across a flat set, and for few points.
// A face has two alike halves, so A_j is averaged with the mirrored map of the point's partner on the other side; a
// source whose neutral is a little skew does not pull the target's mouth aside.
//
// Compared with a network that warps space: a warp stretches motion by its own slope, which between points is
// arbitrary. A chin that moves back by 13 mm did so by 37 mm on a narrower face, past the teeth.

#include "algorithms/retarget_local.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <vector>

#include "algorithms/rotation.hpp"
#include "algorithms/similarity.hpp"

#include "mien/error.hpp"
#include "mien/face.hpp"

namespace mien {

namespace {

constexpr double reach = 1;    // in eye distances: points nearer than that count about alike
constexpr double pull = 0.25;  // towards a change of size alone

using Points = Eigen::Matrix<double, 3, Eigen::Dynamic>;
using Maps = std::vector<Eigen::Matrix3d>;

Eigen::Vector3d eigen(const Vec3& v) {
    return {v.x, v.y, v.z};
}
Vec3 vec(const Eigen::Vector3d& v) {
    return {v[0], v[1], v[2]};
}

// The points in the axes of their face and in eye distances.
Points columns(const std::vector<Vec3>& points, const FaceFrame& frame) {
    const Vec3 origin = centre(points);
    Points result(3, points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
        result.col(static_cast<Eigen::Index>(i)) =
            eigen(rotate(conjugate(frame.turn), points[i] - origin)) / frame.eyes;
    return result;
}

// A_j.
Eigen::Matrix3d local_map(const Points& s, const Points& t, double G, Eigen::Index j) {
    Eigen::RowVectorXd w = ((s.colwise() - s.col(j)).colwise().squaredNorm().array() + reach * reach).inverse();
    w /= w.sum();
    const Points s_a = s.colwise() - Eigen::Vector3d(s * w.transpose());
    const Points t_b = t.colwise() - Eigen::Vector3d(t * w.transpose());
    const Eigen::Matrix3d M = s_a * w.asDiagonal() * s_a.transpose();
    const Eigen::Matrix3d N = t_b * w.asDiagonal() * s_a.transpose();
    const Eigen::Matrix3d ridge = pull * M.trace() * Eigen::Matrix3d::Identity();
    if (!(M.trace() > 0)) return G * Eigen::Matrix3d::Identity();
    return (M + ridge).ldlt().solve((N + G * ridge).transpose()).transpose();
}

// Index of each point's partner on the other side: its own on the midline, -1 where there is none.
std::vector<Eigen::Index> partners(const std::vector<std::string>& ids) {
    std::vector<Eigen::Index> result;
    for (const std::string& id : ids) {
        const auto found = std::find(ids.begin(), ids.end(), mirror_point(id));
        result.push_back(found == ids.end() ? -1 : found - ids.begin());
    }
    return result;
}

// The direction from one half of the target to the other, from all pairs at once; zero where there is no pair.
Eigen::Vector3d sideways(const Points& t, const std::vector<Eigen::Index>& partner) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (Eigen::Index i = 0; i < t.cols(); ++i) {
        const Eigen::Index m = partner[static_cast<std::size_t>(i)];
        if (m <= i) continue;
        const Eigen::Vector3d apart = t.col(i) - t.col(m);
        sum += sum.dot(apart) < 0 ? -apart : apart;
    }
    return sum.norm() > 0 ? Eigen::Vector3d(sum.normalized()) : sum;
}

Maps made_symmetric(const Maps& maps, const std::vector<Eigen::Index>& partner, const Eigen::Vector3d& across) {
    const Eigen::Matrix3d X = Eigen::Matrix3d::Identity() - 2 * across * across.transpose();
    Maps result = maps;
    for (std::size_t j = 0; j < maps.size(); ++j)
        if (partner[j] >= 0) result[j] = (maps[j] + X * maps[static_cast<std::size_t>(partner[j])] * X) / 2;
    return result;
}

}  // namespace

void fit_local_affine(Retarget& map, const FaceFrames& frames) {
    const FaceFrame &source = frames.source, &target = frames.target;
    const Points s = columns(map.source_neutral, source);
    const Points t = columns(map.target_neutral, target);
    const double G = best_similarity(map).ratio * source.eyes / target.eyes;
    Maps maps;
    for (Eigen::Index j = 0; j < s.cols(); ++j) maps.push_back(local_map(s, t, G, j));
    const std::vector<Eigen::Index> partner = partners(map.points);
    const Eigen::Vector3d across = frames.known ? Eigen::Vector3d::UnitX() : sideways(t, partner);
    if (across.norm() > 0) maps = made_symmetric(maps, partner, across);
    for (const Eigen::Matrix3d& A : maps) {
        const auto column = [&](const Vec3& axis) {
            const Eigen::Vector3d in_face = eigen(rotate(conjugate(source.turn), axis)) / source.eyes;
            return target.eyes * rotate(target.turn, vec(A * in_face));
        };
        map.local.push_back({column({1, 0, 0}), column({0, 1, 0}), column({0, 0, 1})});
        for (const Vec3& c : map.local.back())
            if (!is_finite(c)) throw Error("retarget: expected points within the range of numbers, found some beyond");
    }
}

}  // namespace mien
