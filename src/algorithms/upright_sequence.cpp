// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The head's own motion, Laftsidis et al., section 2 and the three steps of 2.1.
//
// Remedied: three points that the paper takes as fixed are single vertices, two of which many heads lack, and the lids
// of a straight head do not stand in one vertical (docs/papers/laftsidis.md). The skull is found in the animation
// instead, as trimmed least squares find a plane among outliers: all vertices above the eyes are fitted, those that fit
// worst are put away, and so on until the rest keeps its shape.

#include "mien/algorithms/upright_sequence.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <string_view>
#include <utility>

#include "algorithms/eyeballs.hpp"
#include "algorithms/head.hpp"
#include "algorithms/rotation.hpp"

#include "mien/algorithms/upright.hpp"
#include "mien/error.hpp"

namespace mien {

namespace {

constexpr std::size_t looked_at = 48;     // rows in which the skull is sought
constexpr std::size_t most_skull = 2000;  // vertices that tell a pose
constexpr double rigid_enough = 1e-4;     // of the eye distance
constexpr double surely_rigid = 0.1;      // share of the vertices above the eyes that are taken as skull at least
constexpr double least_nod = 0.35;        // radians, as for takes

using Rows = std::vector<std::vector<Vec3>>;  // by row, then by vertex of a list

Vec3 unit(const Vec3& v) {
    return v / length(v);
}

void check(const MeshSequence& sequence, std::span<const FeaturePoint> points) {
    if (sequence.times.empty()) throw Error("animated head: expected rows, found none");
    for (const FeaturePoint& point : points)
        if (point.vertex >= vertex_count(sequence.mesh))
            throw Error(fmt::format("animated head: expected point {} at one of {} vertices, found {}", point.id,
                                    vertex_count(sequence.mesh), point.vertex));
}

const FeaturePoint& need(std::span<const FeaturePoint> points, std::string_view id) {
    const auto i = find_point(points, id);
    if (!i)
        throw Error(
            fmt::format("upright as the paper writes it: expected points 2.1, 7.1, 9.15 and 11.4, found no {}", id));
    return points[*i];
}

// About the x axis, counted from y towards z.
double angle_about_x(const Vec3& v) {
    return std::atan2(v.z, v.y);
}

Quaternion turn_x(double angle) {
    return {std::sin(angle / 2), 0, 0, std::cos(angle / 2)};
}

// The shortest turn between two directions.
Quaternion turn_between(const Vec3& from, const Vec3& to) {
    const std::array a{from, -from}, b{to, -to};
    return best_rotation(a, b);
}

// The turn that brings the middle plane of the head to x = 0 and the lids over each other.
Quaternion neutral_turn(std::span<const FeaturePoint> points) {
    const Vec3 back = need(points, "7.1").position;
    const Vec3 left = cross(need(points, "11.4").position - back, need(points, "2.1").position - back);
    if (!(length(left) > 0))
        throw Error("upright as the paper writes it: expected 2.1, 7.1 and 11.4 to span a plane, found them on a line");
    const Quaternion level = turn_between(unit(left), {1, 0, 0});
    Vec3 lids;
    for (const auto& [upper, lower] : {std::pair("3.1", "3.3"), std::pair("3.2", "3.4")}) {
        const auto a = find_point(points, upper), b = find_point(points, lower);
        if (a && b) lids += rotate(level, points[*a].position - points[*b].position);
    }
    if (!(std::hypot(lids.y, lids.z) > 0))
        throw Error("upright as the paper writes it: expected open lids at 3.1 and 3.3 or 3.2 and 3.4, found none");
    return turn_x(-angle_about_x(lids)) * level;
}

// The turn that brings 11.4 and 9.15, seen from 7.1, to the middle plane, and 11.4 to its neutral direction: steps 2
// and 3 of section 2.1. Turns about y and z that bring both to the plane bring its normal to x.
Quaternion turn_back(const Vec3& top_before, const Vec3& top, const Vec3& nose) {
    const Quaternion level = turn_between(unit(cross(top, nose)), {1, 0, 0});
    return turn_x(angle_about_x(top_before) - angle_about_x(rotate(level, top))) * level;
}

std::vector<Vec3> picked(std::span<const Vec3f> positions, std::span<const std::uint32_t> vertices) {
    std::vector<Vec3> result;
    result.reserve(vertices.size());
    for (const std::uint32_t v : vertices) result.push_back(to_double(positions[v]));
    return result;
}

template <class T>
std::vector<T> evenly(std::span<const T> all, std::size_t most) {
    if (all.size() <= most) return {all.begin(), all.end()};
    std::vector<T> some;
    for (std::size_t i = 0; i < most; ++i) some.push_back(all[i * all.size() / most]);
    return some;
}

// The vertices above the eyes, or all where that leaves too few to be a skull.
std::vector<std::uint32_t> above_the_eyes(std::span<const Vec3f> rest, std::span<const FeaturePoint> points) {
    const std::optional<Vec3> eyes = middle_of_eyes(points);
    std::vector<std::uint32_t> all, above;
    for (std::uint32_t v = 0; v < rest.size(); ++v) {
        all.push_back(v);
        if (eyes && rest[v].y > eyes->y) above.push_back(v);
    }
    constexpr std::size_t few = 10;
    return above.size() < few ? all : above;
}

// Which of the vertices keep their shape over the rows.
class SkullSearch {
public:
    SkullSearch(std::vector<Vec3> rest, Rows rows, double scale)
        : rest_(std::move(rest)), rows_(std::move(rows)), scale_(scale), kept_(rest_.size(), true) {}

    // Indices into the vertices it was given.
    std::vector<std::uint32_t> search() {
        constexpr int rounds = 12;
        for (int round = 0; round < rounds; ++round) {
            const std::vector<double> residuals = measure();
            std::vector<double> sorted = residuals;
            std::sort(sorted.begin(), sorted.end());
            // First the better half, then all that are about as good as the best.
            const double half = sorted[sorted.size() / 2];
            const double best = sorted[static_cast<std::size_t>(surely_rigid * static_cast<double>(sorted.size()))];
            const double limit = round < rounds / 3 ? half : std::max(2 * best, rigid_enough * scale_);
            for (std::size_t i = 0; i < kept_.size(); ++i) kept_[i] = residuals[i] <= limit;
        }
        std::vector<std::uint32_t> found;
        for (std::uint32_t i = 0; i < kept_.size(); ++i)
            if (kept_[i]) found.push_back(i);
        return found;
    }

private:
    [[nodiscard]] std::vector<Vec3> kept(const std::vector<Vec3>& all) const {
        std::vector<Vec3> some;
        for (std::size_t i = 0; i < all.size(); ++i)
            if (kept_[i]) some.push_back(all[i]);
        return some;
    }

    // Root mean square distance of each vertex from where the kept ones say that it is.
    [[nodiscard]] std::vector<double> measure() const {
        std::vector<double> squares(rest_.size(), 0);
        const std::vector<Vec3> before = kept(rest_);
        for (const std::vector<Vec3>& row : rows_) {
            const Pose pose = least_squares_pose(before, kept(row), false).value_or(Pose{});
            for (std::size_t i = 0; i < rest_.size(); ++i) {
                const Vec3 off = apply(pose, rest_[i]) - row[i];
                squares[i] += dot(off, off) / static_cast<double>(rows_.size());
            }
        }
        for (double& square : squares) square = std::sqrt(square);
        return squares;
    }

    std::vector<Vec3> rest_;
    Rows rows_;
    double scale_;
    std::vector<bool> kept_;
};

std::vector<std::uint32_t> find_skull(const MeshSequence& sequence, std::span<const FeaturePoint> points,
                                      std::span<const Vec3f> level, double scale) {
    const std::vector<std::uint32_t> all = above_the_eyes(level, points);
    const std::vector<std::uint32_t> seeds = evenly(std::span(all), 2 * most_skull);
    std::vector<std::size_t> numbers(sequence.times.size());
    for (std::size_t r = 0; r < numbers.size(); ++r) numbers[r] = r;
    Rows rows;
    std::vector<Vec3f> positions(vertex_count(sequence.mesh));
    for (const std::size_t r : evenly(std::span<const std::size_t>(numbers), looked_at)) {
        sequence.positions(r, positions);
        rows.push_back(picked(positions, seeds));
    }
    std::vector<std::uint32_t> skull;
    for (const std::uint32_t i : SkullSearch(picked(sequence.mesh.positions, seeds), std::move(rows), scale).search())
        skull.push_back(seeds[i]);
    return evenly(std::span<const std::uint32_t>(skull), most_skull);
}

// The neutral face of either reading: its positions in the source and how it is brought upright.
struct Neutral {
    std::vector<Vec3f> positions;
    Pose source;
};

std::vector<FeaturePoint> placed(std::span<const FeaturePoint> points, std::span<const Vec3f> positions,
                                 const Pose& back) {
    std::vector<FeaturePoint> result(points.begin(), points.end());
    for (FeaturePoint& point : result) point.position = apply(back, to_double(positions[point.vertex]));
    return result;
}

Quaternion without_small_nod(const Quaternion& turn) {
    const Vec3 ahead = rotate(turn, {0, 0, 1});
    if (std::abs(std::asin(std::clamp(ahead.y, -1.0, 1.0))) > least_nod) return turn;
    const Vec3 left = rotate(turn, {1, 0, 0}), level = unit(cross(left, {0, 1, 0}));
    return nearest_rotation({left, cross(level, left), level});
}

// A turn this small is the unevenness of a modelled face.
bool turns(const Quaternion& turn) {
    constexpr double least = 0.01;  // about one degree
    return length(Vec3{turn.x, turn.y, turn.z}) > least;
}

Neutral remedied_neutral(const MeshSequence& sequence, std::span<const FeaturePoint> points) {
    Neutral neutral{sequence.mesh.positions, {}};
    const std::vector<FeaturePoint> there = placed(points, neutral.positions, {});
    const Quaternion turn = without_small_nod(face_turn(there).value_or(Quaternion{}));
    if (!turns(turn)) return neutral;
    std::vector<Vec3> places;
    places.reserve(there.size());
    for (const FeaturePoint& point : there) places.push_back(point.position);
    const Vec3 middle = centre(places);
    neutral.source = {turn, middle - rotate(turn, middle)};
    return neutral;
}

Neutral written_neutral(const MeshSequence& sequence, std::span<const FeaturePoint> points) {
    Neutral neutral{std::vector<Vec3f>(vertex_count(sequence.mesh)), {}};
    sequence.positions(0, neutral.positions);
    const std::vector<FeaturePoint> there = placed(points, neutral.positions, {});
    const Quaternion turn = conjugate(neutral_turn(there));
    // Turned about 7.1, which comes to x = 0.
    const Vec3 back = need(there, "7.1").position;
    neutral.source = {turn, back - rotate(turn, {0, back.y, back.z})};
    return neutral;
}

// The pose of the head in a row of the source, both seen upright.
using PoseOf = std::function<Pose(std::span<const Vec3f> row)>;

PoseOf skull_pose(const std::vector<std::uint32_t>& skull, const Neutral& neutral) {
    return [=, before = picked(neutral.positions, skull)](std::span<const Vec3f> row) {
        const Pose moved = least_squares_pose(before, picked(row, skull), false).value_or(Pose{});
        return inverse(neutral.source) * moved * neutral.source;
    };
}

PoseOf written_pose(std::span<const FeaturePoint> upright_points, const Pose& source) {
    const FeaturePoint back = need(upright_points, "7.1"), top = need(upright_points, "11.4"),
                       nose = need(upright_points, "9.15");
    return [=](std::span<const Vec3f> row) {
        const auto at = [&](const FeaturePoint& p) { return apply(inverse(source), to_double(row[p.vertex])); };
        const Vec3 pivot = at(back);
        const Quaternion turn = conjugate(turn_back(top.position - back.position, at(top) - pivot, at(nose) - pivot));
        return Pose{turn, pivot - rotate(turn, back.position)};
    };
}

std::function<void(std::size_t, std::span<Vec3f>)> without_motion(const MeshSequence& sequence, const Pose& source,
                                                                  const std::vector<Pose>& head) {
    return [positions = sequence.positions, source, head](std::size_t row, std::span<Vec3f> filled) {
        positions(row, filled);
        const Pose back = inverse(source * head[row]);
        for (Vec3f& p : filled) p = to_float(apply(back, to_double(p)));
    };
}

// Root mean square of what the skull still does, in `scale`.
double left_over(const UprightSequence& upright, double scale) {
    std::vector<std::size_t> numbers(upright.head.size());
    for (std::size_t r = 0; r < numbers.size(); ++r) numbers[r] = r;
    std::vector<Vec3f> row(vertex_count(upright.sequence.mesh));
    double squares = 0;
    std::size_t count = 0;
    for (const std::size_t r : evenly(std::span<const std::size_t>(numbers), looked_at)) {
        upright.sequence.positions(r, row);
        for (const std::uint32_t v : upright.skull) {
            const Vec3 off = to_double(row[v]) - to_double(upright.sequence.mesh.positions[v]);
            squares += dot(off, off);
            ++count;
        }
    }
    return count > 0 ? std::sqrt(squares / static_cast<double>(count)) / scale : 0;
}

Mesh placed_mesh(const Mesh& mesh, const Neutral& neutral) {
    Mesh result = mesh;
    result.morph_targets.clear();
    result.positions = neutral.positions;
    if (neutral.source == Pose{}) return result;
    result.gltf.clear();
    const Pose back = inverse(neutral.source);
    for (Vec3f& p : result.positions) p = to_float(apply(back, to_double(p)));
    return result;
}

}  // namespace

UprightSequence upright(const MeshSequence& sequence, std::span<const FeaturePoint> points, Reading reading) {
    check(sequence, points);
    const bool as_written = reading == Reading::paper;
    const Neutral neutral = as_written ? written_neutral(sequence, points) : remedied_neutral(sequence, points);
    UprightSequence result;
    result.source = neutral.source;
    result.points = placed(points, neutral.positions, inverse(neutral.source));
    result.sequence.mesh = placed_mesh(sequence.mesh, neutral);
    result.sequence.times = sequence.times;
    double scale = eye_distance(result.points);
    if (!(scale > 0)) scale = 0.25 * diagonal(bounding_box(sequence.mesh));
    if (as_written)
        for (const char* id : {"7.1", "11.4", "9.15"}) result.skull.push_back(need(result.points, id).vertex);
    else
        result.skull = find_skull(sequence, result.points, result.sequence.mesh.positions, scale);
    const PoseOf pose_of = as_written ? written_pose(result.points, neutral.source) : skull_pose(result.skull, neutral);
    std::vector<Vec3f> row(vertex_count(sequence.mesh));
    for (std::size_t r = 0; r < sequence.times.size(); ++r) {
        sequence.positions(r, row);
        result.head.push_back(pose_of(row));
    }
    result.sequence.positions = without_motion(sequence, result.source, result.head);
    result.skull_motion = left_over(result, scale);
    return result;
}

Take point_tracks(const UprightSequence& upright) {
    Take take;
    for (const FeaturePoint& point : upright.points) take.points.push_back(point.id);
    take.times = upright.sequence.times;
    take.head = upright.head;
    take.unit = upright.sequence.mesh.unit;
    std::vector<Vec3f> row(vertex_count(upright.sequence.mesh));
    for (std::size_t r = 0; r < take.times.size(); ++r) {
        upright.sequence.positions(r, row);
        for (const FeaturePoint& point : upright.points) take.samples.push_back(to_double(row[point.vertex]));
    }
    return take;
}

MeshSequence at_rate(const MeshSequence& sequence, double rate) {
    if (!(rate > 0) || !std::isfinite(rate))
        throw Error(fmt::format("animated head: expected a rate above 0, found {}", rate));
    if (sequence.times.empty()) throw Error("animated head: expected rows, found none");
    std::vector<std::size_t> rows;
    MeshSequence result{sequence.mesh, {}, {}};
    const double last = sequence.times.back() - sequence.times.front();
    constexpr double most_frames = 1e7;
    if (!(last * rate < most_frames))
        throw Error(fmt::format("animated head: expected less than 1e7 frames, found {} s at {} a second", last, rate));
    std::size_t next = 0;
    for (std::size_t frame = 0; static_cast<double>(frame) / rate <= last + 1e-9; ++frame) {
        const double time = static_cast<double>(frame) / rate;
        const auto off = [&](std::size_t r) { return std::abs(sequence.times[r] - sequence.times.front() - time); };
        while (next + 1 < sequence.times.size() && off(next + 1) < off(next)) ++next;
        rows.push_back(next);
        result.times.push_back(time);
    }
    result.positions = [positions = sequence.positions, rows](std::size_t row, std::span<Vec3f> filled) {
        positions(rows[row], filled);
    };
    return result;
}

}  // namespace mien
