// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <string>

namespace mien::shaders {

/// Moves every vertex and its normal; transform feedback keeps `posed_position` and `posed_normal`.
extern const std::string move_vertex, move_fragment;

/// Surfaces with their materials: all lamps without shadows, developed; or, `full`, one lamp with its shadow.
std::string surface_vertex();
std::string surface_fragment(bool full);
/// The same as `full` in two steps, so that the light is worked out once a pixel however small the triangles are: what
/// the surface is like, then one lamp with its shadow.
std::string facts_fragment();
std::string deferred_fragment();
/// All lamps without shadows, at the vertices. `one_colour`: neither a picture nor paint.
std::string quick_vertex(bool one_colour);
std::string quick_fragment(bool one_colour);
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
