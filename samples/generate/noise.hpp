// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstdint>

#include "mien/vec.hpp"

namespace mien::samples {

/// A number from 0 to 1 that belongs to `i`; neighbours have nothing to do with each other.
double scatter(std::uint32_t i, std::uint32_t salt = 0);

/// Value noise (a random number per cell corner, smoothly joined): -1 to 1, cells of size 1.
double noise(const Vec3& p);

/// 0 up to `low`, 1 from `high` on, smooth between.
double smooth_step(double low, double high, double x);

}  // namespace mien::samples
