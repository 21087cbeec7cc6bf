// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "mien/algorithms/weld.hpp"
#include "mien/face.hpp"

namespace mien {

/// The closed pockets of a head, and what their walls hang on.
struct Pockets {
    std::vector<std::uint32_t> places;   ///< ascending
    std::vector<std::uint32_t> outside;  ///< for each the skin behind it, through the flesh; itself where none is
    std::vector<double> shares;          ///< of what the skin outside does, the smaller the thicker the flesh
    double softness = 0;                 ///< how far from the rim the flesh takes over, in the mesh's unit
};

/// Pockets of the marked places. The skin outside is the nearest place of the solved skin that shows its inside to the
/// inside of the wall: the lip to its lining, the chin to the floor of the mouth. `scale`: the eye distance.
Pockets line_pockets(const Face& face, const Weld& weld, const std::vector<bool>& solved,
                     const std::vector<bool>& marked, double scale);

/// Weights of the walls from those of all others (places x columns, the rows of walls are ignored): they go over from
/// the rim's to those of the skin outside, so that flesh keeps its thickness, and no weight leaves the range of theirs.
/// One row per place of the pockets.
Eigen::MatrixXd fill_pockets(const Mesh& mesh, const Weld& weld, const Pockets& pockets,
                             const Eigen::MatrixXd& weights);

}  // namespace mien
