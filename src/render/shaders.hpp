// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <string>

namespace mien::shaders {

/// Moves every vertex and its normal; transform feedback keeps `posed_position` and `posed_normal`.
extern const std::string move_vertex, move_fragment;

/// Surfaces with their materials. Before the version line of `surface_fragment` go `#define FULL` for one lamp with its
/// shadow, or nothing for all lamps without.
std::string surface_vertex();
std::string surface_fragment(bool full);
/// Depth alone, as a lamp sees it.
extern const std::string shadow_vertex, shadow_fragment;
/// Plain colour: edges of triangles.
extern const std::string wire_vertex, wire_fragment;
/// Balls that mark places.
extern const std::string mark_vertex, mark_fragment;

/// A triangle that covers the picture; adds one texture to what is there, shows the background, or develops the sum.
extern const std::string cover_vertex, add_fragment, background_fragment, develop_fragment;

/// From scene light to sRGB and back, for several of the above.
extern const std::string film;

}  // namespace mien::shaders
