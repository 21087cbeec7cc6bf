// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "mien/vec.hpp"

namespace mien {

/// Stands for a point that is not there.
inline constexpr std::size_t no_point = std::numeric_limits<std::size_t>::max();

/// Two points that meet when the face closes: an upper and a lower lid, an upper and a lower lip. What the target's
/// opening is for each opening of the source. Openings are in eye distances of their own face.
struct ContactPair {
    enum class Kind { lids, inner_lips, outer_lips };
    Kind kind = Kind::lids;
    std::size_t upper = no_point;       ///< into `Retarget::points`
    std::size_t lower = no_point;       ///< none: the source lacks the lower lid, and it is taken to be still
    std::size_t fold_above = no_point;  ///< the folds beside the lids take half of their lid's correction
    std::size_t fold_below = no_point;
    Vec3 source_up, target_up;                      ///< directions in which the pair opens, of length 1
    Vec3 source_rest, target_rest;                  ///< upper less lower point at rest, in the unit of the points
    double source_opening = 0, target_opening = 0;  ///< at rest, along those directions
    double closing = 1, opening = 1;                ///< target's opening per source's, below rest and far above it
    double bend = 1;                                ///< source's opening over which one slope passes into the other
    double closed = 0;                              ///< the least opening of the target
};

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
        local;                       ///< one per point: columns of its map, from the take's unit to the target's
    std::vector<ContactPair> pairs;  ///< no point is in two; empty without contact
    double source_eyes = 0, target_eyes = 0;  ///< eye distances, in the unit of the points

    std::vector<double> scales;  ///< sc_i, in the take's unit
    std::vector<Vec3> weights;   ///< w_i, one per point
    Vec3 offset;                 ///< a; zero in the paper's form
    Vec3 columns[3];             ///< columns of A; zero in the paper's form
    std::vector<Vec3> at_rest;   ///< F(s_i), one per point
    double residual = 0;         ///< largest |F(s_i) - t_i|, in the target's unit
};

}  // namespace mien
