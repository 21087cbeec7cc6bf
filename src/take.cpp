// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/take.hpp"

#include <algorithm>
#include <map>
#include <string>

#include "mien/error.hpp"

namespace mien {

std::optional<std::size_t> find_column(const Take& take, std::string_view id) {
    const auto found = std::find(take.points.begin(), take.points.end(), id);
    if (found == take.points.end()) return std::nullopt;
    return static_cast<std::size_t>(found - take.points.begin());
}

double frame_rate(const Take& take) {
    if (row_count(take) < 2) return 0;
    std::vector<double> steps;
    for (std::size_t r = 1; r < row_count(take); ++r) steps.push_back(take.times[r] - take.times[r - 1]);
    const auto median = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
    std::nth_element(steps.begin(), median, steps.end());
    return *median > 0 ? 1 / *median : 0;
}

Take rename_points(const Take& take, std::span<const Rename> names) {
    std::map<std::string, std::string, std::less<>> to;
    for (const Rename& name : names) to[name.from] = name.to;

    std::vector<std::size_t> kept;
    Take result;
    for (std::size_t c = 0; c < take.points.size(); ++c) {
        const auto name = to.find(take.points[c]);
        if (name == to.end() || name->second.empty()) continue;
        if (find_column(result, name->second))
            throw Error("marker map: two markers of the take map to " + name->second + "; the second is " +
                        take.points[c]);
        kept.push_back(c);
        result.points.push_back(name->second);
    }

    result.times = take.times;
    result.head = take.head;
    result.unit = take.unit;
    result.planar = take.planar;
    result.repeated_rows = take.repeated_rows;
    result.samples.reserve(row_count(take) * kept.size());
    for (std::size_t r = 0; r < row_count(take); ++r)
        for (const std::size_t c : kept) result.samples.push_back(row(take, r)[c]);
    return result;
}

Frame frame_at(const Take& take, double time) {
    if (take.times.empty()) throw Error("take: expected a row, found none");
    const auto after =
        static_cast<std::size_t>(std::upper_bound(take.times.begin(), take.times.end(), time) - take.times.begin());
    const std::size_t b = std::min(after, row_count(take) - 1), a = after == 0 ? 0 : after - 1;
    const double share = a == b ? 0 : (time - take.times[a]) / (take.times[b] - take.times[a]);
    Frame frame{time, {}, {}};
    for (std::size_t i = 0; i < take.points.size(); ++i) {
        const Vec3 &from = row(take, a)[i], &to = row(take, b)[i];
        frame.points.push_back(share == 0 ? from : from + share * (to - from));
    }
    if (!take.head.empty()) frame.head = take.head[share < 0.5 ? a : b];
    return frame;
}

}  // namespace mien
