// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <string>

#include "mien/draw/annotate.hpp"

namespace mien {

/// What is written at the ends of a legend's bar, and how far from it in sizes of the letters.
struct LegendEnds {
    std::string before, behind;
};
LegendEnds ends_of(const Legend& legend);
constexpr double legend_gap = 0.5;

}  // namespace mien
