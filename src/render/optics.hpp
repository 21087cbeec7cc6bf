// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <array>
#include <span>
#include <vector>

#include "render/gl_objects.hpp"

#include "mien/affine.hpp"
#include "mien/render/camera.hpp"
#include "mien/render/look.hpp"

namespace mien {

/// Which way a camera looks; slopes are those of the picture's edges.
struct CameraAxes {
    Vec3 right, up, back;
    double slope_x = 0, slope_y = 0;
};
CameraAxes axes_of(const Camera& camera);

struct Ball {
    Vec3 centre;
    double radius = 0;
};

/// The map to clip space from places relative to `camera.target`, upside down so that the first row that is read back
/// is the upper one. `shift`: of the picture, in pixels. Near and far planes enclose `all` (relative to the target
/// too).
Matrix view_matrix(const Camera& camera, const Ball& all, const std::array<double, 2>& shift);

/// An affine map as a matrix, for places relative to `origin`; and its inverse transpose for normals.
Matrix place_matrix(const Affine& map, const Vec3& origin);
Matrix turn_matrix(const Affine& map);

/// A lamp in the scene: direction towards it, and from its middle to its edges, at distance 1.
struct Lamp {
    Vec3 direction, across, upward;
    Vec3 light;  ///< linear, with exposure
};
std::vector<Lamp> lamps_of(const Look& look, const Camera& camera);

/// One of the passes of a full picture: one place that light comes from.
struct Pass {
    int lamp = -1;  ///< which, or -1: the dome
    Vec3 direction;
    Vec3 light;                     ///< of this pass; the picture is the mean over all passes
    std::array<double, 2> shift{};  ///< of the picture, in pixels, -0.5 to 0.5
};
std::vector<Pass> passes_of(const Look& look, const Camera& camera, std::span<const Lamp> lamps);

/// What a lamp sees: a window of the scene, with the whole scene between its near and far ends.
struct ShadowView {
    Matrix view, lookup;          ///< to clip space, and to 0..1
    double texel = 0, depth = 0;  ///< size of a texel and of the whole depth, in the scene's unit
};
ShadowView shadow_view(const Vec3& direction, const Ball& window, const Ball& all, int size,
                       const std::array<double, 2>& shift);
/// The part of the scene whose shadows matter in the picture.
Ball shadow_window(const Camera& camera, const Ball& all);

}  // namespace mien
