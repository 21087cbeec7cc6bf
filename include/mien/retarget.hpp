// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <array>
#include <string>
#include <vector>

#include "mien/vec.hpp"

namespace mien {

/// The fitted map from a performer's feature points to a target face's. Plain data: fit it with `fit_retarget`, apply
/// it with `retarget`. It holds one of two forms:
///
/// - one linear map per point, which turns the motion of the source's point into the target's (`local` is not empty);
/// - a radial basis function network F(p) = sum_i w_i sqrt(|p - s_i|^2 + sc_i^2) (+ a + A p), trained so that
///   F(s_i) = t_i (Dutreve et al., eq. 1-3).
struct Retarget {
    std::vector<std::string> points;   ///< ids that source and target share, in the target's order
    std::vector<Vec3> source_neutral;  ///< s_i, in the take's unit
    std::vector<Vec3> target_neutral;  ///< t_i, in the target's unit
    bool planar = false;               ///< fitted to a 2D source: z of the source is taken as 0

    std::vector<std::array<Vec3, 3>>
        local;  ///< one per point: columns of its map, from the take's unit to the target's

    std::vector<double> scales;  ///< sc_i, in the take's unit
    std::vector<Vec3> weights;   ///< w_i, one per point
    Vec3 offset;                 ///< a; zero in the paper's form
    Vec3 columns[3];             ///< columns of A; zero in the paper's form
    double residual = 0;         ///< largest |F(s_i) - t_i|, in the target's unit
};

}  // namespace mien
