// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <span>
#include <vector>

#include "mien/mesh_sequence.hpp"

namespace mien {

/// MDD point cache: big-endian; frame and point counts, times in seconds, then every vertex of every row.
void format_mdd(const MeshSequence& sequence, std::ostream& out);

/// PC2 point cache: little-endian, 32-byte header with start 0 and sample rate 1 in frames: one sample per row
/// of the take, played at the frame rate of the scene.
void format_pc2(const MeshSequence& sequence, std::ostream& out);

/// The rows of an MDD or PC2 on the head that they were made of, whose vertices they hold in file order. The bytes are
/// kept, and taken apart when a row is asked for. Times count from the first row.
///
/// `rate`: rows per second, above 0, in place of the file's own times; 0: those of the MDD, while a PC2, which counts
/// in frames, needs it (frames per second). Throws Error naming the byte, expected and found: for another size than the
/// header says, another number of vertices than the head's, numbers that are not finite, and times that do not rise.
MeshSequence parse_mdd(std::vector<std::byte> bytes, Mesh head, double rate = 0);
MeshSequence parse_pc2(std::vector<std::byte> bytes, Mesh head, double rate);

/// What a point cache holds.
struct PointCacheContent {
    std::uint32_t rows = 0, vertices = 0;
    std::vector<double> times;  ///< of an MDD: seconds from the first row, one per row
};

/// What a cache says of itself, checked as above but for the head.
PointCacheContent check_mdd(std::vector<std::byte> bytes);
PointCacheContent check_pc2(std::vector<std::byte> bytes);

/// One OBJ with the row's positions, the mesh's polygons, groups and texture coordinates.
void format_obj(const Mesh& mesh, std::span<const Vec3f> positions, std::ostream& out);

}  // namespace mien
