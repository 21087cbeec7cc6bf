// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include "mien/fap.hpp"
#include "mien/take.hpp"

namespace mien {

struct ToFapsOptions {
    /// Frames per second; 0: those of the take. Each frame takes the row nearest to its time, and is left out when none
    /// lies within half a frame of it.
    double rate = 0;
};

/// The motion of a face's points as parameters, in the units of that face: FAP = displacement from the neutral place
/// along the parameter's axis * 1024 / unit, rounded. Paper: Laftsidis et al., with the signs of ISO/IEC 14496-2.
///
/// `take`: free of head motion, which its head poses hold. Poses become FAPs 48 to 50: a turn by roll about z, then by
/// pitch about x, then by yaw about y; how the head shifts cannot be said in FAPs. Pupils (3.5, 3.6) become turns of
/// the eyeballs, yaw after pitch, and what lies beyond the ball becomes their thrust. The tongue lies in the jaw: 6.1
/// to 6.4 go by FAPs 3, 14 and 15 as 2.1 does, and their own say how they move beside it. The edges (6.3, 6.4) become
/// its roll. Pupils do not dilate in a take of points. What has no column, no neutral place or a lost
/// sample is not sent. Throws Error if the take has no row or the rate is negative.
FapStream to_faps(const Take& take, const Fapu& fapu, const ToFapsOptions& options = {});

/// The points of a face as the parameters move them, and head poses where a frame sends some: what `to_faps` undoes to
/// within half a unit. One row per frame; every point of the face has a column, and what is not sent rests. Pass the
/// stream through `resolve_faps` first to hold, fill and expand what it does not say outright.
Take to_take(const FapStream& stream, const Fapu& fapu);

}  // namespace mien
