// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/io/measured_points.hpp"

#include <cmath>

#include "fuzz.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace mien;
    return fuzz::run(data, size, parse_measured_points, [](const std::vector<MeasuredPoint>& points) {
        fuzz::expect(!points.empty(), "points");
        for (const MeasuredPoint& point : points) {
            const Vec3& p = point.place;
            const bool infinite = std::isinf(p.x) || std::isinf(p.y) || std::isinf(p.z);
            fuzz::expect(!infinite, "coordinates that are finite or were not measured");
        }
    });
}
