// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <Eigen/SparseCore>

#include "mien/algorithms/weld.hpp"
#include "mien/mesh.hpp"

namespace mien {

/// The cotangent Laplacian of a welded surface and the area that each place stands for, one row per place.
/// `stiffness` is symmetric, positive semidefinite, without unit, and vanishes on constants; `areas` are all positive.
struct Laplacian {
    Eigen::SparseMatrix<double> stiffness;
    Eigen::VectorXd areas;
};

enum class Cotangents {
    exact,     ///< those of obtuse corners are negative
    positive,  ///< negative ones raised to zero: what diffuses then stays between the values around it
};

/// Polygons count as the mean of the fans from their corners, so that no diagonal is preferred. Slivers and triangles
/// without area are softened, never dropped: what hangs on them moves along.
Laplacian laplacian(const Mesh& mesh, const Weld& weld, Cotangents cotangents = Cotangents::exact);

}  // namespace mien
