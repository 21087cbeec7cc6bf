// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>

#include "mien/mesh_sequence.hpp"

namespace mien {

/// How many bytes an animation takes as a mesh whose positions are stored, for comparison with a stream of parameters.
struct BakedSize {
    std::size_t point_cache = 0;  ///< .mdd: every position of every row, plain
    /// glTF with one morph target per row, 16-bit deltas (KHR_mesh_quantization) and EXT_meshopt_compression.
    std::size_t morph_per_row = 0;
    /// The same with the few targets of a MorphTrack and 16-bit weights.
    std::size_t morph_track = 0;
};

/// Bytes of buffers after compression with meshoptimizer, vertex order as in the file; JSON and materials are not
/// counted. `track`: of the same animation. Throws Error if a row holds a number that is not finite.
BakedSize baked_size(const MeshSequence& sequence, const MorphTrack& track);

}  // namespace mien
