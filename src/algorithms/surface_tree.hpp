// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "mien/algorithms/weld.hpp"

namespace mien {

/// A point of a surface: within a triangle of places, by shares that sum to 1.
struct SurfacePoint {
    double distance = std::numeric_limits<double>::infinity();  ///< from where it was asked for
    std::array<std::uint32_t, 3> places{};
    std::array<double, 3> shares{};
};

/// Finds the nearest point of a part of a mesh: its faces as fans of triangles in a tree of boxes.
class SurfaceTree {
public:
    /// Takes the faces whose corners are all on places that are marked.
    SurfaceTree(const Mesh& mesh, const Weld& weld, const std::vector<bool>& marked);

    /// Infinitely far when there are no faces.
    [[nodiscard]] SurfacePoint nearest(const Vec3& p) const;

private:
    struct Triangle {
        std::array<std::uint32_t, 3> places;
        std::array<Vec3, 3> corners;
    };
    struct Node {
        Box box;
        std::uint32_t first = 0, count = 0;  // triangles of a leaf; count 0: an inner node
        std::uint32_t left = 0, right = 0;
    };
    std::uint32_t build(std::uint32_t first, std::uint32_t last);

    std::vector<Triangle> triangles_;
    std::vector<Node> nodes_;  // the root is the last
};

}  // namespace mien
