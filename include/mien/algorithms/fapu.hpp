// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <span>
#include <vector>

#include "mien/algorithms/tracks.hpp"
#include "mien/face.hpp"
#include "mien/fap.hpp"
#include "mien/take.hpp"

namespace mien {

/// The units and pivots of a face that rests: eyes open, lips together, gaze straight on, +x to its left, +y up, +z out
/// of it. Eye height and separation are those of the pupils; lids are the mean of both eyes.
///
/// What has no point is estimated, and `Fapu::estimated` says from what: eyes from the corners or the lids, the bottom
/// of the nose from its edges, nostrils or tip, the inner lip from the line of the lips, and at last distances as
/// shares of the eye separation, the means of five heads (iris 0.17, eyes to nose 0.79, nose to mouth 0.33, mouth width
/// 0.82).
///
/// Throws Error if no eye separation can be told, and if the left eye does not lie at larger x than the right one.
Fapu measure_fapu(std::span<const FeaturePoint> neutral);

/// The same, with the eyeballs of the mesh, where it has some, as what the eyes turn about.
Fapu measure_fapu(const Face& face);

/// The units that a small mouth can take: MNS in proportion to MW where that is less than 0.8 of what it usually is
/// beside it. A muzzle whose mouth is far from the nose and narrow is torn by lips that move in MNS. Not the standard's
/// units: for showing, not for measuring.
Fapu restrained(Fapu fapu);

/// The points of one row of a take, for measuring a performer; lost ones are left out. Throws Error if there is no such
/// row.
std::vector<FeaturePoint> points_of_row(const Take& take, std::size_t row);

/// The points of its neutral face; those that are never seen are left out. Throws Error if the rows are not in the
/// take.
std::vector<FeaturePoint> neutral_points(const Take& take, const NeutralOptions& neutral);

}  // namespace mien
