// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "algorithms/mirror_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "mien/algorithms/attach.hpp"

namespace mien {

namespace {

constexpr double near = 1e-3;       // in eye distances
constexpr double most_lone = 1e-3;  // of the places

// The plane through the middles of the pairs. One that is an axis but for rounding is that axis, and one through the
// origin but for rounding goes through it, so that mirroring is exact.
std::optional<MirrorMap> plane_of(std::span<const FeaturePoint> points, double eyes) {
    Vec3 sum, middle;
    double pairs = 0;
    for (const FeaturePoint& point : points) {
        const std::string_view id = mirror_point(point.id);
        const auto other = find_point(points, id);
        if (!other || id == point.id || id < point.id) continue;
        const Vec3 apart = point.position - points[*other].position;
        sum += dot(sum, apart) < 0 ? -apart : apart;
        middle += 0.5 * (point.position + points[*other].position);
        pairs += 1;
    }
    if (pairs < 2 || !(length(sum) > 0)) return std::nullopt;
    MirrorMap map{sum / length(sum), 0, {}};
    for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}})
        if (std::abs(dot(map.across, axis)) > 1 - 1e-5) map.across = axis;
    map.offset = dot(map.across, middle) / pairs;
    if (std::abs(map.offset) < near * eyes) map.offset = 0;
    return map;
}

using Cell = std::array<std::int64_t, 3>;

Cell cell_of(const Vec3& p, double size) {
    return {std::llround(p.x / size), std::llround(p.y / size), std::llround(p.z / size)};
}

// Places by the cell of space that they lie in.
struct Cells {
    const Face& face;
    const Weld& weld;
    double reach, size;
    std::multimap<Cell, std::uint32_t> places;
};

Vec3 place_of(const Cells& cells, std::uint32_t place) {
    return to_double(cells.face.mesh.positions[cells.weld.vertex[place]]);
}

// The nearest place within reach.
std::uint32_t nearest(const Cells& cells, const Vec3& wanted) {
    const Cell middle = cell_of(wanted, cells.size);
    std::uint32_t best = no_partner;
    double least = cells.reach;
    for (int step = 0; step < 27; ++step) {
        const Cell cell{middle[0] + step % 3 - 1, middle[1] + step / 3 % 3 - 1, middle[2] + step / 9 - 1};
        const auto [first, last] = cells.places.equal_range(cell);
        for (auto entry = first; entry != last; ++entry) {
            const double d = distance(place_of(cells, entry->second), wanted);
            if (d > least || (d == least && best != no_partner)) continue;
            best = entry->second;
            least = d;
        }
    }
    return best;
}

}  // namespace

std::optional<MirrorMap> mirror_map(const Face& face, const Weld& weld) {
    const double eyes = eye_distance(face.points);
    std::optional<MirrorMap> map = plane_of(face.points, eyes);
    if (!map || !(eyes > 0)) return std::nullopt;
    const auto places = static_cast<std::uint32_t>(weld.vertex.size());
    Cells cells{face, weld, near * eyes, 2 * near * eyes, {}};
    for (std::uint32_t p = 0; p < places; ++p) cells.places.emplace(cell_of(place_of(cells, p), cells.size), p);
    for (std::uint32_t p = 0; p < places; ++p)
        map->partner.push_back(nearest(cells, mirrored(*map, place_of(cells, p)) + (2 * map->offset) * map->across));
    const std::vector<bool> is_skin = solved_places(face, weld);
    std::size_t lone = 0, skin = 0;
    for (std::uint32_t p = 0; p < places; ++p) {
        std::uint32_t& other = map->partner[p];
        if (other != no_partner && map->partner[other] != p) other = no_partner;
        skin += is_skin[p] ? 1U : 0U;
        lone += is_skin[p] && other == no_partner ? 1U : 0U;
    }
    if (static_cast<double>(lone) > most_lone * static_cast<double>(skin)) return std::nullopt;
    return map;
}

}  // namespace mien
