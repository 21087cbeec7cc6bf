// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstdint>
#include <vector>

#include "mien/algorithms/weld.hpp"
#include "mien/face.hpp"

namespace mien {

/// The places of closed pockets behind lids and lips: eye sockets and mouth bags that are one surface with the face. A
/// sheet that runs through them ties lid to lid from behind and swings freely inside, so a rigger solves without them
/// and lets them follow the skin round them. One flag per place.
///
/// A pocket is a connected piece of skin that none of 74 directions sees, without an open border (the inside of lips
/// that simply ends is none), that lies behind a lid or lip point and goes deeper than 0.15 eye distances behind its
/// rim, with what is seen in its middle. What lies within 0.05 eye distances of a feature point stays skin. Only
/// `solved` places are looked at.
std::vector<bool> closed_pockets(const Face& face, const Weld& weld, const std::vector<bool>& solved);

/// The mesh without the faces that touch a marked place: the same vertices, the same places.
Mesh without_places(const Mesh& mesh, const Weld& weld, const std::vector<bool>& marked);

/// Normals of the solved places, of any length, away from the inside of the head however its faces are wound.
std::vector<Vec3> outward_normals(const Mesh& mesh, const Weld& weld, const std::vector<bool>& solved);

}  // namespace mien
