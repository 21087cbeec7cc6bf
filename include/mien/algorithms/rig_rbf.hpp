// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstdint>

#include "mien/rig.hpp"

namespace mien {

struct RbfRigOptions {
    enum class Kernel {
        linear,   ///< -r with r straight through space, and a constant: smooth far from the points
        surface,  ///< exp(-r / 2s) with r along the surface and s the mean distance of a point to its nearest other
    };
    Kernel kernel = Kernel::linear;
    /// Points kept per vertex, refitted rather than cut; 0 keeps all. 4 to 16.
    std::uint32_t influences = 8;
};

/// Builds a rig by interpolating the motion of the feature points with radial basis functions: each vertex moves as the
/// smoothest field does that agrees with all the points and stands still far from them.
///
/// The places farther than 1.6 eye distances from every point, about 40 of them spread evenly, hold the field at zero.
/// The weights of a vertex solve K w = k, K the kernel between points and still places, k that to the vertex; negative
/// eigenvalues, which distances along a surface may give, are clipped. Source: scattered data interpolation as in
/// docs/methods.md.
///
/// - The result does not depend on unit, origin or vertex order.
/// - A vertex at a feature point follows it exactly. Pieces of the mesh only follow points of their own.
/// - With the linear kernel lips that touch in space follow each other, as distances are straight; with that along the
///   surface they do not.
/// - A point constrained along an axis is left out of the solve for that axis.
///
/// Throws Error if the face has no feature point, if a vertex is out of range, or if the solve leaves a residual.
Rig rig_rbf(const Face& face, const RbfRigOptions& options = {});

}  // namespace mien
