// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/rig.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <iterator>
#include <string_view>

namespace mien {

namespace {

double mean_radius(const Rig& rig, const Eyeball& eyeball) {
    double sum = 0;
    for (const std::uint32_t v : eyeball.vertices) sum += distance(to_double(rig.rest[v]), eyeball.centre);
    return sum / static_cast<double>(eyeball.vertices.size());
}

// The point, where it is in front of this eyeball at the distance of a lid.
std::optional<std::size_t> lid_of(const Rig& rig, const Eyeball& eyeball, double radius, std::string_view id) {
    const std::optional<std::size_t> point = find_point(rig.points, id);
    if (!point) return std::nullopt;
    const double off = distance(rig.points[*point].position, eyeball.centre);
    return off > 0.9 * radius && off < 2 * radius ? point : std::nullopt;
}

std::vector<LidsOverEye> lids_over_eyes(const Rig& rig) {
    constexpr std::array<std::array<std::string_view, 2>, 4> pairs{
        {{"3.1", "3.3"}, {"3.2", "3.4"}, {"3.13", "3.9"}, {"3.14", "3.10"}}};
    std::vector<LidsOverEye> lids;
    for (const Eyeball& eyeball : rig.eyeballs) {
        if (eyeball.vertices.empty()) continue;
        const double radius = mean_radius(rig, eyeball);
        for (const auto& [upper_id, lower_id] : pairs) {
            const auto upper = lid_of(rig, eyeball, radius, upper_id), lower = lid_of(rig, eyeball, radius, lower_id);
            if (upper || lower)
                lids.push_back({upper.value_or(lower.value_or(0)), lower.value_or(upper.value_or(0)), eyeball.centre});
        }
    }
    return lids;
}

std::vector<LipsThatMeet> lips_that_meet(const Rig& rig) {
    const auto above = find_point(rig.points, "8.1"), below = find_point(rig.points, "8.2");
    if (!above || !below) return {};
    const Vec3 way = rig.points[*above].position - rig.points[*below].position;
    std::vector<LipsThatMeet> lips;
    constexpr std::array<std::array<std::string_view, 2>, 3> pairs{{{"2.2", "2.3"}, {"2.6", "2.8"}, {"2.7", "2.9"}}};
    for (const auto& [upper_id, lower_id] : pairs) {
        const auto upper = find_point(rig.points, upper_id), lower = find_point(rig.points, lower_id);
        if (upper && lower && length(way) > 0) lips.push_back({*upper, *lower, way / length(way)});
    }
    return lips;
}

}  // namespace

TakeBinding bind_take(const Rig& rig, const Take& take) {
    TakeBinding binding;
    for (const FeaturePoint& point : rig.points) {
        const auto column = find_column(take, point.id);
        binding.columns.push_back(column ? static_cast<std::int32_t>(*column) : -1);
        if (!column) binding.missing.push_back(point.id);
    }
    std::copy_if(take.points.begin(), take.points.end(), std::back_inserter(binding.unused),
                 [&](const std::string& id) { return !find_point(rig.points, id); });
    binding.lids = lids_over_eyes(rig);
    binding.lips = lips_that_meet(rig);
    return binding;
}

namespace {

// Out of the surface that the lids slide on.
void slide(const LidsOverEye& lids, std::span<const FeaturePoint> points, std::size_t lid,
           std::span<Vec3f> displacements) noexcept {
    const Vec3 up = points[lids.upper].position - lids.centre, low = points[lids.lower].position - lids.centre;
    const Vec3 at = points[lid].position + to_double(displacements[lid]) - lids.centre;
    const double off = length(at);
    if (!(off > 0)) return;
    const Vec3 from = low / length(low), across = up / length(up) - from;
    const double width = dot(across, across);
    const double share = width > 0 ? std::clamp(dot(at / off - from, across) / width, 0.0, 1.0) : 0;
    const double least = (1 - share) * length(low) + share * length(up);
    if (off < least) displacements[lid] += to_float((least / off - 1) * at);
}

void press(const LipsThatMeet& lips, std::span<const FeaturePoint> points, std::span<Vec3f> displacements) noexcept {
    const double at_rest = dot(points[lips.upper].position - points[lips.lower].position, lips.up);
    const double opened = dot(to_double(displacements[lips.upper]) - to_double(displacements[lips.lower]), lips.up);
    const double crossed = std::min(at_rest, 0.0) - (at_rest + opened);
    if (!(crossed > 0)) return;
    displacements[lips.upper] += to_float(crossed / 2 * lips.up);
    displacements[lips.lower] -= to_float(crossed / 2 * lips.up);
}

}  // namespace

void displacements(const Rig& rig, const TakeBinding& binding, std::span<const Vec3> row,
                   std::span<Vec3f> displacements) noexcept {
    assert(displacements.size() == rig.points.size() && binding.columns.size() == rig.points.size());
    for (std::size_t i = 0; i < rig.points.size(); ++i) {
        const std::int32_t column = binding.columns[i];
        const bool seen = column >= 0 && is_finite(row[static_cast<std::size_t>(column)]);
        displacements[i] = seen ? to_float(row[static_cast<std::size_t>(column)] - rig.points[i].position) : Vec3f{};
    }
    for (const LidsOverEye& lids : binding.lids) {
        slide(lids, rig.points, lids.upper, displacements);
        if (lids.lower != lids.upper) slide(lids, rig.points, lids.lower, displacements);
    }
    for (const LipsThatMeet& lips : binding.lips) press(lips, rig.points, displacements);
}

Quaternion eyeball_turn(const Rig& rig, const Eyeball& eyeball, std::span<const Vec3f> displacements) noexcept {
    if (!eyeball.point) return {};
    const Vec3 from = rig.points[*eyeball.point].position - eyeball.centre;
    const Vec3 to = from + to_double(displacements[*eyeball.point]);
    // The half-way quaternion: (from x to, |from||to| + from.to), normalised. It vanishes for opposite directions.
    const Vec3 axis = cross(from, to);
    const double w = length(from) * length(to) + dot(from, to);
    const double norm = std::sqrt(dot(axis, axis) + w * w);
    if (!(norm > 1e-12 * dot(from, from))) return {};
    return {axis.x / norm, axis.y / norm, axis.z / norm, w / norm};
}

Vec3 joint_origin(const Rig& rig, std::size_t joint) noexcept {
    if (joint < rig.points.size()) return rig.points[joint].position;
    if (joint == rig.points.size()) return {};
    return rig.eyeballs[joint - rig.points.size() - 1].centre;
}

namespace {

// Motion of a vertex by its row of the rig.
Vec3 carried(const Rig& rig, std::uint32_t vertex, std::span<const Vec3f> displacements) noexcept {
    Vec3 sum;
    for (std::uint32_t e = rig.row_starts[vertex]; e < rig.row_starts[vertex + 1]; ++e) {
        const Vec3 w = to_double(rig.weights[e]);
        const Vec3 d = to_double(displacements[rig.row_points[e]]);
        sum += {w.x * d.x, w.y * d.y, w.z * d.z};
    }
    return sum;
}

}  // namespace

void joint_poses(const Rig& rig, std::span<const Vec3f> displacements, std::span<Pose> poses) noexcept {
    assert(poses.size() == joint_count(rig) && displacements.size() == rig.points.size());
    std::fill(poses.begin(), poses.end(), Pose{});
    for (std::size_t i = 0; i < rig.points.size(); ++i) {
        const Axes moves = rig.points[i].moves;
        const Vec3 own = to_double(displacements[i]);
        if (moves == Axes{}) {
            poses[i].translation = own;
            continue;
        }
        const Vec3 rest = carried(rig, rig.points[i].vertex, displacements);
        poses[i].translation = {moves.x ? own.x : rest.x, moves.y ? own.y : rest.y, moves.z ? own.z : rest.z};
    }
    for (std::size_t e = 0; e < rig.eyeballs.size(); ++e)
        poses[rig.points.size() + 1 + e].rotation = eyeball_turn(rig, rig.eyeballs[e], displacements);
}

std::vector<float> weights_of(const Rig& rig, std::size_t point) {
    const auto larger = [](float a, float b) { return std::abs(b) > std::abs(a) ? b : a; };
    std::vector<float> weights(vertex_count(rig), 0);
    for (std::size_t v = 0; v < weights.size(); ++v)
        for (std::uint32_t e = rig.row_starts[v]; e < rig.row_starts[v + 1]; ++e)
            if (rig.row_points[e] == point)
                weights[v] = larger(larger(rig.weights[e].x, rig.weights[e].y), rig.weights[e].z);
    return weights;
}

}  // namespace mien
