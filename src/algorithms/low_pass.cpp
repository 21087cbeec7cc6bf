// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The zero-phase low-pass of a take: a digital second-order Butterworth filter (bilinear transform of
// 1 / (s^2 + sqrt(2) s + 1)) run forwards and backwards. In none of the papers; the usual treatment of marker tracks.
//
// Two passes square the gain, so each pass is set wider than the cut-off asked for: with x = tan(pi f / rate) / K one
// pass has the power gain 1 / (1 + x^4) and both have its square, which is one half where x^4 = sqrt(2) - 1.

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <span>
#include <vector>

#include "algorithms/cubic.hpp"

#include "mien/algorithms/tracks.hpp"
#include "mien/error.hpp"

namespace mien {

namespace {

struct Butterworth {
    double b0, b1, b2;  // of the input now, one and two samples ago
    double a1, a2;      // of the output one and two samples ago
};

Butterworth butterworth(double cutoff, double rate) {
    const double k = std::tan(std::numbers::pi * cutoff / rate) / std::pow(std::numbers::sqrt2 - 1, 0.25);
    const double norm = 1 + std::numbers::sqrt2 * k + k * k;
    return {k * k / norm, 2 * k * k / norm, k * k / norm, 2 * (k * k - 1) / norm,
            (1 - std::numbers::sqrt2 * k + k * k) / norm};
}

// One pass over the values in the order of the iterators, from rest at the first of them.
template <class Iterator>
void run(const Butterworth& f, Iterator first, Iterator last) {
    Vec3 x1 = *first, x2 = *first, y1 = *first, y2 = *first;
    for (; first != last; ++first) {
        const Vec3 x = *first;
        const Vec3 y = f.b0 * x + f.b1 * x1 + f.b2 * x2 - f.a1 * y1 - f.a2 * y2;
        x2 = x1, x1 = x;
        y2 = y1, y1 = y;
        *first = y;
    }
}

// Evenly spaced values, filtered. Both ends are continued as their mirror image through the end point, which keeps
// value and slope there, for as long as the filter remembers or there are values to mirror.
std::vector<Vec3> zero_phase(const std::vector<Vec3>& values, double cutoff, double rate) {
    const double memory = std::ceil(4 * rate / cutoff);
    const std::size_t last = values.size() - 1;
    const std::size_t pad = memory < static_cast<double>(last) ? static_cast<std::size_t>(memory) : last;
    std::vector<Vec3> padded;
    padded.reserve(values.size() + 2 * pad);
    for (std::size_t i = pad; i > 0; --i) padded.push_back(2.0 * values[0] - values[i]);
    padded.insert(padded.end(), values.begin(), values.end());
    for (std::size_t i = 1; i <= pad; ++i) padded.push_back(2.0 * values[last] - values[last - i]);

    const Butterworth filter = butterworth(cutoff, rate);
    run(filter, padded.begin(), padded.end());
    run(filter, padded.rbegin(), padded.rend());
    const auto begin = padded.begin() + static_cast<std::ptrdiff_t>(pad);
    return {begin, begin + static_cast<std::ptrdiff_t>(values.size())};
}

// The value at time t of a track given at increasing times: the cubic through the two samples on each side.
Vec3 track_at(std::span<const double> times, std::span<const Vec3> values, double t) {
    const auto next = std::lower_bound(times.begin(), times.end(), t) - times.begin();
    const std::size_t most = times.size() - std::min<std::size_t>(4, times.size());
    const std::size_t first = std::min(next < 2 ? 0 : static_cast<std::size_t>(next - 2), most);
    const std::size_t count = times.size() - most;
    return interpolate(times.subspan(first, count), values.subspan(first, count), t);
}

// One column's samples over an unbroken run of rows, filtered on an even grid as fine as the take's own rate.
void filter_stretch(std::span<const double> times, std::vector<Vec3>& values, double cutoff, double median_rate) {
    if (times.size() < 2) return;
    const double duration = times.back() - times.front();
    const double steps = std::max(1.0, std::ceil(duration * median_rate * (1 - 1e-9)));
    std::vector<double> grid;
    std::vector<Vec3> even;
    for (std::size_t i = 0; i <= static_cast<std::size_t>(steps); ++i) {
        grid.push_back(times.front() + duration * (static_cast<double>(i) / steps));
        even.push_back(track_at(times, values, grid.back()));
    }
    even = zero_phase(even, cutoff, steps / duration);
    for (std::size_t i = 0; i < times.size(); ++i) values[i] = track_at(grid, even, times[i]);
}

// Ends of the unbroken runs of rows: rows that the file left out break a run as lost samples do, and keep the even grid
// from growing beyond a few times the rows.
std::size_t end_of_stretch(const Take& take, std::size_t column, std::size_t first, double median_rate) {
    std::size_t end = first + 1;
    while (end < row_count(take) && is_finite(row(take, end)[column]) &&
           (take.times[end] - take.times[end - 1]) * median_rate <= 4)
        ++end;
    return end;
}

}  // namespace

Take low_pass(const Take& take, const LowPassOptions& options) {
    const double rate = frame_rate(take);
    const bool has_rate = row_count(take) > 1;
    if (!(options.cutoff > 0) || (has_rate && !(options.cutoff < 0.5 * rate * (1 - 1e-9))))
        throw Error(
            fmt::format("low-pass: expected a cut-off above 0 and below half the frame rate of {:.6g} Hz, found {} Hz",
                        rate, options.cutoff));
    Take result = take;
    for (std::size_t c = 0; c < take.points.size(); ++c)
        for (std::size_t first = 0, end = 0; first < row_count(take); first = end) {
            end = first + 1;
            if (!is_finite(row(take, first)[c])) continue;
            end = end_of_stretch(take, c, first, rate);
            std::vector<Vec3> values;
            for (std::size_t r = first; r < end; ++r) values.push_back(row(take, r)[c]);
            filter_stretch(std::span(take.times).subspan(first, end - first), values, options.cutoff, rate);
            for (std::size_t r = first; r < end; ++r) row(result, r)[c] = values[r - first];
        }
    return result;
}

}  // namespace mien
