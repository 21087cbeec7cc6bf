// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include "io/glb.hpp"

struct aiScene;

namespace mien {

/// A scene as Assimp read it from an FBX file as a document of glTF. Throws Error naming the thing, expected and found.
GltfDocument document_of(const aiScene& scene);

}  // namespace mien
