// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/key_rows.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

#include "mien/error.hpp"

namespace mien {

namespace {

using Row = std::span<const Vec3f>;

double squared_distance(Row a, Row b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const Vec3 d = to_double(a[i]) - to_double(b[i]);
        if (is_finite(d)) sum += dot(d, d);
    }
    return sum;
}

}  // namespace

std::vector<std::size_t> key_rows(std::span<const Vec3f> positions, std::size_t points, std::size_t count) {
    if (points == 0 || positions.size() % points != 0)
        throw Error(fmt::format("key rows: expected rows of {} points, found {} points", points, positions.size()));
    const std::size_t rows = positions.size() / points;
    const auto row = [&](std::size_t r) { return positions.subspan(r * points, points); };
    std::vector<std::size_t> chosen;
    std::vector<double> nearest(rows, std::numeric_limits<double>::infinity());
    for (std::size_t next = 0; chosen.size() < std::min(count, rows) && nearest[next] > 0;) {
        chosen.push_back(next);
        for (std::size_t r = 0; r < rows; ++r) nearest[r] = std::min(nearest[r], squared_distance(row(r), row(next)));
        next = static_cast<std::size_t>(std::max_element(nearest.begin(), nearest.end()) - nearest.begin());
    }
    std::sort(chosen.begin(), chosen.end());
    return chosen;
}

}  // namespace mien
