// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Scenes that move as rows of positions, whatever format they were read from.

#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "mien/io/sequence.hpp"
#include "mien/mesh_sequence.hpp"
#include "mien/scene.hpp"

namespace mien {

/// Which of the animations `names` is asked for: by name, or by number. Throws Error naming those that there are.
std::size_t find_animation(std::span<const std::string> names, const std::string& wanted);

/// What the scene's channels move, and when.
Animation describe_animation(const Scene& scene, std::string name);

/// The rows of a scene on the mesh that was read from the same file. Throws Error if nothing moves, or for more rows
/// than a million.
MeshSequence sequence_of(Mesh mesh, Scene scene, double rate);

}  // namespace mien
