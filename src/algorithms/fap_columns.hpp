// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mien/fap.hpp"
#include "mien/mesh_sequence.hpp"

namespace mien {

/// Frames of a stream and the rows of the animation that show them, and the values of the parameters that move there.
struct FapColumns {
    std::vector<std::size_t> rows;  ///< one per frame
    std::vector<int> faps;          ///< one per column, ascending: those with a value other than 0
    Eigen::MatrixXd values;         ///< frames x columns, FAP units
};

/// The rows are those of `rows_of_frames`. Throws Error where there is none. Parameters in `left_out` have no column.
FapColumns fap_columns(const MeshSequence& sequence, const FapStream& stream, std::span<const int> left_out);

/// How far the value passes through [low, high] on its way from 0. Over borders that hold 0 the pieces add up to it;
/// the outermost go on for ever.
double piece(double value, double low, double high);

/// The displacements of vertices from their neutral place in some rows: rows x 3 vertices.
Eigen::MatrixXd displacements_of(const MeshSequence& sequence, std::span<const std::size_t> rows,
                                 std::span<const std::uint32_t> vertices);

}  // namespace mien
