// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Parameters of an animated head: Laftsidis et al., section 2.1. The tracks of the feature points go through `to_faps`.
// An eyeball that is a piece of its own tells its turn better than one vertex of it, so the pupil is put where the turn
// of the whole ball brings it.

#include "mien/algorithms/extract_faps.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "algorithms/eyeballs.hpp"
#include "algorithms/island.hpp"
#include "algorithms/rotation.hpp"

#include "mien/algorithms/weld.hpp"

namespace mien {

namespace {

constexpr double still_round = 0.02;  // of a ball's radius: what its shape may change

std::vector<std::uint32_t> vertices_of(const EyeballIslands& eyeball, const std::vector<Island>& list,
                                       const Weld& weld) {
    std::vector<bool> inside(weld.vertex.size(), false);
    for (const std::uint32_t island : eyeball.islands)
        for (const std::uint32_t place : list[island].places) inside[place] = true;
    std::vector<std::uint32_t> vertices;
    for (std::uint32_t v = 0; v < weld.place.size(); ++v)
        if (inside[weld.place[v]]) vertices.push_back(v);
    return vertices;
}

std::vector<Vec3> seen_from(const Vec3& centre, std::span<const Vec3f> positions,
                            std::span<const std::uint32_t> vertices) {
    std::vector<Vec3> result;
    for (const std::uint32_t v : vertices) result.push_back(to_double(positions[v]) - centre);
    return result;
}

// Of two eyes that of the larger x than this is the left one.
double middle_between(std::span<const MovingEyeball> eyeballs, std::span<const FeaturePoint> points) {
    if (const auto middle = middle_of_eyes(points)) return middle->x;
    double sum = 0;
    for (const MovingEyeball& eyeball : eyeballs) sum += eyeball.centre.x;
    return eyeballs.empty() ? 0 : sum / static_cast<double>(eyeballs.size());
}

// Keeps the poses of the row; false where the ball did not keep its shape.
bool add_row(MovingEyeball& eyeball, std::span<const Vec3> rest, std::span<const Vec3f> row, double radius) {
    const std::vector<Vec3> now = seen_from(eyeball.centre, row, eyeball.vertices);
    const Quaternion turn = best_rotation(rest, now);
    const Vec3 shift = centre(now) - rotate(turn, centre(rest));
    double squares = 0;
    for (std::size_t i = 0; i < rest.size(); ++i) {
        const Vec3 off = rotate(turn, rest[i]) + shift - now[i];
        squares += dot(off, off) / static_cast<double>(rest.size());
    }
    eyeball.poses.push_back({turn, shift});
    return std::sqrt(squares) < still_round * radius;
}

}  // namespace

std::vector<MovingEyeball> moving_eyeballs(const UprightSequence& upright) {
    const Face face{upright.sequence.mesh, upright.points};
    const Weld welded = weld(face.mesh);
    const std::vector<Island> list = list_islands(face, welded);
    std::vector<MovingEyeball> eyeballs;
    std::vector<double> radii;
    for (const EyeballIslands& found : find_eyeballs(face, welded, list)) {
        eyeballs.push_back({"", "", vertices_of(found, list, welded), found.ball.centre, {}});
        radii.push_back(found.ball.radius);
    }
    std::vector<std::vector<Vec3>> rest;
    rest.reserve(eyeballs.size());
    for (const MovingEyeball& e : eyeballs) rest.push_back(seen_from(e.centre, face.mesh.positions, e.vertices));
    std::vector<bool> round(eyeballs.size(), true);
    std::vector<Vec3f> row(vertex_count(face.mesh));
    for (std::size_t r = 0; r < upright.head.size() && !eyeballs.empty(); ++r) {
        upright.sequence.positions(r, row);
        for (std::size_t e = 0; e < eyeballs.size(); ++e)
            if (!add_row(eyeballs[e], rest[e], row, radii[e])) round[e] = false;
    }
    const double middle = middle_between(eyeballs, upright.points);
    std::vector<MovingEyeball> kept;
    for (std::size_t e = 0; e < eyeballs.size(); ++e) {
        const bool left = eyeballs[e].centre.x > middle;
        eyeballs[e].name = left ? "left eye" : "right eye";
        eyeballs[e].pupil = left ? "3.5" : "3.6";
        const bool is_first = std::none_of(kept.begin(), kept.end(),
                                           [&](const MovingEyeball& other) { return other.name == eyeballs[e].name; });
        if (round[e] && is_first) kept.push_back(std::move(eyeballs[e]));
    }
    return kept;
}

namespace {

// The tracks with the pupil where the ball has it, and its neutral place in the face.
void aim(Take& take, Fapu& fapu, const MovingEyeball& eyeball) {
    Vec3& centre = eyeball.pupil == "3.5" ? fapu.left_eye : fapu.right_eye;
    centre = eyeball.centre;
    const auto point = find_point(fapu.points, eyeball.pupil);
    const double ahead = 0.19 * fapu.es;  // of a pupil without a point: any depth tells the turn
    const Vec3 before = point ? fapu.points[*point].position - centre : Vec3{0, 0, ahead};
    if (!point) fapu.points.push_back({eyeball.pupil, 0, centre + before, {}, 0});
    auto column = find_column(take, eyeball.pupil);
    if (!column) {
        const std::size_t columns = take.points.size();
        std::vector<Vec3> wider;
        for (std::size_t r = 0; r < row_count(take); ++r) {
            const auto here = row(take, r);
            wider.insert(wider.end(), here.begin(), here.end());
            wider.push_back(lost_sample);
        }
        take.points.push_back(eyeball.pupil);
        take.samples = std::move(wider);
        column = columns;
    }
    for (std::size_t r = 0; r < row_count(take); ++r) row(take, r)[*column] = centre + apply(eyeball.poses[r], before);
}

}  // namespace

FapStream extract_faps(const UprightSequence& upright, const Fapu& fapu, const ToFapsOptions& options) {
    Take take = point_tracks(upright);
    Fapu own = fapu;
    for (const MovingEyeball& eyeball : moving_eyeballs(upright)) aim(take, own, eyeball);
    return to_faps(take, own, options);
}

std::vector<Vec3> head_translations(const UprightSequence& upright, const Fapu& fapu) {
    std::vector<Vec3> shifts;
    shifts.reserve(upright.head.size());
    for (const Pose& pose : upright.head) shifts.push_back(apply(pose, fapu.neck) - fapu.neck);
    return shifts;
}

}  // namespace mien
