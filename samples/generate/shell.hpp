// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <functional>
#include <vector>

#include "surface.hpp"

namespace mien::samples {

/// Places and outward directions of a surface, for things that lie on it.
struct Shell {
    std::vector<Vec3> places, normals;
};

/// The vertices of a surface that `wanted` lets through.
Shell shell_of(const Surface& surface, const std::function<bool(std::uint32_t)>& wanted);

std::size_t nearest(const Shell& shell, const Vec3& place);

/// The place moved along the shell's normal until it is `height` above the shell.
Vec3 raised_to(const Shell& shell, const Vec3& place, double height);

/// The place moved out until it is at least `height` above the shell.
Vec3 kept_off(const Shell& shell, const Vec3& place, double height);

/// A place on the smooth curve through points (Catmull and Rom 1974), t from 0 to 1, as long from each point to the
/// next.
Vec3 on_curve(const std::vector<Vec3>& points, double t);

}  // namespace mien::samples
