// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mien/vec.hpp"

namespace mien {

/// Finds the points of a set that are nearest to a place.
class NearestPlaces {
public:
    explicit NearestPlaces(std::vector<Vec3> points);

    /// Indices of the `count` nearest points, nearest first, of equally near ones the lower first; all where there are
    /// fewer.
    [[nodiscard]] std::vector<std::uint32_t> nearest(const Vec3& p, std::size_t count) const;

private:
    void sort(std::size_t first, std::size_t last);

    std::vector<Vec3> points_;
    std::vector<std::uint32_t> order_;  // of a range the middle one splits it along `axes_` there
    std::vector<std::uint8_t> axes_;
};

}  // namespace mien
