// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <span>

#include "mien/io/gltf.hpp"
#include "mien/mesh.hpp"
#include "mien/scene.hpp"

namespace mien {

/// Everything that a glTF 2.0, text or binary, shows: every mesh on every node of the scene it opens with, skins, morph
/// targets, materials with their pictures (PNG and JPEG), and its first animation. What it shows and the scene does not
/// is said in `Scene::left_out`: pictures that are missing or cannot be read, points and lines, extensions, more.
///
/// Weights of vertices are brought to a sum of 1. Where the pictures of a material lie alike on it, by
/// KHR_texture_transform or another set of texture coordinates, `Surface::uvs` hold the result. Throws Error naming the
/// JSON pointer or byte, expected and found; what is read is bounded by the bytes of the file.
Scene parse_scene(std::span<const std::byte> bytes, const Fetch& fetch);

/// A mesh as a scene: what its document shows where it came from glTF (`Mesh::gltf`), otherwise its parts in one plain
/// material on one node, polygons as fans of triangles, a vertex per texture coordinate at seams, and normals weighted
/// by angle and smooth across vertices at one place.
Scene scene_of(const Mesh& mesh);

}  // namespace mien
