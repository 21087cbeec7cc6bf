// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include "mien/algorithms/weld.hpp"
#include "mien/rig.hpp"

namespace mien {

/// Attaches every island of the head that holds none of the rig's points on skin: eyeballs turn about their centre,
/// lower teeth and tongue follow the jaw, upper teeth and hair follow the skull, lashes and brows follow the skin under
/// them. Never torn, never silently dropped: each gets an entry in `Rig::attachments`.
///
/// `rig` has its skin rows already; this fills the rows (or `eyeballs`) of the vertices on islands without points.
void attach_islands(Rig& rig, const Face& face, const Weld& weld);

}  // namespace mien
