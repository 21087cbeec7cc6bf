// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <vector>

#include "io/gltf_base.hpp"

#include "mien/rig.hpp"

namespace mien {

/// The nodes of a rig in a document.
struct JointNodes {
    std::size_t root = 0;             ///< "mien": a root of the scene that holds the joints and the head's motion
    std::vector<std::size_t> joints;  ///< one per joint of the skin, children of `root`
};

/// Where a joint rests in a document: numbers that nodes and inverse bind matrices hold exactly.
Vec3f written_origin(const Rig& rig, std::size_t joint);

/// Adds a rig's joints to a head and binds its vertices to them. Throws Error if head, rig and skin do not belong
/// together.
JointNodes append_skin(BaseDocument& base, const Rig& rig, const Skin& skin);

}  // namespace mien
