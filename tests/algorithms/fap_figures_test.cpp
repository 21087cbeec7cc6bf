// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Parameters against displacement fields that were drawn by hand, one per parameter, on a head made for MPEG-4.

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <iostream>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "obadiah_figures.hpp"

#include "mien/algorithms/head.hpp"
#include "mien/algorithms/upright.hpp"

namespace mien {
namespace {

// Two of its fields go against the standard, as its description says: stretched corners of the inner lips go inwards.
bool is_inverted(int fap) {
    return fap == 6 || fap == 7;
}

TEST(FapFigures, EveryParameterMovesAHandMadeHeadAlongTheAxisAndInTheDirectionThatWereDrawn) {
    if (!obadiah::is_there()) GTEST_SKIP() << "the head is not there";
    const obadiah::Subject subject = obadiah::read_subject();
    std::size_t compared = 0;
    for (int fap = 3; fap <= 68; ++fap) {
        const auto agreement = obadiah::compare(subject, fap);
        if (!agreement) continue;
        ++compared;
        EXPECT_TRUE(agreement->same_axis) << fap_info(fap).name;
        EXPECT_EQ(agreement->same_sign, !is_inverted(fap)) << fap_info(fap).name;
        EXPECT_EQ(agreement->cosine > 0, !is_inverted(fap)) << fap_info(fap).name;
    }
    EXPECT_EQ(compared, 50U);
}

// A capture of markers as its performer's parameters see it: their face upright, at rest in the first row.
struct Performance {
    Take face;
    Fapu fapu;
};

Performance performance(const std::string& name) {
    const std::filesystem::path folder = std::filesystem::path(MIEN_SHARED) / "data/markers-41";
    const Take take =
        remove_head_motion(rename_points(read_take(folder / name), read_marker_map(folder / "markers-to-fdp.json")));
    Take face = upright(take, face_turn(take).value());
    Fapu fapu = measure_fapu(points_of_row(face, 0));
    return {std::move(face), std::move(fapu)};
}

// Whether a parameter moves the point along an axis, by x, y, z.
std::array<bool, 3> reach(std::string_view point) {
    std::array<bool, 3> axes{};
    for (const Fap& fap : faps)
        if (fap.point == point && fap.axis >= FapAxis::x && fap.axis <= FapAxis::z)
            axes[static_cast<std::size_t>(fap.axis) - static_cast<std::size_t>(FapAxis::x)] = true;
    return axes;
}

std::array<double, 3> numbers(const Vec3& v) {
    return {v.x, v.y, v.z};
}

// What is lost is the motion along axes for which the standard has no parameter: printed, in percent of each region's.
TEST(FapFigures, ACaptureComesBackAlongEveryAxisThatParametersHave) {
    if (!std::filesystem::exists(std::filesystem::path(MIEN_SHARED) / "data/markers-41"))
        GTEST_SKIP() << "the captures are not there";
    for (const char* name : {"jaw.trc", "eyebrows.trc"}) {
        const auto [face, fapu] = performance(name);
        const Take again = to_take(to_faps(face, fapu), fapu);
        const double half_unit = 0.5 * std::max({fapu.mw, fapu.mns, fapu.ens, fapu.es}) / 1024 + 1e-9;
        std::map<char, std::pair<double, double>> lost;  // by group: squares of what is lost, of all motion
        for (std::size_t r = 0; r < row_count(face); ++r)
            for (const FeaturePoint& point : fapu.points) {
                const auto was = numbers(row(face, r)[*find_column(face, point.id)] - point.position);
                const auto is = numbers(row(again, r)[*find_column(again, point.id)] - point.position);
                const auto reached = reach(point.id);
                for (std::size_t k = 0; k < 3; ++k) {
                    if (reached[k]) {
                        EXPECT_NEAR(is[k], was[k], half_unit) << point.id;
                    }
                    if (reached == std::array<bool, 3>{}) continue;
                    lost[point.id[0]].first += (is[k] - was[k]) * (is[k] - was[k]);
                    lost[point.id[0]].second += was[k] * was[k];
                }
            }
        for (const auto& [group, squares] : lost)
            std::cout << fmt::format("{} group {}: {:.0f} % of the motion is beyond parameters\n", name, group,
                                     100 * std::sqrt(squares.first / squares.second));
    }
}

}  // namespace
}  // namespace mien
