// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "noise.hpp"

#include <algorithm>
#include <cmath>

namespace mien::samples {
namespace {

// The finaliser of MurmurHash3 (A. Appleby, public domain).
std::uint32_t mixed(std::uint32_t h) {
    h ^= h >> 16;
    h *= 0x85ebca6bU;
    h ^= h >> 13;
    h *= 0xc2b2ae35U;
    return h ^ (h >> 16);
}

double corner(int x, int y, int z) {
    const auto u = [](int i) { return static_cast<std::uint32_t>(i); };
    return 2 * scatter(u(x) * 73856093U ^ u(y) * 19349663U ^ u(z) * 83492791U) - 1;
}

double fade(double t) {
    return t * t * (3 - 2 * t);
}

double mix(double a, double b, double t) {
    return a + t * (b - a);
}

}  // namespace

double scatter(std::uint32_t i, std::uint32_t salt) {
    return mixed(i + 0x9e3779b9U * (salt + 1)) / 4294967295.0;
}

double noise(const Vec3& p) {
    const int x = static_cast<int>(std::floor(p.x)), y = static_cast<int>(std::floor(p.y)),
              z = static_cast<int>(std::floor(p.z));
    const double s = fade(p.x - x), t = fade(p.y - y), r = fade(p.z - z);
    const auto row = [&](int j, int k) { return mix(corner(x, y + j, z + k), corner(x + 1, y + j, z + k), s); };
    return mix(mix(row(0, 0), row(1, 0), t), mix(row(0, 1), row(1, 1), t), r);
}

double smooth_step(double low, double high, double x) {
    return fade(std::clamp((x - low) / (high - low), 0.0, 1.0));
}

}  // namespace mien::samples
