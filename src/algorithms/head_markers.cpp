// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Which columns of a take ride rigidly on the skull. Kshirsagar et al. attach three markers to the head for that
// (section 4.1); takes do not say which these are, so they are found by name and confirmed by motion: markers on the
// skull keep their distances, markers on skin do not.

#include <Eigen/Core>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <string_view>

#include "algorithms/head.hpp"

#include "mien/algorithms/head.hpp"

namespace mien {

namespace {

// Head markers are columns whose distances vary, on average, by less than this part of the size of the take: about 0.8
// millimetres on a face. Of two real captures of 41 markers without any on the skull it leaves 23 and 27.
constexpr double rigid = 0.003;

bool is_letter(char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0;
}

// "HeadTop", "subject:head_2", but neither "ForeHead" nor "NoseHead": a word that begins so.
bool says_head(std::string_view name) {
    std::string lower(name);
    for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    for (std::size_t at = lower.find("head"); at != std::string::npos; at = lower.find("head", at + 1))
        if (at == 0 || !is_letter(lower[at - 1])) return true;
    return false;
}

bool is_on_skull(std::string_view name) {
    return name.starts_with("10.") || name.starts_with("11.") || name == "9.12" || name == "9.6" || name == "9.7" ||
           says_head(name);
}

// Rows that are looked at: enough to know the motion, however long the take.
std::vector<std::size_t> some_rows(const Take& take) {
    constexpr std::size_t most = 500;
    const std::size_t step = (row_count(take) + most - 1) / most;
    std::vector<std::size_t> rows;
    for (std::size_t r = 0; r < row_count(take); r += step) rows.push_back(r);
    return rows;
}

// Columns that are seen in at least half of the rows.
std::vector<std::size_t> well_seen(const Take& take, const std::vector<std::size_t>& rows) {
    std::vector<std::size_t> columns;
    for (std::size_t c = 0; c < take.points.size(); ++c) {
        const auto seen =
            std::count_if(rows.begin(), rows.end(), [&](std::size_t r) { return is_finite(row(take, r)[c]); });
        if (2 * static_cast<std::size_t>(seen) >= rows.size()) columns.push_back(c);
    }
    return columns;
}

// Standard deviation of the distance between two columns over the rows where both are seen; 0 where that never happens.
double distance_deviation(const Take& take, const std::vector<std::size_t>& rows, std::size_t a, std::size_t b) {
    double sum = 0, squares = 0, count = 0, first = -1;
    for (const std::size_t r : rows) {
        const double d = distance(row(take, r)[a], row(take, r)[b]);
        if (std::isnan(d)) continue;
        if (first < 0) first = d;
        sum += d - first;
        squares += (d - first) * (d - first);
        ++count;
    }
    return count > 0 ? std::sqrt(std::max(0.0, squares / count - (sum / count) * (sum / count))) : 0;
}

// The widest that the take's points lie apart in a row: the diagonal of their box.
double size_of(const Take& take, const std::vector<std::size_t>& rows) {
    double size = 0;
    for (const std::size_t r : rows) {
        constexpr double far = std::numeric_limits<double>::infinity();
        Vec3 low{far, far, far}, high{-far, -far, -far};
        for (const Vec3& p : row(take, r)) {
            if (!is_finite(p)) continue;
            low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
        }
        if (low.x <= high.x) size = std::max(size, distance(low, high));
    }
    return size;
}

// Not more columns than the table of all pairs can hold at no cost, evenly chosen.
std::vector<std::size_t> at_most(std::size_t most, const std::vector<std::size_t>& columns) {
    const std::size_t step = (columns.size() + most - 1) / most;
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < columns.size(); i += step) chosen.push_back(columns[i]);
    return chosen;
}

// How much the distance between any two of the columns varies.
Eigen::MatrixXd variations(const Take& take, const std::vector<std::size_t>& rows,
                           const std::vector<std::size_t>& columns) {
    const auto n = static_cast<Eigen::Index>(columns.size());
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < i; ++j)
            result(i, j) = result(j, i) = distance_deviation(take, rows, columns[static_cast<std::size_t>(i)],
                                                             columns[static_cast<std::size_t>(j)]);
    return result;
}

// Leaves out the column that varies most against the others until none varies by more than `most` on average.
std::vector<std::size_t> rigid_part(const Eigen::MatrixXd& variation, std::vector<std::size_t> columns, double most) {
    std::vector<Eigen::Index> kept(columns.size());
    std::iota(kept.begin(), kept.end(), Eigen::Index{0});
    while (kept.size() > 1) {
        std::vector<double> sums(kept.size(), 0);
        for (std::size_t i = 0; i < kept.size(); ++i)
            for (const Eigen::Index j : kept) sums[i] += variation(kept[i], j);
        const auto worst = std::max_element(sums.begin(), sums.end());
        if (*worst <= most * static_cast<double>(kept.size() - 1)) break;
        columns.erase(columns.begin() + (worst - sums.begin()));
        kept.erase(kept.begin() + (worst - sums.begin()));
    }
    return columns;
}

// Whether there is a row in which these columns tell where the head is.
bool ever_tell_a_pose(const Take& take, const std::vector<std::size_t>& rows, const std::vector<std::size_t>& columns) {
    return std::any_of(rows.begin(), rows.end(), [&](std::size_t r) {
        std::vector<Vec3> seen;
        for (const std::size_t c : columns)
            if (is_finite(row(take, r)[c])) seen.push_back(row(take, r)[c]);
        return tell_a_pose(seen, take.planar);
    });
}

}  // namespace

std::vector<std::string> head_markers(const Take& take) {
    const std::vector<std::size_t> rows = some_rows(take);
    const std::vector<std::size_t> all = well_seen(take, rows);
    std::vector<std::size_t> named;
    std::copy_if(all.begin(), all.end(), std::back_inserter(named),
                 [&](std::size_t c) { return is_on_skull(take.points[c]); });
    const double most = rigid * size_of(take, rows);
    for (const std::vector<std::size_t>& candidates : {at_most(400, named), at_most(400, all)}) {
        const std::vector<std::size_t> kept = rigid_part(variations(take, rows, candidates), candidates, most);
        if (!ever_tell_a_pose(take, rows, kept)) continue;
        std::vector<std::string> names(kept.size());
        std::transform(kept.begin(), kept.end(), names.begin(), [&](std::size_t c) { return take.points[c]; });
        return names;
    }
    return {};
}

}  // namespace mien
