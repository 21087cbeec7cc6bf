// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Lost samples and the neutral of a take. The papers assume clean captures (Kshirsagar et al., section 4.1: "the 3D
// points obtained from the motion capture system are accurate"); nothing of this file is in them.

#include "mien/algorithms/tracks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <set>
#include <utility>

#include "algorithms/cubic.hpp"

#include "mien/error.hpp"

namespace mien {

namespace {

std::vector<std::size_t> seen_rows(const Take& take, std::size_t column) {
    std::vector<std::size_t> rows;
    for (std::size_t r = 0; r < row_count(take); ++r)
        if (is_finite(row(take, r)[column])) rows.push_back(r);
    return rows;
}

std::size_t longest_gap(const std::vector<std::size_t>& seen, std::size_t rows) {
    std::size_t longest = 0;
    std::size_t next = 0;
    for (const std::size_t r : seen) {
        longest = std::max(longest, r - next);
        next = r + 1;
    }
    return std::max(longest, rows - next);
}

// Two labels are swapped when each marker appears nearer than half their distance to where the other one was last seen.
// Markers that move together never do that, however fast they are.
bool swapped(const Vec3& a, const Vec3& b, const Vec3& last_a, const Vec3& last_b) {
    const double half = 0.5 * distance(last_a, last_b);
    return distance(a, last_b) < half && distance(b, last_a) < half;
}

// Where labels change places, and where they do it a second time, which ends the swap.
std::vector<TakeCheck::Swap> find_swaps(const Take& take) {
    std::vector<TakeCheck::Swap> swaps;
    std::set<std::pair<std::size_t, std::size_t>> open;
    std::vector<Vec3> last(take.points.size(), lost_sample);
    for (std::size_t r = 0; r < row_count(take); ++r) {
        const auto now = row(take, r);
        for (std::size_t a = 0; a < now.size(); ++a) {
            if (!(distance(now[a], last[a]) > 0)) continue;  // lost, never seen before, or at rest
            for (std::size_t b = a + 1; b < now.size(); ++b) {
                if (!swapped(now[a], now[b], last[a], last[b])) continue;
                if (open.erase({a, b}) == 1) continue;
                open.insert({a, b});
                swaps.push_back({take.points[a], take.points[b], r});
            }
        }
        for (std::size_t c = 0; c < now.size(); ++c)
            if (is_finite(now[c])) last[c] = now[c];
    }
    return swaps;
}

}  // namespace

TakeCheck check_take(const Take& take) {
    TakeCheck check;
    for (std::size_t c = 0; c < take.points.size(); ++c) {
        const std::vector<std::size_t> seen = seen_rows(take, c);
        const std::size_t lost = row_count(take) - seen.size();
        if (lost > 0) check.lost.push_back({take.points[c], lost, longest_gap(seen, row_count(take))});
        if (seen.empty()) check.never_seen.push_back(take.points[c]);
    }
    check.swaps = find_swaps(take);
    return check;
}

namespace {

// Writers of ours put a seen origin down as -0, so that it is not taken for a lost sample.
bool is_zero_cell(const Vec3& p) {
    return p == Vec3{} && !std::signbit(p.x);
}

}  // namespace

Take mark_zeros_lost(const Take& take) {
    Take result = take;
    for (std::size_t c = 0; c < take.points.size(); ++c) {
        const auto is_elsewhere = [&](std::size_t r) { return !is_zero_cell(row(take, r)[c]); };
        const std::vector<std::size_t> seen = seen_rows(take, c);
        if (std::none_of(seen.begin(), seen.end(), is_elsewhere)) continue;
        for (const std::size_t r : seen)
            if (!is_elsewhere(r)) row(result, r)[c] = lost_sample;
    }
    return result;
}

Take drop_never_seen(const Take& take) {
    std::vector<Rename> kept;
    for (std::size_t c = 0; c < take.points.size(); ++c)
        if (!seen_rows(take, c).empty()) kept.push_back({take.points[c], take.points[c]});
    return rename_points(take, kept);
}

namespace {

// The curve over the gap between two seen rows: the cubic Hermite curve with the tangents of the cubic through four
// samples, the gap's two ends and one more on each side. Those are taken a quarter of the gap away or more, so that a
// little noise of neighbouring samples is not thrown across a long gap as speed. Without samples on a side the curve
// has one degree less.
class GapCurve {
public:
    GapCurve(const Take& take, std::size_t column, const std::vector<std::size_t>& seen, std::size_t before) {
        const auto time = [&](std::size_t i) { return take.times[seen[i]]; };
        const double reach = 0.25 * (time(before + 1) - time(before));
        const auto add = [&](std::size_t r) {
            times_[size_] = take.times[r];
            values_[size_++] = row(take, r)[column];
        };
        const auto is_earlier = [&](std::size_t r, double t) { return take.times[r] < t; };
        const auto is_later = [&](double t, std::size_t r) { return t < take.times[r]; };
        const auto left = std::upper_bound(seen.begin(), seen.end(), time(before) - reach, is_later);
        const auto right = std::lower_bound(seen.begin(), seen.end(), time(before + 1) + reach, is_earlier);
        if (left != seen.begin()) add(*(left - 1));
        add(seen[before]);
        add(seen[before + 1]);
        if (right != seen.end()) add(*right);
    }

    [[nodiscard]] Vec3 at(double t) const {
        return interpolate(std::span(times_).first(size_), std::span(values_).first(size_), t);
    }

private:
    std::array<double, 4> times_{};
    std::array<Vec3, 4> values_{};
    std::size_t size_ = 0;
};

std::size_t fill_column(Take& result, const Take& take, std::size_t column, double longest) {
    std::size_t filled = 0;
    const std::vector<std::size_t> seen = seen_rows(take, column);
    for (std::size_t i = 0; i + 1 < seen.size(); ++i) {
        const std::size_t first = seen[i] + 1;
        const std::size_t end = seen[i + 1];
        const double lost_for = take.times[end] - take.times[first];
        if (first == end || !(lost_for <= longest * (1 + 1e-9))) continue;
        const GapCurve curve(take, column, seen, i);
        for (std::size_t r = first; r < end; ++r) row(result, r)[column] = curve.at(take.times[r]);
        filled += end - first;
    }
    return filled;
}

}  // namespace

Take fill_gaps(const Take& take, const GapOptions& options, GapReport* report) {
    Take result = take;
    GapReport counts;
    for (std::size_t c = 0; c < take.points.size(); ++c) {
        const std::size_t filled = fill_column(result, take, c, options.longest);
        counts.filled += filled;
        counts.left += row_count(take) - seen_rows(take, c).size() - filled;
    }
    if (report != nullptr) *report = counts;
    return result;
}

namespace {

std::optional<Vec3> mean_of_rows(const Take& take, std::size_t column, const NeutralOptions& options) {
    Vec3 sum;
    std::size_t seen = 0;
    for (std::size_t r = options.row; r < options.row + options.rows; ++r) {
        const Vec3& p = row(take, r)[column];
        if (!is_finite(p)) continue;
        sum += p;
        ++seen;
    }
    if (seen == 0) return std::nullopt;
    return sum / static_cast<double>(seen);
}

// The earlier one of two samples that are equally near.
Vec3 nearest_in_time(const Take& take, std::size_t column, const NeutralOptions& options) {
    const std::vector<std::size_t> seen = seen_rows(take, column);
    if (seen.empty()) return lost_sample;
    const auto away = [&](std::size_t r) {
        return r < options.row ? take.times[options.row] - take.times[r]
                               : take.times[r] - take.times[options.row + options.rows - 1];
    };
    const auto nearest =
        std::min_element(seen.begin(), seen.end(), [&](std::size_t a, std::size_t b) { return away(a) < away(b); });
    return row(take, *nearest)[column];
}

}  // namespace

std::vector<Vec3> neutral(const Take& take, const NeutralOptions& options) {
    const std::size_t rows = row_count(take);
    if (options.rows == 0 || options.row >= rows || options.rows > rows - options.row)
        throw Error(
            fmt::format("neutral: expected one or more of the take's {} rows (0 is the first), found {} from row {}",
                        rows, options.rows, options.row));
    std::vector<Vec3> result;
    result.reserve(take.points.size());
    for (std::size_t c = 0; c < take.points.size(); ++c) {
        const std::optional<Vec3> mean = mean_of_rows(take, c, options);
        result.push_back(mean ? *mean : nearest_in_time(take, c, options));
    }
    return result;
}

}  // namespace mien
