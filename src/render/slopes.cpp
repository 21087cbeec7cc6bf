// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The gradient of a weight on the surface. For the edges e from a vertex and the differences d of the weight along them
// it is the g that makes sum (dot(g, e) - d)^2 / |e|^2 least, a 3 x 3 system. In a flat ring nothing is known of the
// direction across; a small multiple of the unit matrix sets the gradient there to zero and keeps the system solvable.
// A weight that is linear in space has its gradient found exactly, on curved rings too.

#include "render/slopes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

namespace mien {

namespace {

using Row = std::span<const Rows::Entry>;

Row row(const Rows& rows, std::size_t v) {
    return Row(rows.entries).subspan(rows.starts[v], rows.starts[v + 1] - rows.starts[v]);
}

// Which vertices are one place of the surface.
struct Places {
    std::vector<std::uint32_t> of;      // one per vertex
    std::vector<std::uint32_t> vertex;  // one per place: its first vertex
};

int compare(Row a, Row b) {
    if (a.size() != b.size()) return a.size() < b.size() ? -1 : 1;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const auto key = [](const Rows::Entry& e) { return std::tie(e.index, e.weight.x, e.weight.y, e.weight.z); };
        if (key(a[i]) != key(b[i])) return key(a[i]) < key(b[i]) ? -1 : 1;
    }
    return 0;
}

// By position, then by what moves the vertex.
int compare(const Geometry& geometry, std::uint32_t a, std::uint32_t b) {
    const Vec3f &p = geometry.positions[a], &q = geometry.positions[b];
    const auto at = std::tie(p.x, p.y, p.z), other = std::tie(q.x, q.y, q.z);
    if (at != other) return at < other ? -1 : 1;
    const int joints = compare(row(geometry.joints, a), row(geometry.joints, b));
    return joints != 0 ? joints : compare(row(geometry.moves, a), row(geometry.moves, b));
}

Places join(const Geometry& geometry) {
    std::vector<std::uint32_t> order(geometry.positions.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        const int way = compare(geometry, a, b);
        return way != 0 ? way < 0 : a < b;
    });
    Places places{std::vector<std::uint32_t>(order.size()), {}};
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (i == 0 || compare(geometry, order[i - 1], order[i]) != 0) places.vertex.push_back(order[i]);
        places.of[order[i]] = static_cast<std::uint32_t>(places.vertex.size() - 1);
    }
    return places;
}

// The places next to each place, each once.
struct Rings {
    std::vector<std::uint32_t> starts, next;
};

Rings rings_of(const Geometry& geometry, const Places& places) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
    edges.reserve(geometry.triangles.size() * 2);
    for (std::size_t i = 0; i < geometry.triangles.size(); ++i) {
        const std::uint32_t a = places.of[geometry.triangles[i]];
        const std::uint32_t b = places.of[geometry.triangles[i % 3 == 2 ? i - 2 : i + 1]];
        if (a == b) continue;
        edges.emplace_back(a, b);
        edges.emplace_back(b, a);
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    Rings rings{std::vector<std::uint32_t>(places.vertex.size() + 1, 0), {}};
    for (const auto& [a, b] : edges) {
        ++rings.starts[a + 1];
        rings.next.push_back(b);
    }
    std::partial_sum(rings.starts.begin(), rings.starts.end(), rings.starts.begin());
    return rings;
}

// Normals where the file has none: of the triangles round a place, weighted by their angle there.
void add_normals(Geometry& geometry, const Places& places) {
    std::vector<Vec3> sums(places.vertex.size());
    for (std::size_t i = 0; i < geometry.triangles.size(); ++i) {
        const std::size_t first = i - i % 3;
        const auto corner = [&](std::size_t k) {
            return to_double(geometry.positions[geometry.triangles[first + (i + k) % 3]]);
        };
        // i % 3 counts from `first`, which is a multiple of 3, so (i + k) % 3 is the k-th corner from i on.
        const Vec3 e = corner(1) - corner(0), f = corner(2) - corner(0), n = cross(e, f);
        const double area = length(n);
        if (area > 0) sums[places.of[geometry.triangles[i]]] += std::atan2(area, dot(e, f)) / area * n;
    }
    for (std::size_t v = 0; v < geometry.normals.size(); ++v) {
        Vec3f& normal = geometry.normals[v];
        if (length(normal) > 0.5F) continue;
        const Vec3 sum = static_cast<double>(geometry.hands[v]) * sums[places.of[v]];
        normal = length(sum) > 0 ? to_float(sum / length(sum)) : Vec3f{0, 0, 1};
    }
}

// Some tangent at right angles to each normal.
void add_tangents(Geometry& geometry) {
    geometry.tangents.clear();
    for (const Vec3f& normal : geometry.normals) {
        const Vec3 n = to_double(normal);
        const Vec3 off = std::abs(n.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
        const Vec3 t = cross(off, n);
        geometry.tangents.push_back(to_float(t / length(t)));
    }
}

using Symmetric = std::array<double, 6>;  // xx, yy, zz, xy, xz, yz

// The inverse of a positive definite matrix, by its adjugate.
Symmetric inverse(const Symmetric& m) {
    const auto& [xx, yy, zz, xy, xz, yz] = m;
    const Symmetric adjugate{yy * zz - yz * yz, xx * zz - xz * xz, xx * yy - xy * xy,
                             xz * yz - xy * zz, xy * yz - xz * yy, xy * xz - xx * yz};
    const double determinant = xx * adjugate[0] + xy * adjugate[3] + xz * adjugate[4];
    Symmetric result{};
    if (determinant > 0)
        for (std::size_t i = 0; i < 6; ++i) result[i] = adjugate[i] / determinant;
    return result;
}

Vec3 times(const Symmetric& m, const Vec3& v) {
    return {m[0] * v.x + m[3] * v.y + m[4] * v.z, m[3] * v.x + m[1] * v.y + m[5] * v.z,
            m[4] * v.x + m[5] * v.y + m[2] * v.z};
}

// What a gradient at place `c` takes of the difference along each edge of its ring.
std::vector<Vec3> gradient_weights(const Geometry& geometry, const Places& places, const Rings& rings, std::size_t c) {
    Symmetric sum{};
    std::vector<Vec3> parts;
    const Vec3 here = to_double(geometry.positions[places.vertex[c]]);
    for (std::uint32_t r = rings.starts[c]; r < rings.starts[c + 1]; ++r) {
        const Vec3 e = to_double(geometry.positions[places.vertex[rings.next[r]]]) - here;
        const Vec3 part = e / std::max(dot(e, e), 1e-300);
        parts.push_back(part);
        const Symmetric square{part.x * e.x, part.y * e.y, part.z * e.z, part.x * e.y, part.x * e.z, part.y * e.z};
        for (std::size_t i = 0; i < 6; ++i) sum[i] += square[i];
    }
    // Each edge adds 1 to the trace.
    for (std::size_t i = 0; i < 3; ++i) sum[i] += 1e-6 * static_cast<double>(parts.size());
    const Symmetric solve = inverse(sum);
    for (Vec3& part : parts) part = times(solve, part);
    return parts;
}

// An entry of the row of a place, and how its weight grows along x, y and z.
struct Sloped {
    std::uint32_t index = 0;
    Vec3 weight;
    std::array<Vec3, 3> gradient;
};

Sloped& at(std::vector<Sloped>& list, std::uint32_t index) {
    return *std::lower_bound(list.begin(), list.end(), index,
                             [](const Sloped& entry, std::uint32_t wanted) { return entry.index < wanted; });
}

// The row of a place with everything that moves it or a neighbour.
std::vector<Sloped> sloped_row(const Rows& rows, const Places& places, std::span<const std::uint32_t> ring,
                               std::span<const Vec3> weights, std::size_t c) {
    std::vector<Sloped> list;
    const Row own = row(rows, places.vertex[c]);
    for (const Rows::Entry& entry : own) list.push_back({entry.index, to_double(entry.weight), {}});
    for (const std::uint32_t near : ring)
        for (const Rows::Entry& entry : row(rows, places.vertex[near])) list.push_back({entry.index, {}, {}});
    // A stable sort keeps the place's own entry, which has the weight, before the neighbours' of the same index.
    std::stable_sort(list.begin(), list.end(), [](const Sloped& a, const Sloped& b) { return a.index < b.index; });
    list.erase(
        std::unique(list.begin(), list.end(), [](const Sloped& a, const Sloped& b) { return a.index == b.index; }),
        list.end());
    const auto add = [&](const Vec3& direction, const Rows::Entry& entry, double sign) {
        Sloped& sloped = at(list, entry.index);
        const Vec3 d = sign * direction;
        sloped.gradient[0] += d.x * to_double(entry.weight);
        sloped.gradient[1] += d.y * to_double(entry.weight);
        sloped.gradient[2] += d.z * to_double(entry.weight);
    };
    for (std::size_t r = 0; r < ring.size(); ++r) {
        for (const Rows::Entry& entry : row(rows, places.vertex[ring[r]])) add(weights[r], entry, 1);
        for (const Rows::Entry& entry : own) add(weights[r], entry, -1);
    }
    return list;
}

Vec3f along(const Sloped& entry, const Vec3& direction) {
    return to_float(direction.x * entry.gradient[0] + direction.y * entry.gradient[1] +
                    direction.z * entry.gradient[2]);
}

// Adds the row of a vertex: that of its place, with slopes along its own tangents.
void add_row(Rows& rows, const std::vector<Sloped>& list, const Vec3& t, const Vec3& b) {
    for (const Sloped& entry : list) {
        const Rows::Entry done{entry.index, to_float(entry.weight), along(entry, t), along(entry, b)};
        if (!(done == Rows::Entry{entry.index, {}, {}, {}})) rows.entries.push_back(done);
    }
    rows.starts.push_back(static_cast<std::uint32_t>(rows.entries.size()));
}

}  // namespace

void add_slopes(Geometry& geometry) {
    const Places places = join(geometry);
    const Rings rings = rings_of(geometry, places);
    add_normals(geometry, places);
    add_tangents(geometry);
    Rows moves, joints;
    for (std::size_t v = 0; v < geometry.positions.size(); ++v) {
        const std::uint32_t c = places.of[v];
        const auto ring = std::span(rings.next).subspan(rings.starts[c], rings.starts[c + 1] - rings.starts[c]);
        const std::vector<Vec3> weights = gradient_weights(geometry, places, rings, c);
        const Vec3 t = to_double(geometry.tangents[v]);
        const Vec3 b = static_cast<double>(geometry.hands[v]) * cross(to_double(geometry.normals[v]), t);
        add_row(moves, sloped_row(geometry.moves, places, ring, weights, c), t, b);
        add_row(joints, sloped_row(geometry.joints, places, ring, weights, c), t, b);
    }
    geometry.moves = std::move(moves);
    geometry.joints = std::move(joints);
}

}  // namespace mien
