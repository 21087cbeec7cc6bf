// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/render/take_scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "mien/error.hpp"

namespace mien {

namespace {

constexpr std::uint32_t rings = 12, sectors = 20;

// A ball of radius 1: a pole, rings of vertices, a pole.
Surface ball() {
    Surface surface;
    for (std::uint32_t ring = 0; ring <= rings; ++ring)
        for (std::uint32_t sector = 0; sector <= sectors; ++sector) {
            const double down = std::numbers::pi * ring / rings, round = 2 * std::numbers::pi * sector / sectors;
            const Vec3 p{std::sin(down) * std::sin(round), std::cos(down), std::sin(down) * std::cos(round)};
            surface.positions.push_back(to_float(p));
            surface.normals.push_back(to_float(p));
        }
    for (std::uint32_t ring = 0; ring < rings; ++ring)
        for (std::uint32_t sector = 0; sector < sectors; ++sector) {
            const std::uint32_t a = ring * (sectors + 1) + sector, b = a + sectors + 1;
            surface.triangles.insert(surface.triangles.end(), {a, b, b + 1, a, b + 1, a + 1});
        }
    return surface;
}

// The first row in which anything is seen, and the largest distance between two of its points.
double extent(const Take& take) {
    for (std::size_t r = 0; r < row_count(take); ++r) {
        double largest = -1;
        for (const Vec3& a : row(take, r))
            for (const Vec3& b : row(take, r))
                if (is_finite(a) && is_finite(b)) largest = std::max(largest, distance(a, b));
        if (largest >= 0) return largest > 0 ? largest : 1;
    }
    throw Error("take: expected a sample to show, found none that is not lost");
}

// Where a ball is and whether it is there, at every row.
std::pair<Channel, Channel> channels(const Take& take, std::size_t column, double radius) {
    const auto node = static_cast<std::uint32_t>(column);
    Channel place{node, Channel::Property::translation, Channel::Between::linear, {}, {}};
    Channel size{node, Channel::Property::scale, Channel::Between::step, {}, {}};
    Vec3 last;
    for (std::size_t r = 0; r < row_count(take); ++r) {
        const Vec3& p = row(take, r)[column];
        if (is_finite(p)) last = p;
        const float scale = is_finite(p) ? static_cast<float>(radius) : 0;
        place.times.push_back(static_cast<float>(take.times[r]));
        size.times.push_back(static_cast<float>(take.times[r]));
        const Vec3f at = to_float(last);
        place.values.insert(place.values.end(), {at.x, at.y, at.z});
        size.values.insert(size.values.end(), {scale, scale, scale});
    }
    return {place, size};
}

Vec3 first_seen(const Take& take, std::size_t column) {
    for (std::size_t r = 0; r < row_count(take); ++r)
        if (is_finite(row(take, r)[column])) return row(take, r)[column];
    return {};
}

}  // namespace

Scene scene_of(const Take& take, double size) {
    Scene scene;
    const double radius = size * extent(take);
    Material white;
    white.name = "marker";
    white.colour = {0.86F, 0.87F, 0.88F, 1};
    white.roughness = 0.45F;
    scene.materials.push_back(white);
    for (std::size_t c = 0; c < take.points.size(); ++c) {
        Node node;
        node.name = take.points[c];
        node.translation = first_seen(take, c);
        node.scale = {radius, radius, radius};
        scene.nodes.push_back(node);
        scene.surfaces.push_back(ball());
        scene.surfaces.back().name = take.points[c];
        scene.surfaces.back().mesh = scene.surfaces.back().node = static_cast<std::uint32_t>(c);
        auto [place, there] = channels(take, c, radius);
        scene.channels.push_back(std::move(place));
        scene.channels.push_back(std::move(there));
    }
    return scene;
}

}  // namespace mien
