// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "algorithms/fap_columns.hpp"

#include "mien/algorithms/upright_sequence.hpp"
#include "mien/algorithms/weld.hpp"
#include "mien/fat.hpp"
#include "mien/mesh.hpp"

namespace mien {

/// Pieces of a head that move together as one and keep their shape: lower teeth, gums and tongue on a jaw's joint.
struct RigidPart {
    std::string name;
    std::vector<std::uint32_t> vertices;  ///< ascending
    std::vector<Pose> poses;              ///< one per row that was looked at: neutral -> row
};

/// Islands that move and keep their shape in all the rows, those of one motion as one part. The largest island, which
/// is the skin, and those with a vertex in `others` are none.
std::vector<RigidPart> rigid_parts(const UprightSequence& upright, const Weld& weld, std::span<const std::size_t> rows,
                                   const std::vector<bool>& others);

/// A transform and the parameter that it follows.
struct PartTransform {
    int fap = 0;
    FaceDefTransform transform;
};

/// How the part follows the parameters of the jaw (3, 14, 15), as turns about one centre and shifts.
struct PartFit {
    Vec3 centre;
    std::vector<PartTransform> transforms;  ///< of node 0
    double error = 0;                       ///< root mean square distance over its vertices and the rows
};
PartFit fit_part(const RigidPart& part, const Mesh& mesh, const FapColumns& columns);

}  // namespace mien
