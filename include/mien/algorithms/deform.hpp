// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mien/mesh_sequence.hpp"
#include "mien/rig.hpp"
#include "mien/take.hpp"

namespace mien {

/// Moves every vertex by its row of the rig: eq. 5 of Kshirsagar et al. with the denominator folded in at bind time,
/// which is also the skinning sum of Dutreve et al., section 3.1.
///
/// `displacements`: one per rig point, from its neutral position, in the mesh's unit. `positions`: one per vertex,
/// filled. Does not throw, allocate, lock or log; the result does not depend on threads.
void deform(const Rig& rig, std::span<const Vec3f> displacements, std::span<Vec3f> positions) noexcept;

/// Where the columns of a take land on a rig's points.
struct TakeBinding {
    std::vector<std::int32_t> columns;  ///< one per rig point: its column in the take, or -1: it keeps still
    std::vector<std::string> missing;   ///< rig points that the take does not drive
    std::vector<std::string> unused;    ///< take columns that the rig does not have
};
TakeBinding bind_take(const Rig& rig, const Take& take);

/// Displacements of the rig's points in one row of a take that was retargeted to this face. A lost sample keeps its
/// point at neutral for that row. `displacements`: one per rig point, filled.
void displacements(const Rig& rig, const TakeBinding& binding, std::span<const Vec3> row,
                   std::span<Vec3f> displacements) noexcept;

/// The whole take on the whole head, one row at a time. The head poses of the take are not applied.
/// Throws Error if the mesh is not the one the rig was made for (vertex counts differ) or the take drives no rig point.
MeshSequence deform(const Rig& rig, const Mesh& mesh, const Take& take);

}  // namespace mien
