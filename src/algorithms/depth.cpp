// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Depth for the points of a picture. Of the motion of a face, a third to a half goes along the line of sight; a target
// that is moved without it has its chin drop straight down through the neck.
//
// With S the motions of known expressions (x and y of every point in a column each) and d those seen in a frame, the
// mixture is the w >= 0 that minimises |S w - d|^2 + k^2 |w|^2, k = 0.3 of the root mean square length of a column: a
// convex problem with one answer, which moves continuously with d. It is solved by a fixed number of sweeps over the
// coordinates. The other estimate is b.(dx, dy) with b by least squares over the expressions, point by point.

#include "mien/algorithms/depth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "algorithms/generic_face.hpp"
#include "algorithms/rotation.hpp"
#include "algorithms/shape_motions.hpp"

#include "mien/face.hpp"

namespace mien {

namespace {

constexpr double trust = 0.7;      // in either estimate; less is safer where they are wrong
constexpr double restraint = 0.3;  // on the mixture, in lengths of a column
constexpr int sweeps = 100;

// How the face lies in the picture: p = eyes * rotate(turn, q) + origin, with y of the picture turned over first.
struct Lie {
    bool upside_down = false;
    Quaternion turn;
    double eyes = 1;
    Vec3 origin;
};

Vec3 upright(const Vec3& p, bool upside_down) {
    return {p.x, upside_down ? -p.y : p.y, 0};
}

// Generic places of the columns that have one and are seen, and where these stand in the picture.
struct Known {
    std::vector<Vec3> generic, seen;
};

Known known_points(const Take& take, const std::vector<Vec3>& rest, bool upside_down) {
    Known known;
    for (std::size_t c = 0; c < rest.size(); ++c) {
        const std::optional<Vec3> place = generic_position(take.points[c]);
        if (!place || !is_finite(rest[c])) continue;
        known.generic.push_back({place->x, place->y, 0});
        known.seen.push_back(upright(rest[c], upside_down));
    }
    return known;
}

// The similarity in the plane and what it leaves over, squared.
std::pair<Lie, double> best_lie(const Known& known, bool upside_down) {
    Lie lie{upside_down, best_rotation_in_plane(known.generic, known.seen), 1, {}};
    const Vec3 a = centre(known.generic), b = centre(known.seen);
    double along = 0, square = 0, left = 0;
    for (std::size_t i = 0; i < known.seen.size(); ++i) {
        const Vec3 q = rotate(lie.turn, known.generic[i] - a);
        along += dot(q, known.seen[i] - b);
        square += dot(q, q);
    }
    if (square > 0 && along > 0) lie.eyes = along / square;
    lie.origin = b - lie.eyes * rotate(lie.turn, a);
    for (std::size_t i = 0; i < known.seen.size(); ++i) {
        const Vec3 miss = lie.eyes * rotate(lie.turn, known.generic[i]) + lie.origin - known.seen[i];
        left += dot(miss, miss);
    }
    return {lie, left};
}

using Shapes = std::vector<std::vector<Vec3>>;

// b of every point, by least squares over the expressions; zero where a point hardly moves in them.
std::vector<std::array<double, 2>> slopes(const Shapes& shapes, std::size_t points) {
    std::vector<std::array<double, 2>> result(points);
    for (std::size_t c = 0; c < points; ++c) {
        double xx = 1e-6, xy = 0, yy = 1e-6, xz = 0, yz = 0;
        for (const std::vector<Vec3>& shape : shapes) {
            const Vec3& d = shape[c];
            xx += d.x * d.x, xy += d.x * d.y, yy += d.y * d.y, xz += d.x * d.z, yz += d.y * d.z;
        }
        const double determinant = xx * yy - xy * xy;
        result[c] = {(xz * yy - yz * xy) / determinant, (yz * xx - xz * xy) / determinant};
    }
    return result;
}

double square_in_picture(const std::vector<Vec3>& shape) {
    double sum = 0;
    for (const Vec3& d : shape) sum += d.x * d.x + d.y * d.y;
    return sum;
}

// Solves for the mixture of one frame after another, in memory of its own.
class Mixture {
public:
    explicit Mixture(const Shapes& shapes)
        : shapes_(shapes), matrix_(shapes.size() * shapes.size()), right_(shapes.size()), weights_(shapes.size()) {
        for (const std::vector<Vec3>& shape : shapes)
            ridge_ += restraint * restraint * square_in_picture(shape) / static_cast<double>(shapes.size());
    }

    // `motion`: one per point, lost where it was not seen.
    const std::vector<double>& solve(const std::vector<Vec3>& motion) {
        const std::size_t n = shapes_.size();
        for (std::size_t i = 0; i < n; ++i) {
            right_[i] = product(motion, [&](std::size_t c) { return std::pair(shapes_[i][c], motion[c]); });
            for (std::size_t j = 0; j <= i; ++j)
                matrix_[i * n + j] = matrix_[j * n + i] =
                    product(motion, [&](std::size_t c) { return std::pair(shapes_[i][c], shapes_[j][c]); });
        }
        std::fill(weights_.begin(), weights_.end(), 0.0);
        if (ridge_ > 0)
            for (int sweep = 0; sweep < sweeps; ++sweep)
                for (std::size_t i = 0; i < n; ++i) step(i);
        return weights_;
    }

private:
    void step(std::size_t i) {
        const std::size_t n = shapes_.size();
        double rest = right_[i];
        for (std::size_t j = 0; j < n; ++j)
            if (j != i) rest -= matrix_[i * n + j] * weights_[j];
        weights_[i] = std::max(0.0, rest / (matrix_[i * n + i] + ridge_));
    }

    template <class Both>
    static double product(const std::vector<Vec3>& motion, Both&& both) {
        double sum = 0;
        for (std::size_t c = 0; c < motion.size(); ++c) {
            if (!is_finite(motion[c])) continue;
            const auto [a, b] = both(c);
            sum += a.x * b.x + a.y * b.y;
        }
        return sum;
    }

    const Shapes& shapes_;
    std::vector<double> matrix_, right_, weights_;
    double ridge_ = 0;
};

// The mirror image of a turn in the picture and of its shift, for a picture that is turned over.
Pose turned_over(const Pose& pose) {
    const Quaternion& q = pose.rotation;
    return {{-q.x, q.y, -q.z, q.w}, {pose.translation.x, -pose.translation.y, pose.translation.z}};
}

}  // namespace

Take with_depth(const Take& take, const NeutralOptions& options) {
    const std::vector<Vec3> rest = neutral(take, options);
    const auto [up, left_up] = best_lie(known_points(take, rest, false), false);
    const auto [down, left_down] = best_lie(known_points(take, rest, true), true);
    if (!take.planar || known_points(take, rest, false).seen.size() < 3) return take;
    const Lie& lie = left_down < left_up ? down : up;

    const Shapes shapes = shape_motions(take.points);
    const std::vector<std::array<double, 2>> slope = slopes(shapes, take.points.size());
    Mixture mixture(shapes);
    Take result = take;
    result.planar = false;
    std::vector<Vec3> motion(take.points.size());
    for (std::size_t r = 0; r < row_count(take); ++r) {
        for (std::size_t c = 0; c < motion.size(); ++c) {
            const Vec3 d = upright(row(take, r)[c], lie.upside_down) - upright(rest[c], lie.upside_down);
            motion[c] = rotate(conjugate(lie.turn), d) / lie.eyes;
        }
        const std::vector<double>& weights = mixture.solve(motion);
        for (std::size_t c = 0; c < motion.size(); ++c) {
            double mixed = 0;
            for (std::size_t i = 0; i < shapes.size(); ++i) mixed += weights[i] * shapes[i][c].z;
            const double alone = slope[c][0] * motion[c].x + slope[c][1] * motion[c].y;
            const double still = generic_position(take.points[c]).value_or(Vec3{}).z;
            Vec3& p = row(result, r)[c];
            if (!is_finite(p)) continue;
            p = upright(p, lie.upside_down);
            p.z = lie.eyes * (still + trust * (mixed + alone) / 2);
        }
    }
    if (lie.upside_down)
        for (Pose& pose : result.head) pose = turned_over(pose);
    return result;
}

}  // namespace mien
