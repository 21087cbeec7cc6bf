// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include "character.hpp"
#include "skin.hpp"

namespace mien::samples {

/// The hair of a character: cap, locks and bun, coloured by the picture "hair".
Surface make_hair(const Character& character, const Skin& skin);

/// Per vertex of the skin how much hair covers it, 0 to 1, soft at the hair line.
std::vector<double> hair_cover(const Character& character, const Skin& skin, const Surface& hair);

}  // namespace mien::samples
