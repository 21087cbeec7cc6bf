// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace mien {

/// An FBX file (7.1 and later, binary or text) as a GLB, which every reader of glTF then reads: meshes as triangles,
/// their vertices joined where place, normal, texture coordinate, shapes and joints are equal, nodes, blend shapes,
/// skins and animations; y up, in metres, by the axes and the unit that the file states. Between keys of an animation
/// values go straight, turns along the shorter arc; a curve that was drawn with few keys and tangents is as exact as
/// they are dense. Left out: textures, in-between shapes, weights of shapes that nothing animates.
///
/// Assimp reads the file, in a process of its own that a hostile one can do no more than end. Throws Error naming the
/// thing, expected and found; always in a build without Assimp.
std::vector<std::byte> convert_fbx(std::span<const std::byte> bytes);

}  // namespace mien
