// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstdint>
#include <vector>

#include "mien/rig.hpp"

namespace mien {

/// Shapes that show how faces move, on the vertices of the head that is to be rigged.
struct Examples {
    std::vector<MorphTarget> own;      ///< of this very head: sculpted or scanned
    std::vector<MorphTarget> carried;  ///< of other heads, brought over by `carry_shapes`
};

struct PriorOptions {
    /// Shapes may only be added, never taken away: nearer to the truth where motion is made of known shapes, and
    /// solved per frame. Off: one linear map, for engines that cannot solve. Carried shapes alone are always linear.
    bool one_sided = true;
    /// Points kept per vertex, refitted rather than cut; 0 keeps all.
    std::uint32_t influences = 8;
};

/// Builds a rig that has learnt from example shapes: each vertex follows the points as the smooth sheet and the shapes
/// together have it, and what the motion of the points shows of a shape is added as that shape.
///
/// Own shapes become shapes of the rig's prior; carried ones beside them only say how strongly places move, and
/// together. Without own shapes the carried ones take both parts, with less trust. Any number of shapes of any names;
/// one that moves no skin is left out. Source: docs/methods.md, "From example shapes"; a Gaussian process in the sense
/// of Luethi, Gerig, Jud and Vetter, Gaussian Process Morphable Models (2018), with a kernel of its own.
///
/// - The result does not depend on unit, origin or vertex order.
/// - A vertex at a feature point follows it exactly; points that keep still leave the face still.
/// - Pieces without points that an example moves follow it; others are attached as `attach_islands` does.
///
/// Throws Error where `rig_biharmonic` does, and if there is no shape that moves the skin, a shape names a vertex the
/// head does not have or holds a number that is not finite, or there are more than `Prior::most_shapes`.
Rig rig_prior(const Face& face, const Examples& examples, const PriorOptions& options = {});

}  // namespace mien
