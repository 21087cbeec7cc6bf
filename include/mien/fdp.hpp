// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <vector>

#include "mien/fap.hpp"
#include "mien/fat.hpp"
#include "mien/mesh.hpp"

namespace mien {

/// What a decoder of MPEG-4 is told about one face (the FDP node of ISO/IEC 14496-1): its feature points, its units,
/// its model and how that follows the parameters. Each of them may be absent.
struct Fdp {
    std::vector<FeaturePoint> points;  ///< in the model's unit; lips that rest may share a place
    Fapu fapu;                         ///< the five distances alone; 0 where one is not known
    Mesh mesh;                         ///< the neutral head
    Fat fat;                           ///< of this mesh
};

}  // namespace mien
