// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// How vertices hang on joints (glTF 2.0, 3.7.3).

#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "io/glb.hpp"
#include "io/gltf_primitive.hpp"

#include "mien/affine.hpp"

namespace mien {

/// A skin of a document.
struct DocumentSkin {
    std::vector<std::size_t> joints;    ///< nodes of the document
    std::vector<Affine> inverse_binds;  ///< one per joint
};
DocumentSkin read_skin(const GltfDocument& document, std::size_t skin);

/// The numbers of JOINTS_n and WEIGHTS_n: four a vertex.
struct JointSet {
    std::vector<std::uint32_t> joints;  ///< each below the number of joints
    std::vector<float> weights;
};

/// How many sets a primitive has, from number 0 on without a gap.
unsigned joint_set_count(const Primitive& primitive);

/// Reads set number `set`, which has to be one of them. Throws Error for a joint that the skin does not have.
JointSet read_joint_set(const Primitive& primitive, unsigned set, std::size_t joints);

}  // namespace mien
