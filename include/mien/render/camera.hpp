// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstdint>
#include <optional>

#include "mien/mesh.hpp"
#include "mien/vec.hpp"

namespace mien {

/// Where a picture is taken from, and its size in pixels. A plain perspective view.
struct Camera {
    Vec3 eye{0, 0, 1};          ///< in the unit of what is drawn; not at `target`
    Vec3 target;                ///< what is in the middle of the picture
    Vec3 up{0, 1, 0};           ///< not along the line from eye to target
    double field_of_view = 20;  ///< degrees from the lower to the upper edge, above 0 and below 180
    std::uint32_t width = 640, height = 480;
};

/// From where a head is looked at: front from +z, side from +x (the subject's left), three-quarter between the two and
/// a little from above.
enum class View { front, side, three_quarter };

/// The camera from which a box just fills the picture, with `margin` (a share of the picture) left free on every side.
/// A box without extent is framed from a distance of 1. Throws Error if the box is not finite or the picture is empty.
Camera frame(const Box& box, View view, std::uint32_t width, std::uint32_t height, double margin = 0.04);

/// Where a point appears: pixels from the left and the upper edge, and its distance from the camera along the line of
/// sight. Nothing when it lies behind the camera.
struct Seen {
    double x = 0, y = 0, depth = 0;
};
std::optional<Seen> project(const Camera& camera, const Vec3& point);

}  // namespace mien
