// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Retargeting in the units of MPEG-4 (ISO/IEC 14496-2, facial animation parameter units): a motion is measured along
// the axes of the face in the face's own lengths, and played in those of the other. The standard gives most points a
// parameter along one axis only; here every axis of every point has a unit.

#include "algorithms/retarget_fapu.hpp"

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace mien {

namespace {

// Distances between the eyes, from the eyes to the nose, from there to the mouth; the mouth's width, the iris.
struct Units {
    std::optional<double> es, ens, mns, mw, irisd;
};
using Unit = std::optional<double> Units::*;

// Points in the axes of their face.
struct Lying {
    std::span<const FeaturePoint> points;
    Quaternion turn;

    std::optional<Vec3> at(std::string_view id) const {
        const std::optional<std::size_t> i = find_point(points, id);
        if (!i || !is_finite(points[*i].position)) return std::nullopt;
        return rotate(conjugate(turn), points[*i].position);
    }
    std::optional<Vec3> between(std::string_view from, std::string_view to) const {
        const std::optional<Vec3> a = at(from), b = at(to);
        if (!a || !b) return std::nullopt;
        return *b - *a;
    }
    std::optional<Vec3> eye(std::string_view corner, std::string_view other) const {
        const std::optional<Vec3> a = at(corner), b = at(other);
        if (!a || !b) return std::nullopt;
        return 0.5 * (*a + *b);
    }
};

std::optional<double> above_zero(double length) {
    return length > 0 ? std::optional(length) : std::nullopt;
}

Units units_of(const Lying& face) {
    Units units;
    const std::optional<Vec3> left = face.eye("3.7", "3.11"), right = face.eye("3.8", "3.12");
    const std::optional<Vec3> nose = face.at("9.15");
    if (left && right) units.es = above_zero(distance(*left, *right));
    if (left && right && nose) units.ens = above_zero((0.5 * (*left + *right) - *nose).y);
    if (const auto nose_to_mouth = face.between("2.2", "9.15")) units.mns = above_zero(nose_to_mouth->y);
    if (const auto mouth = face.between("8.4", "8.3")) units.mw = above_zero(mouth->x);
    const std::optional<Vec3> left_lids = face.between("3.3", "3.1"), right_lids = face.between("3.4", "3.2");
    if (left_lids && right_lids) units.irisd = above_zero((left_lids->y + right_lids->y) / 2);
    return units;
}

constexpr std::array<std::string_view, 4> lids{"3.1", "3.2", "3.3", "3.4"};

std::array<Unit, 3> units_along(std::string_view id) {
    if (id.starts_with("2.") || id.starts_with("8.")) return {&Units::mw, &Units::mns, &Units::mns};
    for (const std::string_view lid : lids)
        if (id == lid) return {&Units::es, &Units::irisd, &Units::irisd};
    if (id.starts_with("3.") || id.starts_with("4.")) return {&Units::es, &Units::ens, &Units::ens};
    if (id.starts_with("5.")) return {&Units::es, &Units::ens, &Units::es};
    if (id.starts_with("9.") || id.starts_with("10.")) return {&Units::ens, &Units::ens, &Units::ens};
    return {&Units::es, &Units::es, &Units::es};
}

std::vector<FeaturePoint> rest_of(const Take& take, const NeutralOptions& options) {
    const std::vector<Vec3> positions = neutral(take, options);
    std::vector<FeaturePoint> points;
    for (std::size_t c = 0; c < positions.size(); ++c) points.push_back({take.points[c], 0, positions[c], {}, 0});
    return points;
}

Vec3 applied(const std::array<Vec3, 3>& columns, const Vec3& d) {
    return d.x * columns[0] + d.y * columns[1] + d.z * columns[2];
}

}  // namespace

void fit_fapu(Retarget& map, const FaceFrames& frames, const Take& take, const Face& face,
              const NeutralOptions& neutral) {
    const std::vector<FeaturePoint> rest = rest_of(take, neutral);
    const Units source = units_of({rest, frames.source.turn});
    const Units target = units_of({face.points, frames.target.turn});
    const std::array<Vec3, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    for (std::size_t i = 0; i < map.points.size(); ++i) {
        const std::array<Unit, 3> units = units_along(map.points[i]);
        std::array<Vec3, 3> columns{};
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 from = rotate(frames.source.turn, axes[k]), to = rotate(frames.target.turn, axes[k]);
            const std::optional<double>&s = source.*units[k], &t = target.*units[k];
            const double scale = s && t ? *t / *s : dot(to, applied(map.local[i], from));
            columns[0] += scale * from.x * to;
            columns[1] += scale * from.y * to;
            columns[2] += scale * from.z * to;
        }
        map.local[i] = columns;
    }
}

}  // namespace mien
