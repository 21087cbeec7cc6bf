// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Joins the vertices that file formats split at seams, so that surface distance (Kshirsagar et al., section 2) does not
// see a cut where the texture has one. The paper works on meshes without splits and says nothing about it.
//
// Places are found through a grid of cells a few tolerances wide. Only the first vertex of a place is kept in the grid,
// and first vertices lie more than a tolerance apart, so a cell never holds more than a few: time is linear for any
// input. A vertex joins the lowest place in reach, and no place grows wider than the tolerance round its first vertex;
// a closer chain of vertices therefore stays several places instead of collapsing into one.

#include "mien/algorithms/weld.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <numeric>
#include <unordered_map>

#include "mien/error.hpp"

namespace mien {

namespace {

constexpr std::uint32_t none = ~0U;

// Cells are named by the whole numbers of their lower corner, kept as doubles so that no coordinate overflows.
struct CellHash {
    std::size_t operator()(const Vec3& cell) const noexcept {
        std::uint64_t hash = 0;
        for (const double coordinate : {cell.x, cell.y, cell.z}) {
            hash = (hash ^ std::bit_cast<std::uint64_t>(coordinate)) * 0x9e3779b97f4a7c15U;
            hash ^= hash >> 29;
        }
        return hash;
    }
};

class PlaceGrid {
public:
    PlaceGrid(const Mesh& mesh, Weld& weld, double tolerance) : mesh_(mesh), weld_(weld), tolerance_(tolerance) {}

    // The lowest place within the tolerance of p, or none.
    [[nodiscard]] std::uint32_t find(const Vec3& p) const {
        const Vec3 low = cell(p, -tolerance_);
        const Vec3 high = cell(p, tolerance_);
        std::uint32_t best = none;
        for (const double x : {low.x, high.x}) {
            for (const double y : {low.y, high.y}) {
                for (const double z : {low.z, high.z}) {
                    best = std::min(best, find_in_cell({x, y, z}, p));
                    if (low.z == high.z) break;
                }
                if (low.y == high.y) break;
            }
            if (low.x == high.x) break;
        }
        return best;
    }

    void add(std::uint32_t place, const Vec3& p) {
        const auto [entry, is_new] = last_in_cell_.try_emplace(cell(p, 0), none);
        earlier_in_cell_.push_back(entry->second);
        entry->second = place;
    }

private:
    // The cell of p moved by `shift` along every axis; without a tolerance a position is its own cell. Adding zero
    // turns -0 into 0, which compares equal but would hash differently.
    [[nodiscard]] Vec3 cell(const Vec3& p, double shift) const {
        if (tolerance_ == 0) return {p.x + 0.0, p.y + 0.0, p.z + 0.0};
        const double side = 4 * tolerance_;
        return {std::floor((p.x + shift) / side) + 0.0, std::floor((p.y + shift) / side) + 0.0,
                std::floor((p.z + shift) / side) + 0.0};
    }

    [[nodiscard]] std::uint32_t find_in_cell(const Vec3& cell, const Vec3& p) const {
        std::uint32_t best = none;
        const auto entry = last_in_cell_.find(cell);
        if (entry == last_in_cell_.end()) return best;
        for (std::uint32_t place = entry->second; place != none; place = earlier_in_cell_[place])
            if (distance(to_double(mesh_.positions[weld_.vertex[place]]), p) <= tolerance_) best = place;
        return best;  // places come in descending order
    }

    const Mesh& mesh_;
    const Weld& weld_;
    double tolerance_;
    std::unordered_map<Vec3, std::uint32_t, CellHash> last_in_cell_;
    std::vector<std::uint32_t> earlier_in_cell_;  // one per place: the place before it in its cell
};

}  // namespace

Weld weld(const Mesh& mesh, const WeldOptions& options) {
    if (!(options.tolerance >= 0 && options.tolerance <= 1e-4))
        throw Error(
            fmt::format("weld: expected a tolerance from 0 to 1e-4 of the height, found {}", options.tolerance));
    const Box box = bounding_box(mesh);
    Weld weld;
    weld.place.reserve(vertex_count(mesh));
    PlaceGrid grid(mesh, weld, options.tolerance * (box.high.y - box.low.y));
    for (std::uint32_t v = 0; v < vertex_count(mesh); ++v) {
        const Vec3 p = to_double(mesh.positions[v]);
        std::uint32_t place = grid.find(p);
        if (place == none) {
            place = static_cast<std::uint32_t>(weld.vertex.size());
            weld.vertex.push_back(v);
            grid.add(place, p);
        }
        weld.place.push_back(place);
    }
    return weld;
}

namespace {

std::uint32_t root(std::vector<std::uint32_t>& parent, std::uint32_t place) {
    while (parent[place] != place) place = parent[place] = parent[parent[place]];
    return place;
}

// The lower root stays, so that a root is the first place of its island.
void join(std::vector<std::uint32_t>& parent, std::uint32_t a, std::uint32_t b) {
    const std::uint32_t ra = root(parent, a);
    const std::uint32_t rb = root(parent, b);
    parent[std::max(ra, rb)] = std::min(ra, rb);
}

}  // namespace

std::vector<std::uint32_t> islands(const Mesh& mesh, const Weld& weld) {
    std::vector<std::uint32_t> parent(weld.vertex.size());
    std::iota(parent.begin(), parent.end(), 0U);
    for (std::size_t f = 0; f < face_count(mesh); ++f) {
        const auto corners = face(mesh, f);
        for (const std::uint32_t v : corners) join(parent, weld.place[corners.front()], weld.place[v]);
    }

    std::vector<std::uint32_t> island(parent.size());
    std::uint32_t count = 0;
    for (std::uint32_t p = 0; p < parent.size(); ++p) {
        const std::uint32_t r = root(parent, p);
        island[p] = r == p ? count++ : island[r];
    }
    return island;
}

}  // namespace mien
