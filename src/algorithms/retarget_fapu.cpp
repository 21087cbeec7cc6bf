// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Retargeting in the units of MPEG-4 (ISO/IEC 14496-2, facial animation parameter units): a motion is measured along
// the axes of the face in the face's own lengths, and played in those of the other. The standard gives most points a
// parameter along one axis only; here every axis of every point has a unit.

#include "algorithms/retarget_fapu.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "algorithms/small_mouth.hpp"

#include "mien/algorithms/fapu.hpp"
#include "mien/error.hpp"
#include "mien/fap.hpp"

namespace mien {

namespace {

// The units of a face by its own axes: none where they cannot be told.
std::optional<Fapu> units_of(std::vector<FeaturePoint> points, const Quaternion& turn) {
    for (FeaturePoint& point : points) point.position = rotate(conjugate(turn), point.position);
    try {
        return measure_fapu(std::span(points));
    } catch (const Error&) {  // no eyes, or on the wrong sides
        return std::nullopt;
    }
}

// The length of a unit, where the points that define it are there.
std::optional<double> known_length(const std::optional<Fapu>& fapu, FapUnit unit) {
    if (!fapu || std::find(fapu->uncertain.begin(), fapu->uncertain.end(), unit) != fapu->uncertain.end())
        return std::nullopt;
    return unit_length(*fapu, unit);
}

// Of the target's unit to the source's. A mouth that is narrow beside its distance from the nose moves in proportion to
// its width.
std::optional<double> ratio(const std::optional<Fapu>& source, const std::optional<Fapu>& target, FapUnit unit) {
    const auto s = known_length(source, unit), t = known_length(target, unit);
    if (!s || !t) return std::nullopt;
    const auto width = unit == FapUnit::mns ? ratio(source, target, FapUnit::mw) : std::nullopt;
    return width ? *t / *s * mouth_share(*width, *t / *s) : *t / *s;
}

constexpr std::array<std::string_view, 4> lids{"3.1", "3.2", "3.3", "3.4"};

std::array<FapUnit, 3> units_along(std::string_view id) {
    if (id.starts_with("2.") || id.starts_with("8.")) return {FapUnit::mw, FapUnit::mns, FapUnit::mns};
    for (const std::string_view lid : lids)
        if (id == lid) return {FapUnit::es, FapUnit::irisd, FapUnit::irisd};
    if (id.starts_with("3.") || id.starts_with("4.")) return {FapUnit::es, FapUnit::ens, FapUnit::ens};
    if (id.starts_with("5.")) return {FapUnit::es, FapUnit::ens, FapUnit::es};
    if (id.starts_with("9.") || id.starts_with("10.")) return {FapUnit::ens, FapUnit::ens, FapUnit::ens};
    return {FapUnit::es, FapUnit::es, FapUnit::es};
}

Vec3 applied(const std::array<Vec3, 3>& columns, const Vec3& d) {
    return d.x * columns[0] + d.y * columns[1] + d.z * columns[2];
}

}  // namespace

void fit_fapu(Retarget& map, const FaceFrames& frames, const Take& take, const Face& face,
              const NeutralOptions& neutral) {
    const std::optional<Fapu> source = units_of(neutral_points(take, neutral), frames.source.turn);
    const std::optional<Fapu> target = units_of(face.points, frames.target.turn);
    const std::array<Vec3, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    for (std::size_t i = 0; i < map.points.size(); ++i) {
        const std::array<FapUnit, 3> units = units_along(map.points[i]);
        std::array<Vec3, 3> columns{};
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 from = rotate(frames.source.turn, axes[k]), to = rotate(frames.target.turn, axes[k]);
            const double scale = ratio(source, target, units[k]).value_or(dot(to, applied(map.local[i], from)));
            columns[0] += scale * from.x * to;
            columns[1] += scale * from.y * to;
            columns[2] += scale * from.z * to;
        }
        map.local[i] = columns;
    }
}

}  // namespace mien
