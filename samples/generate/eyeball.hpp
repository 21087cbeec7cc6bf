// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include "character.hpp"
#include "surface.hpp"

namespace mien::samples {

/// Millimetres, in the head's space; the right eye is the mirror image.
inline constexpr Vec3 left_eye_centre{31, 0, 69.8};
inline constexpr double eyeball_radius = 11.8;

/// How far the eye reaches from its centre in a direction that makes `angle` with its optical axis: globe or cornea.
double eye_reach(double angle);

/// The left eyeball: globe with iris and pupil behind the cornea, coloured by the picture "eye", and clear cornea, as
/// rings of vertices. Vertex 0 is the middle of the pupil.
Surface make_left_eye(const EyePlace& place);

}  // namespace mien::samples
