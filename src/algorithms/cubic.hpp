// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "mien/vec.hpp"

namespace mien {

/// The polynomial through up to four values at different times (degree one less than their number), at time t, by
/// Neville's scheme. Exactly the value where t is one of the times.
inline Vec3 interpolate(std::span<const double> times, std::span<const Vec3> values, double t) {
    std::array<Vec3, 4> p{};
    for (std::size_t i = 0; i < times.size(); ++i) {
        if (times[i] == t) return values[i];
        p[i] = values[i];
    }
    for (std::size_t degree = 1; degree < times.size(); ++degree)
        for (std::size_t i = 0; i + degree < times.size(); ++i) {
            const double part = (t - times[i]) / (times[i + degree] - times[i]);
            p[i] = (1 - part) * p[i] + part * p[i + 1];
        }
    return p[0];
}

}  // namespace mien
