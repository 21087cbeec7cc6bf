// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "io/glb.hpp"

#include "mien/vec.hpp"

namespace mien {

/// An affine map: p -> columns · p + offset.
struct Affine {
    std::array<Vec3, 3> columns{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
    Vec3 offset;
};

/// A direction or a displacement through the linear part of the map.
Vec3 turned(const Affine& map, const Vec3& v);
/// A point through the map.
Vec3 moved(const Affine& map, const Vec3& p);
/// First b, then a.
Affine operator*(const Affine& a, const Affine& b);
/// Negative for a map that mirrors.
double determinant(const Affine& map);

/// From the sixteen numbers of a matrix, column by column.
Affine affine_from_columns(const std::array<double, 16>& m);

struct SceneNodes {
    std::vector<Affine> worlds;          ///< one per node of the document: from its space to the scene's
    std::vector<std::size_t> traversal;  ///< the nodes of the scene shown first, depth first, parents before children
};

/// Goes through the nodes. Throws Error naming the JSON pointer, expected and found for cycles, nodes with two parents,
/// and transforms that are not finite.
SceneNodes scene_nodes(const GltfDocument& document);

}  // namespace mien
