// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "mien/algorithms/weld.hpp"
#include "mien/face.hpp"

namespace mien {

/// The places of closed pockets behind lids and lips: eye sockets and mouth bags that are one surface with the face. A
/// sheet that runs through them ties lid to lid from behind and swings freely inside, so a rigger solves without them
/// and lets them follow their rims. One flag per place.
///
/// A pocket is a connected piece of skin that none of 74 directions sees, without an open border (the inside of lips
/// that simply ends is none), that lies behind a lid or lip point and goes deeper than 0.15 eye distances behind its
/// rim. What lies within 0.05 eye distances of a feature point stays skin. Only `solved` places are looked at.
std::vector<bool> closed_pockets(const Face& face, const Weld& weld, const std::vector<bool>& solved);

/// The mesh without the faces that touch a marked place: the same vertices, the same places.
Mesh without_places(const Mesh& mesh, const Weld& weld, const std::vector<bool>& marked);

/// Weights of the marked places from those of all others (places x columns, the marked rows are ignored): harmonic over
/// the mesh, so that no weight leaves the range of those at the rims. One row per entry of `pocket`.
Eigen::MatrixXd fill_pockets(const Mesh& mesh, const Weld& weld, const std::vector<std::uint32_t>& pocket,
                             const Eigen::MatrixXd& weights);

}  // namespace mien
