// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <array>

#include "mien/vec.hpp"

namespace mien {

/// An affine map of space: p -> p.x columns[0] + p.y columns[1] + p.z columns[2] + offset.
struct Affine {
    std::array<Vec3, 3> columns{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
    Vec3 offset;
    friend constexpr bool operator==(const Affine&, const Affine&) = default;
};

/// A direction or a displacement through the linear part of the map.
constexpr Vec3 turned(const Affine& map, const Vec3& v) {
    return v.x * map.columns[0] + v.y * map.columns[1] + v.z * map.columns[2];
}

/// A point through the map.
constexpr Vec3 moved(const Affine& map, const Vec3& p) {
    return turned(map, p) + map.offset;
}

/// First b, then a.
constexpr Affine operator*(const Affine& a, const Affine& b) {
    return {{turned(a, b.columns[0]), turned(a, b.columns[1]), turned(a, b.columns[2])}, moved(a, b.offset)};
}

/// What scales first, then turns, then shifts.
constexpr Affine affine_map(const Vec3& translation, const Quaternion& rotation, const Vec3& scale) {
    return {{scale.x * rotate(rotation, {1, 0, 0}), scale.y * rotate(rotation, {0, 1, 0}),
             scale.z * rotate(rotation, {0, 0, 1})},
            translation};
}

/// How much volumes grow; negative for a map that mirrors.
constexpr double determinant(const Affine& map) {
    return dot(map.columns[0], cross(map.columns[1], map.columns[2]));
}

}  // namespace mien
