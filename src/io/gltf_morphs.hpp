// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "io/gltf_base.hpp"
#include "io/gltf_keys.hpp"

namespace mien {

/// A mesh of a document that morph targets move: the node that it hangs on and which of the given targets it has,
/// ascending.
struct MorphedMesh {
    std::size_t node;
    std::vector<std::size_t> targets;
};

/// Appends morph targets with their names, at rest, to every mesh that they move. `vertices`: of the head. Throws Error
/// if a target does not fit it.
std::vector<MorphedMesh> append_morphs(BaseDocument& base, std::size_t vertices, std::span<const MorphTarget> targets);

/// The weights of a mesh's targets, key after key. `weights`: of all `count` targets, one row per time.
std::vector<float> weights_at_keys(const MorphedMesh& mesh, std::span<const float> weights, std::size_t count,
                                   const Keys& keys);

}  // namespace mien
