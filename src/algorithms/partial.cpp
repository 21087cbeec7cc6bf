// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/partial.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <optional>

#include "mien/error.hpp"

namespace mien {

namespace {

// A region is the points of whole groups, less some of them, and some points of other groups.
struct Region {
    std::string_view name;
    std::string_view groups, less, more;  // ids and groups by spaces
};
constexpr std::array<Region, 7> regions{{
    {"mouth", "8 6", "", "2.2 2.3 2.4 2.5 2.6 2.7 2.8 2.9"},
    {"jaw", "", "", "2.1 2.10 2.11 2.12 2.13 2.14 9.9 9.11"},
    {"brows", "4", "", ""},
    {"lids", "3", "3.5 3.6", ""},
    {"eyes", "", "", "3.5 3.6"},
    {"nose", "9", "9.8 9.9 9.10 9.11", ""},
    {"cheeks", "5", "", ""},
}};

bool lists(std::string_view words, std::string_view word) {
    while (!words.empty()) {
        const std::size_t end = std::min(words.find(' '), words.size());
        if (words.substr(0, end) == word) return true;
        words.remove_prefix(std::min(end + 1, words.size()));
    }
    return false;
}

bool holds(const Region& region, std::string_view id) {
    const std::string_view group = id.substr(0, std::min(id.find('.'), id.size()));
    return lists(region.more, id) || (lists(region.groups, group) && !lists(region.less, id));
}

std::string region_names() {
    std::string names;
    for (const Region& region : regions) names += fmt::format("{}{}", names.empty() ? "" : ", ", region.name);
    return names;
}

}  // namespace

std::vector<std::size_t> part_columns(const Take& take, std::string_view part) {
    const auto region = std::find_if(regions.begin(), regions.end(), [&](const Region& r) { return r.name == part; });
    std::vector<std::size_t> columns;
    if (region != regions.end()) {
        for (std::size_t c = 0; c < take.points.size(); ++c)
            if (holds(*region, take.points[c])) columns.push_back(c);
        return columns;
    }
    const std::optional<std::size_t> column = find_column(take, part);
    if (!column)
        throw Error(fmt::format("part of a face: expected one of {} or the id of a point of the take, found {:?}",
                                region_names(), part));
    return {*column};
}

namespace {

std::vector<double> strengths(const Take& take, const PartialOptions& options) {
    std::vector<double> result(take.points.size(), options.only.empty() ? 1 : 0);
    const auto set = [&](std::string_view part, double strength) {
        for (const std::size_t c : part_columns(take, part)) result[c] = strength;
    };
    for (const std::string& part : options.only) set(part, 1);
    for (const PartStrength& one : options.strengths) {
        if (!std::isfinite(one.strength))
            throw Error(fmt::format("part of a face: expected a number as the strength of {}", one.part));
        for (const std::size_t c : part_columns(take, one.part))
            if (result[c] != 0) result[c] = one.strength;
    }
    for (const std::string& part : options.without) set(part, 0);
    return result;
}

}  // namespace

Take partial(const Take& take, std::span<const Vec3> rest, const PartialOptions& options) {
    const std::vector<double> strength = strengths(take, options);
    Take result = take;
    for (std::size_t r = 0; r < row_count(take); ++r)
        for (std::size_t c = 0; c < strength.size(); ++c) {
            const Vec3& p = row(take, r)[c];
            if (is_finite(p) && is_finite(rest[c]) && strength[c] != 1)
                row(result, r)[c] = rest[c] + strength[c] * (p - rest[c]);
        }
    return result;
}

namespace {

// A column between the rows, held at the ends; lost between a row where it is lost and any other.
Vec3 sample_at(const Take& take, std::size_t column, double time) {
    const auto after = std::upper_bound(take.times.begin(), take.times.end(), time);
    const auto r = static_cast<std::size_t>(after - take.times.begin());
    if (r == 0) return row(take, 0)[column];
    if (r == row_count(take)) return row(take, r - 1)[column];
    const double share = (time - take.times[r - 1]) / (take.times[r] - take.times[r - 1]);
    if (share == 0) return row(take, r - 1)[column];
    const Vec3 p = (1 - share) * row(take, r - 1)[column] + share * row(take, r)[column];
    return is_finite(p) ? p : lost_sample;
}

// Where each column of the result comes from.
struct Origin {
    bool other = false;
    std::size_t column = 0;
};

}  // namespace

Take merged(const Take& take, const Take& other, std::span<const std::string> parts) {
    if (row_count(other) == 0) throw Error("merged takes: expected rows in the second take, found none");
    Take result{take.points, take.times, {}, take.head, take.unit, take.planar, take.repeated_rows};
    std::vector<Origin> origins;
    for (std::size_t c = 0; c < take.points.size(); ++c) origins.push_back({false, c});
    for (const std::string& part : parts)
        for (const std::size_t c : part_columns(other, part)) {
            const std::optional<std::size_t> here = find_column(result, other.points[c]);
            if (!here) result.points.push_back(other.points[c]);
            if (!here) origins.push_back({});
            origins[here.value_or(origins.size() - 1)] = {true, c};
        }
    result.samples.reserve(row_count(take) * origins.size());
    for (std::size_t r = 0; r < row_count(take); ++r)
        for (const Origin& from : origins)
            result.samples.push_back(from.other ? sample_at(other, from.column, take.times[r])
                                                : row(take, r)[from.column]);
    return result;
}

}  // namespace mien
