// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstdint>

#include "mien/mesh_sequence.hpp"

namespace mien {

struct BakeOptions {
    /// Most morph targets kept. A larger value lowers the error and makes the file larger.
    std::uint32_t morphs = 24;
    /// Stop earlier when the root mean square error falls under this share of the largest motion.
    double tolerance = 1e-3;
    /// Deltas shorter than this share of the largest motion are dropped from a target, which keeps it sparse.
    double sparsity = 1e-4;
};

/// Turns a baked motion into a few sparse morph targets with a weights track: a truncated singular value decomposition
/// of rows x (3 vertices), fewest targets first, with the error that is left measured and stored in the result.
///
/// Works in memory that does not grow with rows x vertices beyond one float per moving coordinate and row kept in
/// blocks. Throws Error if the sequence has no rows or a row holds a number that is not finite.
MorphTrack bake_morphs(const MeshSequence& sequence, const BakeOptions& options = {});

}  // namespace mien
