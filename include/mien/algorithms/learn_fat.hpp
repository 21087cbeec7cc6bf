// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <vector>

#include "mien/algorithms/reading.hpp"
#include "mien/algorithms/upright_sequence.hpp"
#include "mien/fap.hpp"
#include "mien/fat.hpp"

namespace mien {

/// What an animation tells of one parameter.
struct LearntParameter {
    int fap = 0;
    std::size_t active = 0;  ///< frames in which it is not near rest: beyond a twentieth of its largest value
    std::size_t alone = 0;   ///< of those, frames in which all others are near rest
    /// How much of its course no linear mix of the other parameters follows, 0 to 1: the share of its square. Near 0
    /// the animation never shows what it does alone, and its field is a matter of locality.
    double confidence = 0;
    std::size_t vertices = 0;   ///< that depend on it
    std::size_t intervals = 0;  ///< of its displacement; 1 is plainly linear
};

/// A table learnt from an animation, and what is known about it.
struct LearntFat {
    Fat fat;
    std::vector<LearntParameter> parameters;  ///< those that ever move, ascending
    /// Per vertex the root mean square of the motion over the frames, and of what no linear combination of all
    /// parameters gives: what they cannot express. In the unit of the mesh.
    std::vector<double> motion, beyond;
};

/// Finds how every vertex follows the parameters. Paper: Laftsidis et al., section 2.2.
///
/// As written: a vertex depends on a parameter if it is displaced in every frame in which the parameter is active, and
/// if growth over the edges of the welded mesh reaches it from the parameter's feature point through such vertices.
/// Borders are the values at which the vertex is displaced farthest along an axis, either way; what it did there is the
/// displacement, whoever else was active.
///
/// Remedied: all parameters explain a vertex together, by least squares over all frames, drawn towards what the
/// default rig does with the parameter's point, the more the farther along the surface that lies; parameters that a
/// vertex can do without are dropped. A parameter is bent (at 0 and halfway) where that pays. Eyeballs of their own
/// and the head follow theirs as FaceDefTransform: nodes "left eye", "right eye" and "head", the last.
///
/// `stream`: of this animation; frame times are counted from its first row. `fapu`: of its neutral head. Throws Error
/// if the stream has no frame or no time of it lies in the animation.
LearntFat learn_fat(const UprightSequence& upright, const Fapu& fapu, const FapStream& stream,
                    Reading reading = Reading::remedied);

}  // namespace mien
