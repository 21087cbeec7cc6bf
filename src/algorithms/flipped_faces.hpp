// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <span>

#include "mien/mesh.hpp"

namespace mien {

/// What a vertex has to move by to be counted as moving, in eye distances.
constexpr double least_motion = 0.002;

/// Faces that move, and those of them whose normals oppose each other.
struct FlippedFaces {
    std::size_t moving = 0, flipped = 0;
};

/// Compares the faces of a mesh in two states; one moves where a vertex is farther than `least` from rest in either.
FlippedFaces flipped_faces(const Mesh& mesh, std::span<const Vec3f> wanted, std::span<const Vec3f> found, double least);

/// The flipped ones' share of the moving ones; 0 where none moves.
double share(const FlippedFaces& faces);

FlippedFaces& operator+=(FlippedFaces& sum, const FlippedFaces& more);

}  // namespace mien
