// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstdint>

#include "mien/rig.hpp"

namespace mien {

struct BiharmonicOptions {
    /// Stiffness against stretch relative to bending, per squared eye distance; a larger value keeps motion nearer to
    /// the point. 41 is a decay length of 0.157 eye distances; the optimum is flat from 20 to 80.
    double tension = 41;
    /// Vertices farther than this from every point, along the surface and in eye distances, keep still. 1.2 or more.
    double far_radius = 1.6;
    /// Points kept per vertex, refitted rather than cut; 0 keeps all. 4 to 16.
    std::uint32_t influences = 8;
    /// Eye sockets and mouth bags that are one surface with the face are left out of the solve; their walls follow
    /// their rims and the skin outside.
    bool cut_pockets = true;
};

/// Builds a rig in which the skin bends like a thin elastic sheet that the feature points hold: smooth everywhere, no
/// folds, and lips and lids stay apart because the sheet ends at them. The default.
///
/// Minimises x'(L M^-1 L + a L)x per point with L the cotangent Laplacian of the welded surface, M its lumped vertex
/// areas, the feature points fixed at one or zero and far vertices at zero; weights have no slope at open borders. One
/// scalar weight per vertex and point; weights may be negative. Source: tension biharmonic interpolation,
/// docs/methods.md.
///
/// - The result does not depend on unit, origin or vertex order.
/// - A vertex at a feature point follows it exactly.
/// - Islands without points are attached (eyeballs, teeth, lashes, hair) and listed in `Rig::attachments`.
/// - A point constrained along an axis is left out of the solve for that axis.
///
/// Throws Error if the face has no feature point, if a vertex is out of range, or if the solve leaves a residual.
Rig rig_biharmonic(const Face& face, const BiharmonicOptions& options = {});

}  // namespace mien
