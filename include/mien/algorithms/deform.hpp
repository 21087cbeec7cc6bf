// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <span>

#include "mien/mesh_sequence.hpp"
#include "mien/rig.hpp"
#include "mien/take.hpp"

namespace mien {

/// Moves every vertex by its row of the rig: eq. 5 of Kshirsagar et al. with the denominator folded in at bind time,
/// which is also the skinning sum of Dutreve et al., section 3.1; a rig with a prior adds its shapes.
///
/// `displacements`: one per rig point, from its neutral position, in the mesh's unit. `positions`: one per vertex,
/// filled. Does not throw, allocate, lock or log; the result does not depend on threads.
void deform(const Rig& rig, std::span<const Vec3f> displacements, std::span<Vec3f> positions) noexcept;

/// The whole take on the whole head, one row at a time. The head poses of the take are not applied.
/// Throws Error if the mesh is not the one the rig was made for (vertex counts differ) or the take drives no rig point.
MeshSequence deform(const Rig& rig, const Mesh& mesh, const Take& take);

}  // namespace mien
