// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <iosfwd>
#include <span>

#include "mien/mesh_sequence.hpp"

namespace mien {

/// MDD point cache: big-endian; frame and point counts, times in seconds, then every vertex of every row.
void format_mdd(const MeshSequence& sequence, std::ostream& out);

/// PC2 point cache: little-endian, 32-byte header with start 0 and sample rate 1 in frames: one sample per row
/// of the take, played at the frame rate of the scene.
void format_pc2(const MeshSequence& sequence, std::ostream& out);

/// One OBJ with the row's positions, the mesh's polygons, groups and texture coordinates.
void format_obj(const Mesh& mesh, std::span<const Vec3f> positions, std::ostream& out);

}  // namespace mien
