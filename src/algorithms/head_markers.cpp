// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Which columns of a take ride rigidly on the skull. Kshirsagar et al. attach three markers to the head for that
// (section 4.1); takes do not say which these are, so they are found by name and confirmed by motion: markers on the
// skull keep their distances, markers on skin do not.

#include <Eigen/Core>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <string_view>

#include "algorithms/head.hpp"

#include "mien/algorithms/head.hpp"

namespace mien {

namespace {

// Head markers are columns whose distances vary, on average, by less than this part of the size of the whole take:
// about a millimetre on a face. Real captures: upper face while only the jaw moves 0.3 %, moving brows 1 to 4 %.
constexpr double rigid = 0.005;

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

struct Spread {
    double mean = 0, deviation = 0;
};

// Of the distance between two columns, over the rows where both are seen; 0 where that never happens.
Spread distance_spread(const Take& take, const std::vector<std::size_t>& rows, std::size_t a, std::size_t b) {
    double sum = 0, squares = 0, count = 0, first = -1;
    for (const std::size_t r : rows) {
        const double d = distance(row(take, r)[a], row(take, r)[b]);
        if (std::isnan(d)) continue;
        if (first < 0) first = d;
        sum += d - first;
        squares += (d - first) * (d - first);
        ++count;
    }
    if (count == 0) return {};
    return {first + sum / count, std::sqrt(std::max(0.0, squares / count - (sum / count) * (sum / count)))};
}

// How much the distances between columns vary, as a part of the size of the set.
Eigen::MatrixXd variations(const Take& take, const std::vector<std::size_t>& rows,
                           const std::vector<std::size_t>& columns) {
    const auto n = static_cast<Eigen::Index>(columns.size());
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(n, n);
    double size = 0;
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < i; ++j) {
            const Spread spread =
                distance_spread(take, rows, columns[static_cast<std::size_t>(i)], columns[static_cast<std::size_t>(j)]);
            result(i, j) = result(j, i) = spread.deviation;
            size = std::max(size, spread.mean);
        }
    return size > 0 ? Eigen::MatrixXd(result / size) : result;
}

// Leaves out the column that varies most against the others until all of them are rigid. Indices into the table.
std::vector<Eigen::Index> rigid_part(const Eigen::MatrixXd& variation, std::vector<Eigen::Index> kept) {
    while (kept.size() > 1) {
        const auto sum = [&](Eigen::Index i) {
            double total = 0;
            for (const Eigen::Index j : kept) total += variation(i, j);
            return total;
        };
        std::vector<double> sums;
        for (const Eigen::Index i : kept) sums.push_back(sum(i));
        const auto worst = std::max_element(sums.begin(), sums.end());
        if (*worst <= rigid * static_cast<double>(kept.size() - 1)) break;
        kept.erase(kept.begin() + (worst - sums.begin()));
    }
    return kept;
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
    const std::vector<std::size_t> columns = well_seen(take, rows);
    const Eigen::MatrixXd variation = variations(take, rows, columns);
    std::vector<Eigen::Index> all, named;
    for (std::size_t i = 0; i < columns.size(); ++i) {
        all.push_back(static_cast<Eigen::Index>(i));
        if (is_on_skull(take.points[columns[i]])) named.push_back(all.back());
    }
    for (const std::vector<Eigen::Index>& candidates : {named, all}) {
        std::vector<std::size_t> kept;
        for (const Eigen::Index i : rigid_part(variation, candidates))
            kept.push_back(columns[static_cast<std::size_t>(i)]);
        if (!ever_tell_a_pose(take, rows, kept)) continue;
        std::vector<std::string> names;
        for (const std::size_t c : kept) names.push_back(take.points[c]);
        return names;
    }
    return {};
}

}  // namespace mien
