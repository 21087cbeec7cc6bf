// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The coefficients of PRIOR's one-sided solve: min c'Hc/2 - y'c over c >= 0 with y = K d. With c0 = H^-1 y, which is
// kept as one matrix, that is the point of the orthant nearest to c0 in the norm of H, so neither K nor a
// factorisation of H is needed. Each sweep goes up and down the list, so that no end of it is preferred.

#include "mien/prior.hpp"

#include <algorithm>
#include <array>
#include <cassert>

namespace mien {

namespace {

constexpr int sweeps = 12;  // each both ways; H has a condition of 10 to 15, which leaves some 1e-6

using Coefficients = std::array<double, Prior::most_shapes>;

void relax(const Prior& prior, const Coefficients& free, Coefficients& c, std::size_t k) noexcept {
    const std::size_t m = prior.shapes.size();
    const double* row = prior.stiffness.data() + k * m;
    double slope = 0;
    for (std::size_t j = 0; j < m; ++j) slope += row[j] * (c[j] - free[j]);
    c[k] = std::max(0.0, c[k] - slope / row[k]);
}

void project(const Prior& prior, Coefficients& c) noexcept {
    const std::size_t m = prior.shapes.size();
    const Coefficients free = c;
    for (std::size_t k = 0; k < m; ++k) c[k] = std::max(0.0, c[k]);
    for (int sweep = 0; sweep < sweeps; ++sweep) {
        for (std::size_t k = 0; k < m; ++k) relax(prior, free, c, k);
        for (std::size_t k = m; k-- > 0;) relax(prior, free, c, k);
    }
}

}  // namespace

void shape_weights(const Prior& prior, std::span<const Vec3f> displacements, std::span<float> weights) noexcept {
    const std::size_t m = prior.shapes.size(), n = displacements.size();
    assert(m <= Prior::most_shapes && weights.size() == m && prior.response.size() == m * n);
    Coefficients c{};
    for (std::size_t k = 0; k < m; ++k)
        for (std::size_t i = 0; i < n; ++i) c[k] += dot(prior.response[k * n + i], to_double(displacements[i]));
    if (is_one_sided(prior)) project(prior, c);
    for (std::size_t k = 0; k < m; ++k) weights[k] = static_cast<float>(c[k]);
}

}  // namespace mien
