// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The rigid motion between two rows of head markers, p' = R p + t (Kshirsagar et al., section 4.1, eq. 6).
//
// Least squares: Kabsch and Horn; not in the paper, which calls it needless for accurate captures.
//
// Three markers: eq. 7-10 as written. Differences of markers drop t, their unit vectors m obey m' = R m, and three of
// them make a 3 x 3 linear system. Two come from the three markers; the third, the pseudo-correspondence, is orthogonal
// to both. t follows from eq. 6 at the first marker. Where the markers are not quite rigid, the solution R is not quite
// a rotation; a pose can only hold one, so the nearest rotation is taken. In a picture the third vector is the normal
// of the plane.

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "algorithms/head.hpp"
#include "algorithms/rotation.hpp"

namespace mien {

bool tell_a_pose(std::span<const Vec3> markers, bool planar) {
    if (markers.size() < (planar ? 2 : 3)) return false;
    const std::array<double, 3> spread = spreads(markers);
    return planar ? spread[0] > 0 : spread[1] > 1e-3 * spread[0];
}

std::optional<Pose> least_squares_pose(std::span<const Vec3> reference, std::span<const Vec3> now, bool planar) {
    if (!tell_a_pose(reference, planar) || !tell_a_pose(now, planar)) return std::nullopt;
    const Quaternion rotation = planar ? best_rotation_in_plane(reference, now) : best_rotation(reference, now);
    return Pose{rotation, centre(now) - rotate(rotation, centre(reference))};
}

namespace {

template <class Measure>
std::size_t index_of_largest(std::size_t count, Measure measure) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < count; ++i)
        if (measure(i) > measure(best)) best = i;
    return best;
}

// Farthest from the middle, farthest from that one, farthest from the line through both.
std::array<std::size_t, 3> widest_three(std::span<const Vec3> p) {
    const Vec3 middle = centre(p);
    const std::size_t a = index_of_largest(p.size(), [&](std::size_t i) { return distance(p[i], middle); });
    const std::size_t b = index_of_largest(p.size(), [&](std::size_t i) { return distance(p[i], p[a]); });
    const std::size_t c =
        index_of_largest(p.size(), [&](std::size_t i) { return length(cross(p[b] - p[a], p[i] - p[a])); });
    return {a, b, c};
}

Vec3 unit(const Vec3& v) {
    return v / length(v);
}

// The three m of eq. 10 as columns.
std::array<Vec3, 3> directions(std::span<const Vec3> p, bool planar) {
    const Vec3 m1 = unit(p[1] - p[0]);
    const Vec3 m2 = planar ? Vec3{0, 0, 1} : unit(p[2] - p[1]);
    return {m1, m2, unit(cross(m1, m2))};
}

Eigen::Matrix3d matrix(const std::array<Vec3, 3>& columns) {
    Eigen::Matrix3d m;
    for (std::size_t k = 0; k < 3; ++k) m.col(static_cast<Eigen::Index>(k)) << columns[k].x, columns[k].y, columns[k].z;
    return m;
}

}  // namespace

std::optional<Pose> three_marker_pose(std::span<const Vec3> reference, std::span<const Vec3> now, bool planar) {
    if (!tell_a_pose(reference, planar)) return std::nullopt;
    std::vector<Vec3> p, p_now;
    for (const std::size_t i : widest_three(reference)) {
        p.push_back(reference[i]);
        p_now.push_back(now[i]);
    }
    if (p_now[0] == p_now[1] || !(planar || tell_a_pose(p_now, planar))) return std::nullopt;
    const Eigen::Matrix3d m = matrix(directions(p, planar));
    const Eigen::Matrix3d m_now = matrix(directions(p_now, planar));
    // R M = M', solved as M^T R^T = M'^T.
    const Eigen::Matrix3d r = m.transpose().partialPivLu().solve(m_now.transpose()).transpose();
    const auto column = [&](int k) { return Vec3{r(0, k), r(1, k), r(2, k)}; };
    const Quaternion rotation = nearest_rotation({column(0), column(1), column(2)});
    return Pose{rotation, p_now[0] - rotate(rotation, p[0])};
}

namespace {

double dot(const Quaternion& a, const Quaternion& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w;
}

Quaternion sum(double s, const Quaternion& a, double t, const Quaternion& b) {
    return {s * a.x + t * b.x, s * a.y + t * b.y, s * a.z + t * b.z, s * a.w + t * b.w};
}

Quaternion slerp(const Quaternion& a, const Quaternion& b, double part) {
    const double cosine = std::min(1.0, std::abs(dot(a, b)));
    const double side = dot(a, b) < 0 ? -1 : 1;
    const double angle = std::acos(cosine);
    const bool near = angle < 1e-6;
    const double s = near ? 1 - part : std::sin((1 - part) * angle) / std::sin(angle);
    const double t = near ? part : std::sin(part * angle) / std::sin(angle);
    const Quaternion q = sum(s, a, side * t, b);
    return sum(1 / std::sqrt(dot(q, q)), q, 0, q);
}

Pose between(const Pose& a, const Pose& b, double part, const Vec3& pivot) {
    const Quaternion rotation = slerp(a.rotation, b.rotation, part);
    const Vec3 middle = (1 - part) * apply(a, pivot) + part * apply(b, pivot);
    return {rotation, middle - rotate(rotation, pivot)};
}

// A quaternion and its negative are the same turn; neighbours take the same one, so that others can interpolate them.
void keep_on_one_side(std::vector<Pose>& poses) {
    for (std::size_t r = 1; r < poses.size(); ++r) {
        Quaternion& q = poses[r].rotation;
        if (dot(poses[r - 1].rotation, q) < 0) q = {-q.x, -q.y, -q.z, -q.w};
    }
}

}  // namespace

std::vector<Pose> carry_over(std::span<const std::optional<Pose>> poses, std::span<const double> times,
                             const Vec3& pivot) {
    std::vector<std::size_t> known;
    for (std::size_t r = 0; r < poses.size(); ++r)
        if (poses[r]) known.push_back(r);
    std::vector<Pose> result(poses.size());
    std::size_t next = 0;  // in `known`: the first that is not before the row
    for (std::size_t r = 0; r < poses.size() && !known.empty(); ++r) {
        while (next < known.size() && known[next] < r) ++next;
        const std::size_t after = known[std::min(next, known.size() - 1)];
        const std::size_t before = poses[r] || next == 0 ? after : known[next - 1];
        const double span = times[after] - times[before];
        result[r] = span > 0 ? between(*poses[before], *poses[after], (times[r] - times[before]) / span, pivot)
                             : *poses[before];
    }
    keep_on_one_side(result);
    return result;
}

}  // namespace mien
