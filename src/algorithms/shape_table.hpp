// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mien/face.hpp"
#include "mien/take.hpp"

namespace mien {

/// Whether the table of motions drives a point: on the skin, and known. Teeth and tongue move with what they are
/// attached to.
bool is_driven(std::string_view id);

/// The table's face at rest, as a performer: those of its points that the face has. Throws Error if they are fewer than
/// three.
Take neutral_take(std::span<const FeaturePoint> points);

/// The motions of the points `ids` in an ARKit shape, at a strength that most sculptors would give it.
std::vector<Vec3> table_motions(std::string_view shape, std::span<const std::string> ids);

/// The same for jawOpen as shapes are made of it: the table's sculptor let upper lip and nose sink by 6 % of what the
/// lower lip does; a jaw does not. They get 0.3 of that.
std::vector<Vec3> jaw_open_motions(std::span<const std::string> ids);

}  // namespace mien
