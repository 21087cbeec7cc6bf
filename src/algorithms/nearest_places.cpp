// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// A k-d tree (Bentley 1975) that lies in the order of its points: the middle of each range splits it along its longest
// side.

#include "algorithms/nearest_places.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "mien/mesh.hpp"

namespace mien {

namespace {

double along(const Vec3& p, std::uint8_t axis) {
    return std::array{p.x, p.y, p.z}[axis];
}

std::uint8_t longest_axis(const Vec3& extent) {
    if (extent.x >= extent.y && extent.x >= extent.z) return 0;
    return extent.y >= extent.z ? 1 : 2;
}

using Found = std::pair<double, std::uint32_t>;

// Keeps the `count` smallest in a heap, the largest on top.
void keep(std::vector<Found>& heap, const Found& found, std::size_t count) {
    if (heap.size() == count && !(found < heap.front())) return;
    if (heap.size() == count) {
        std::pop_heap(heap.begin(), heap.end());
        heap.pop_back();
    }
    heap.push_back(found);
    std::push_heap(heap.begin(), heap.end());
}

struct Range {
    std::size_t first, last;
    double distance;  // at least that far from where it was asked for
};

}  // namespace

NearestPlaces::NearestPlaces(std::vector<Vec3> points)
    : points_(std::move(points)), order_(points_.size()), axes_(points_.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    sort(0, order_.size());
}

void NearestPlaces::sort(std::size_t first, std::size_t last) {
    if (last - first < 2) return;
    std::vector<Vec3> within;
    for (std::size_t i = first; i < last; ++i) within.push_back(points_[order_[i]]);
    const Box box = bounding_box(within);
    const std::size_t middle = first + (last - first) / 2;
    axes_[middle] = longest_axis(box.high - box.low);
    const auto key = [&](std::uint32_t i) { return std::pair(along(points_[i], axes_[middle]), i); };
    std::nth_element(order_.begin() + static_cast<std::ptrdiff_t>(first),
                     order_.begin() + static_cast<std::ptrdiff_t>(middle),
                     order_.begin() + static_cast<std::ptrdiff_t>(last),
                     [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    sort(first, middle);
    sort(middle + 1, last);
}

std::vector<std::uint32_t> NearestPlaces::nearest(const Vec3& p, std::size_t count) const {
    std::vector<Found> heap;
    std::vector<Range> open;
    if (count > 0) open.push_back({0, order_.size(), 0});
    while (!open.empty()) {
        const Range range = open.back();
        open.pop_back();
        if (range.first == range.last || (heap.size() == count && range.distance > heap.front().first)) continue;
        const std::size_t middle = range.first + (range.last - range.first) / 2;
        const Vec3& at = points_[order_[middle]];
        keep(heap, {distance(p, at), order_[middle]}, count);
        const double off = along(p, axes_[middle]) - along(at, axes_[middle]);
        const Range below{range.first, middle, off < 0 ? 0 : off}, above{middle + 1, range.last, off < 0 ? -off : 0};
        open.push_back(off < 0 ? above : below);
        open.push_back(off < 0 ? below : above);
    }
    std::sort_heap(heap.begin(), heap.end());
    std::vector<std::uint32_t> result;
    result.reserve(heap.size());
    for (const Found& found : heap) result.push_back(found.second);
    return result;
}

}  // namespace mien
