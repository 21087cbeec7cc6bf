// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "mien/mesh.hpp"

namespace mien {

/// What a rig knows from example shapes: how much of each shape the motion of the points shows, and what the shape then
/// adds to what the rig's rows do (docs/methods.md, "From example shapes").
///
///     position_v = rest_v + sum_i weight_vi d_i + sum_k c_k shape_k(v)        c = shape_weights(d)
///
/// The shapes are what is left of the examples when the rows have moved the shape's own points, so an engine that plays
/// the rows as a skin plays these as plain morph targets beside it.
struct Prior {
    static constexpr std::size_t most_shapes = 256;

    std::vector<MorphTarget> shapes;  ///< at most `most_shapes`; weight 1 is about the whole example
    /// shapes x points: what c would be if shapes could also be taken away, c_k = sum_i response_ki . d_i.
    std::vector<Vec3> response;
    /// shapes x shapes, symmetric and positive definite: what a wrong c costs. Empty: c is the response itself, linear
    /// in the motion. Otherwise shapes are only ever added: c is the vector without negative entries that is nearest to
    /// the response in this measure. It is unique and follows the motion without jumps.
    std::vector<double> stiffness;
};

inline bool is_one_sided(const Prior& prior) {
    return !prior.stiffness.empty();
}

/// How much of every shape a motion of the points shows. `displacements`: as for `deform`, one per rig point.
/// `weights`: one per shape, filled. By projected Gauss-Seidel, a fixed number of sweeps, so that equal motion has
/// equal weights and near motion near ones. Neither throws nor allocates.
void shape_weights(const Prior& prior, std::span<const Vec3f> displacements, std::span<float> weights) noexcept;

}  // namespace mien
