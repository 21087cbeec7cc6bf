// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "mien/vec.hpp"

namespace mien {

/// A place of the skin that a feature point may mark.
struct Site {
    std::string_view id;
    std::string_view mirror;  ///< its partner on the other side; itself on the midline
    std::string_view words;
    Vec3 position;        ///< on the generic face, as generic_position has it
    double mobility = 0;  ///< root mean square motion in 25 expressions, in eye distances
};

/// The MPEG-4 points whose place on an ordinary face is known, without pupils, and the named sites beyond that list.
std::vector<Site> skin_sites();

}  // namespace mien
