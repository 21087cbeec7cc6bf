// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <vector>

#include "mien/algorithms/weld.hpp"
#include "mien/rig.hpp"

namespace mien {

/// Which places of the welded surface a rigger solves: those on islands that hold a feature point, except eyeballs,
/// which turn about their centre even when 3.5 or 3.6 lies on their pupil. One flag per place. A rigger leaves the rows
/// of all other places empty and then calls `attach_islands`.
std::vector<bool> solved_places(const Face& face, const Weld& weld);

/// Attaches every island of the head that is not solved (see `solved_places`): eyeballs turn about their centre, lower
/// teeth and tongue follow the jaw, upper teeth and hair follow the skull, lashes and brows follow the skin under them.
/// Never torn, never silently dropped: each gets an entry in `Rig::attachments`.
///
/// `rig` was made from `face` and has the rows of the solved places already; this fills `eyeballs` and the rows of all
/// other vertices.
void attach_islands(Rig& rig, const Face& face, const Weld& weld);

}  // namespace mien
