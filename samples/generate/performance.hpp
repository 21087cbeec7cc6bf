// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <string>

#include "head.hpp"

#include "mien/take.hpp"

namespace mien::samples {

struct Performance {
    Take take;                  ///< columns are marker names, millimetres, 60 rows a second
    std::vector<Rename> names;  ///< marker name -> feature point
};

/// Eight seconds by a performer whose face is a little broader and shorter than the sample head: brows up, blink,
/// frown, smile, open jaw, pucker, "ma-ma, oo, fa". The head turns, nods and drifts; some samples are lost; row 0 is
/// neutral.
Performance perform(const Head& head);

std::string format_trc_take(const Take& take);
std::string format_names(const Performance& performance);

}  // namespace mien::samples
