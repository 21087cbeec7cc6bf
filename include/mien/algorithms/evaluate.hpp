// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "mien/face.hpp"
#include "mien/mesh.hpp"
#include "mien/rig.hpp"

namespace mien {

/// How far a region of the face is from the truth.
struct RegionFigures {
    std::string name;          ///< "mouth", "jaw", "brows", "lids", "eyes", "nose", "cheeks"; "rest": all else
    std::size_t vertices = 0;  ///< of the file
    double error = 0;          ///< RMS error / RMS true motion, over the region; 0 where neither moves, infinite where
                               ///< only the rig moves
    double p95 = 0;            ///< 95th percentile of the error over its vertices that truly move, in eye distances
    double max = 0;            ///< largest error of one of its vertices, in eye distances
};

/// How far one shape made from its feature points is from the shape itself.
struct ShapeFigures {
    std::string shape;
    double error = 0;     ///< RMS error / RMS true motion, over all vertices: 0 exact, 1 as bad as not moving
    double p95 = 0;       ///< 95th percentile of the error over vertices that truly move, in eye distances
    double max = 0;       ///< largest error of a vertex, in eye distances
    double flipped = 0;   ///< share of the moving faces whose normal opposes the true one
    double lid_gap = 0;   ///< largest difference from the true opening anywhere along the lids, in eye distances
    double lip_gap = 0;   ///< the same along the lips
    double crossing = 0;  ///< how far lids or lips pass through each other beyond the truth, in eye distances
    std::vector<RegionFigures> regions;  ///< those with vertices, in the order above
};

/// How well feature points and a rig reproduce known shapes.
struct Evaluation {
    std::string method;
    double error = 0;                               ///< mean over the shapes
    double pooled = 0;                              ///< root of all squared error over all squared motion
    double p95 = 0;                                 ///< mean over the shapes
    double max = 0;                                 ///< over all shapes
    double flipped = 0;                             ///< of all moving faces
    double lid_gap = 0, lip_gap = 0, crossing = 0;  ///< largest of all shapes
    std::vector<ShapeFigures> shapes;               ///< in the order of the mesh
    std::vector<RegionFigures> regions;             ///< errors pooled over the shapes; p95 and max the largest
    std::vector<std::string> still;                 ///< shapes that move nothing: left out
};

/// Gives a rig only what the feature points do in each of the head's own shapes and compares every vertex with the
/// shape: what a report on a head, a set of points or a rigger stands on.
///
/// A vertex or face counts as moving when it goes farther than 0.2 % of the eye distance, in truth or by the rig (for
/// `p95`, in truth). Regions are those of partial.hpp: a vertex belongs to the feature point that is nearest along the
/// surface; eyeballs are "eyes". The measure: docs/evaluate.md.
///
/// `face.mesh.morph_targets` are the truth; `rig` was made from this face, or from fewer of its points.
/// Throws Error if the rig has other vertices than the mesh, if the mesh has no shape that moves something, or if the
/// points have no size.
Evaluation evaluate(const Face& face, const Rig& rig);

/// The shapes as the rig makes them from the feature points, in the order and with the names of the mesh's own.
std::vector<MorphTarget> reproduce_shapes(const Face& face, const Rig& rig);

}  // namespace mien
