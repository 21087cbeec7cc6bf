// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/morph.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <string>
#include <string_view>

#include "algorithms/rotation.hpp"
#include "algorithms/similarity.hpp"

#include "mien/error.hpp"
#include "mien/face.hpp"

namespace mien {

std::vector<MeasuredPoint> merged(std::span<const std::vector<MeasuredPoint>> pictures) {
    struct Sum {
        std::string id;
        std::array<double, 3> sum{}, count{};
    };
    std::vector<Sum> sums;
    for (const auto& picture : pictures)
        for (const MeasuredPoint& point : picture) {
            auto here = std::find_if(sums.begin(), sums.end(), [&](const Sum& s) { return s.id == point.id; });
            if (here == sums.end()) here = sums.insert(sums.end(), {point.id});
            const std::array<double, 3> place{point.place.x, point.place.y, point.place.z};
            for (std::size_t k = 0; k < 3; ++k) {
                if (std::isnan(place[k])) continue;
                here->sum[k] += place[k];
                here->count[k] += 1;
            }
        }
    std::vector<MeasuredPoint> result;
    result.reserve(sums.size());
    for (const Sum& s : sums)  // 0 / 0 where no picture shows it
        result.push_back({s.id, {s.sum[0] / s.count[0], s.sum[1] / s.count[1], s.sum[2] / s.count[2]}});
    return result;
}

namespace {

constexpr double same = 1e-6;  // of the size of the head: what rounding to single precision leaves

// A point of the rig and where it was measured.
struct Pair {
    std::size_t point = 0;
    Vec3 from, to;
};

std::vector<Pair> paired(const Rig& rig, std::span<const MeasuredPoint> measured) {
    std::vector<Pair> pairs;
    for (const MeasuredPoint& point : measured)
        if (const auto i = find_point(rig.points, point.id))
            pairs.push_back({*i, rig.points[*i].position, point.place});
    if (pairs.empty()) throw Error("morph: expected measured points that the head has, found none");
    return pairs;
}

bool on_a_line(const std::vector<Vec3>& points) {
    const std::array<double, 3> s = spreads(points);
    return !(s[1] > 1e-3 * s[0]);
}

// From the points that are known in space; from a front view alone where these are too few, with depth in proportion.
Similarity alignment(const std::vector<Pair>& pairs) {
    Retarget whole, front;
    front.planar = true;
    for (const Pair& pair : pairs) {
        if (is_finite(pair.to)) {
            whole.source_neutral.push_back(pair.from);
            whole.target_neutral.push_back(pair.to);
        }
        if (!std::isfinite(pair.to.x) || !std::isfinite(pair.to.y)) continue;
        front.source_neutral.push_back(pair.from);
        front.target_neutral.push_back({pair.to.x, pair.to.y, 0});
    }
    const bool in_space = whole.source_neutral.size() >= 3;
    if (!in_space && (front.source_neutral.size() < pairs.size() || pairs.size() < 2))
        throw Error(
            fmt::format("morph: expected three points with x, y and z, or x and y of all, found {} and {} of {}",
                        whole.source_neutral.size(), front.source_neutral.size(), pairs.size()));
    const Retarget& shared = in_space ? whole : front;
    if (in_space && (on_a_line(shared.source_neutral) || on_a_line(shared.target_neutral)))
        throw Error("morph: expected points that do not lie on a line, found them on one");
    return best_similarity(shared);
}

double size_of(const std::vector<Vec3f>& positions) {
    std::vector<Vec3> places;
    places.reserve(positions.size());
    for (const Vec3f& p : positions) places.push_back(to_double(p));
    return diagonal(bounding_box(places));
}

// The similarity, or none where it would only round.
std::optional<Similarity> alignment_that_moves(const std::vector<Pair>& pairs, double size) {
    const Similarity map = alignment(pairs);
    for (const Pair& pair : pairs)
        if (distance(apply(map, pair.from), pair.from) > same * size) return map;
    return std::nullopt;
}

double known(double measured, double otherwise) {
    return std::isfinite(measured) ? measured : otherwise;
}

// The points round an eye: lids and corners.
bool is_round_eye(std::string_view id, Side side) {
    const auto points = standard_points();
    const auto point = std::find_if(points.begin(), points.end(), [&](const StandardPoint& p) { return p.id == id; });
    return id.starts_with("3.") && point != points.end() && point->side == side;
}

struct Reshape {
    const Rig& rig;
    std::optional<Similarity> align;
    std::vector<Vec3> left;  // one per point of the rig: what is left after aligning

    [[nodiscard]] Vec3 aligned(const Vec3& p) const { return align ? apply(*align, p) : p; }

    [[nodiscard]] Vec3 moved(std::uint32_t v) const {
        Vec3 sum = aligned(to_double(rig.rest[v]));
        for (std::uint32_t k = rig.row_starts[v]; k < rig.row_starts[v + 1]; ++k) {
            const Vec3 w = to_double(rig.weights[k]);
            const Vec3& d = left[rig.row_points[k]];
            sum += Vec3{w.x * d.x, w.y * d.y, w.z * d.z};
        }
        return sum;
    }

    // The mean of what is left at the points round the eye that a ball is in.
    [[nodiscard]] Vec3 ball_shift(const Eyeball& ball) const {
        const auto mean = [&](Side side, const std::vector<Vec3>* of) {
            Vec3 sum;
            double count = 0;
            for (std::size_t i = 0; i < rig.points.size(); ++i) {
                if (!is_round_eye(rig.points[i].id, side)) continue;
                sum += of ? (*of)[i] : rig.points[i].position;
                ++count;
            }
            return count > 0 ? std::optional(sum / count) : std::nullopt;
        };
        const auto one = mean(Side::left, nullptr), other = mean(Side::right, nullptr);
        if (!one && !other) return {};
        const bool is_left = one && (!other || distance(*one, ball.centre) < distance(*other, ball.centre));
        return *mean(is_left ? Side::left : Side::right, &left);
    }
};

}  // namespace

std::vector<Vec3f> morph(const Rig& rig, std::span<const MeasuredPoint> measured) {
    const std::vector<Pair> pairs = paired(rig, measured);
    Reshape reshape{rig, alignment_that_moves(pairs, size_of(rig.rest)), std::vector<Vec3>(rig.points.size())};
    for (const Pair& pair : pairs) {
        const Vec3 start = reshape.aligned(pair.from);
        const Vec3 goal{known(pair.to.x, start.x), known(pair.to.y, start.y), known(pair.to.z, start.z)};
        reshape.left[pair.point] = goal - start;
    }
    std::vector<Vec3f> positions;
    for (std::uint32_t v = 0; v < vertex_count(rig); ++v) positions.push_back(to_float(reshape.moved(v)));
    for (const Eyeball& ball : rig.eyeballs)
        for (const std::uint32_t v : ball.vertices)
            positions[v] = to_float(reshape.aligned(to_double(rig.rest[v])) + reshape.ball_shift(ball));
    return positions;
}

namespace {

// The middle of some vertices and how far they lie from it on average.
struct Cloud {
    Vec3 middle;
    double radius = 0;
};

Cloud cloud_of(std::span<const Vec3f> positions, const std::vector<std::uint32_t>& vertices) {
    Cloud cloud;
    const auto count = static_cast<double>(vertices.size());
    for (const std::uint32_t v : vertices) cloud.middle += to_double(positions[v]) / count;
    for (const std::uint32_t v : vertices) cloud.radius += distance(to_double(positions[v]), cloud.middle) / count;
    return cloud;
}

}  // namespace

Rig carried_over(const Rig& rig, std::span<const Vec3f> positions) {
    Rig result = rig;
    result.rest.assign(positions.begin(), positions.end());
    for (FeaturePoint& point : result.points) point.position = to_double(positions[point.vertex]);
    for (Eyeball& ball : result.eyeballs) {  // they keep their shape, and so the place of their centre in it
        const Cloud before = cloud_of(rig.rest, ball.vertices), now = cloud_of(positions, ball.vertices);
        const double scale = before.radius > 0 ? now.radius / before.radius : 1;
        ball.centre = now.middle + scale * (ball.centre - before.middle);
    }
    return result;
}

}  // namespace mien
