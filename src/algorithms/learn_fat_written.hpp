// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <vector>

#include "mien/algorithms/upright_sequence.hpp"
#include "mien/fap.hpp"
#include "mien/fat.hpp"

namespace mien {

/// The tables of an animation as Laftsidis et al., section 2.2, write it; none for parameters that move no vertex.
std::vector<FaceDefTables> learn_tables_written(const UprightSequence& upright, const FapStream& stream);

}  // namespace mien
