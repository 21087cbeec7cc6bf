// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstdint>

#include "mien/rig.hpp"
#include "mien/take.hpp"

namespace mien {

struct SkinOptions {
    std::uint32_t influences = 4;  ///< joints per vertex: 4 (every viewer) or 8 (most engines); a multiple of 4
};

/// Turns a rig into the skin that engines play: weights made non-negative, cut to a few joints, filled up with the
/// still joint. The kept weights are refitted so that the motion of `take` changes least; the error that is left is
/// measured over the whole take and stored in the result.
///
/// `take`: retargeted to the rig's face; without rows the fit assumes that near points move alike, and the error is
/// that of moving each point alone by one unit. Throws Error if `influences` is not 4, 8, 12 or 16.
Skin make_skin(const Rig& rig, const Take& take, const SkinOptions& options = {});

}  // namespace mien
