// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <span>

#include "mien/fap.hpp"
#include "mien/fat.hpp"
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

/// Moves every vertex as a face animation table says (ISO/IEC 14496-1; see `Fat`). Visemes and expressions of the frame
/// play where the table has them: select1 with the value `blend`, select2 with 63 - `blend`; expressions with their
/// intensities. What the frame does not send rests.
///
/// `fat`: one that `check_fat` accepts for this head. `rest`: the neutral positions. `positions`: one per vertex,
/// filled. Does not throw, allocate, lock or log; the result does not depend on threads.
void deform(const Fat& fat, std::span<const Vec3f> rest, const FapFrame& frame, std::span<Vec3f> positions) noexcept;

/// The whole stream on the whole head, a row per frame, head turns too where the table has them. Frames are taken as
/// they are: `resolve_faps` holds and fills what they do not say. Throws Error if the table does not fit the mesh.
MeshSequence deform(const Fat& fat, const Mesh& mesh, const FapStream& stream);

/// Moves every vertex as a face animation table says (ISO/IEC 14496-1; see `Fat`). Visemes and expressions of the frame
/// play where the table has them: select1 with the value `blend`, select2 with 63 - `blend`; expressions with their
/// intensities. What the frame does not send rests.
///
/// `fat`: one that `check_fat` accepts for this head. `rest`: the neutral positions. `positions`: one per vertex,
/// filled. Does not throw, allocate, lock or log; the result does not depend on threads.
void deform(const Fat& fat, std::span<const Vec3f> rest, const FapFrame& frame, std::span<Vec3f> positions) noexcept;

/// The whole stream on the whole head, a row per frame, head turns too where the table has them. Frames are taken as
/// they are: `resolve_faps` holds and fills what they do not say. Throws Error if the table does not fit the mesh.
MeshSequence deform(const Fat& fat, const Mesh& mesh, const FapStream& stream);

}  // namespace mien
