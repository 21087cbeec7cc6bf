// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// What stands in for fbx.cpp in a build without Assimp.

#include "mien/error.hpp"
#include "mien/io/fbx.hpp"

namespace mien {

std::vector<std::byte> convert_fbx(std::span<const std::byte>) {
    throw Error("fbx: this build of mien reads none, since it was made without Assimp; expected a .glb or .gltf");
}

}  // namespace mien
