// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <optional>
#include <span>
#include <string>

#include "mien/face.hpp"
#include "mien/mesh.hpp"

namespace mien {

/// What is left open of a pair of lids or lips, at 19 places from corner to corner.
struct Openness {
    double most = 0;   ///< the widest place, as a share of the slit's height at rest; 0 is closed
    double least = 0;  ///< the narrowest one; negative where the edges cross
};

/// What must be true of a face's shapes, by their standard names.
struct ShapesCheck {
    std::optional<Openness> blink_left,
        blink_right;  ///< eyeBlink at full weight; nothing where the edges are not known
    /// jawOpen with mouthClose at full weight, as shares of how far jawOpen alone opens the lips in the middle; what
    /// is open at rest does not count.
    std::optional<Openness> closed_jaw;
    std::optional<double> upper_lip;  ///< how far jawOpen moves the middle of the upper lip, as a share of the lower's
    double flipped = 0;        ///< share of the faces moved by single shapes whose normal turns by over 90 degrees;
                               ///< mouthClose is looked at with jawOpen, for which it is made
    std::string most_flipped;  ///< the shape with the largest share, and that share
    double most_flipped_share = 0;
};

/// Measures shapes: of a file, or as `make_shapes` gives them. A face counts as moved where one of its vertices goes
/// farther than 0.2 % of the eye distance. Throws Error if a shape has a vertex out of range.
ShapesCheck check_shapes(const Face& face, std::span<const MorphTarget> shapes);

}  // namespace mien
