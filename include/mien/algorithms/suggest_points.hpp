// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mien/face.hpp"

namespace mien {

struct SuggestOptions {
    /// How many points to suggest at most. Those off the midline come in pairs.
    std::uint32_t count = 7;
};

/// A feature point that a face lacks, placed on its skin.
struct Suggestion {
    FeaturePoint point;       ///< an MPEG-4 point, or a named site where that list has none ("throat")
    std::string place;        ///< where it is, in words
    double error_before = 0;  ///< what the default rig is likely to miss of ordinary motion, as a share of that motion,
    double error_after = 0;   ///< and what it misses with this point, its partner and all that stand before it
};

/// The points whose motion would tell most about a face that a rig cannot know without them, best first, and the chin
/// before all where it has none.
///
/// Ordinary motion is a random field that is as smooth as the sheet of the default rig and as strong at each site as 25
/// known expressions are there; what the rig misses of it is the field less the rig's own guess from the points it has.
/// Sites are taken one by one (a pair as one), each time those that lower the miss most for a point. Candidates are the
/// MPEG-4 points of the skin and named sites of throat, jaw, neck, cheeks, forehead, folds and lids. Each is placed by
/// the warp of space that takes an ordinary face's points to this one's, and then on the nearest skin.
///
/// - `FeaturePoint::snapped` is how far the last step went, in the mesh's unit. Sites that the head does not have (no
///   neck) or that lie where a point is are left out, so fewer may come back.
/// - Looks at points that lie on skin; those on eyeballs, teeth and tongue are never suggested.
///
/// Throws Error as riggers do, or if fewer than four of the face's points are known MPEG-4 points of the skin.
std::vector<Suggestion> suggest_points(const Face& face, const SuggestOptions& options = {});

}  // namespace mien
