// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/fap.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <string>
#include <vector>

#include "io/text.hpp"

namespace mien {
namespace {

using Row = std::map<std::string, std::string>;

// The rows of a table beside the project by their headings; empty when it is not there.
std::vector<Row> table(const char* name) {
    std::ifstream file(std::filesystem::path(MIEN_SHARED) / "mpeg4" / name);
    std::vector<Row> rows;
    std::vector<std::string> headings;
    for (std::string line; std::getline(file, line);) {
        const auto cells = comma_cells(line);
        if (!cells) ADD_FAILURE() << line;
        if (headings.empty()) {
            headings = *cells;
            continue;
        }
        EXPECT_EQ(cells->size(), headings.size()) << line;
        Row& row = rows.emplace_back();
        for (std::size_t c = 0; c < std::min(cells->size(), headings.size()); ++c) row[headings[c]] = (*cells)[c];
    }
    return rows;
}

std::string name_of(FapUnit unit) {
    constexpr std::array names{"na", "IRISD", "ES", "ENS", "MNS", "MW", "AU"};
    return names[static_cast<std::size_t>(unit)];
}

std::string axis_of(const Fap& fap) {
    constexpr std::array names{"", "X", "Y", "Z", "rotX", "rotY", "rotZ", "scale", "roll"};
    std::string name = names[static_cast<std::size_t>(fap.axis)];
    if (fap.axis == FapAxis::none || fap.axis == FapAxis::scale || fap.axis == FapAxis::roll) return name;
    return (fap.sign > 0 ? "+" : "-") + name;
}

std::string shown_or(const std::string& cell, int number, int blank) {
    return cell.empty() && number == blank ? "" : std::to_string(number);
}

TEST(Fap, TheTableIsThatOfTheStandard) {
    const auto rows = table("faps.csv");
    if (rows.empty()) GTEST_SKIP() << "the table of the standard is not there";
    ASSERT_EQ(rows.size(), fap_count);
    for (int n = 1; n <= 68; ++n) {
        Row row = rows[fap_index(n)];
        const Fap& fap = fap_info(n);
        SCOPED_TRACE(row["name"]);
        EXPECT_EQ(row["fap"], std::to_string(n));
        EXPECT_EQ(row["name"], fap.name);
        EXPECT_EQ(row["unit"], name_of(fap.unit));
        EXPECT_EQ(row["positive_axis"], axis_of(fap));
        EXPECT_EQ(row["direction_type"] == "U", fap.unidirectional);
        EXPECT_EQ(row["group"], std::to_string(fap.group));
        EXPECT_EQ(row["feature_point"] == "na" ? "" : row["feature_point"].substr(0, row["feature_point"].find(';')),
                  fap.point);
        EXPECT_EQ(row["quant_step"], std::to_string(fap.quant_step));
        EXPECT_EQ(row["mirror_fap"], shown_or(row["mirror_fap"], fap.mirror, n));
        EXPECT_EQ(row["mirror_sign"], shown_or(row["mirror_sign"], fap.mirror_sign, 1));
        EXPECT_EQ(row["inner_outer_partner"], shown_or(row["inner_outer_partner"], fap.partner, 0));
    }
}

TEST(Fap, TheLimitsAreThoseOfTheStandardWhereTheyAreSettled) {
    const auto rows = table("faps.csv");
    if (rows.empty()) GTEST_SKIP() << "the table of the standard is not there";
    std::size_t settled = 0;
    for (Row row : rows) {
        if (row["i_max_q"].empty()) continue;
        const Fap& fap = fap_info(std::stoi(row["fap"]));
        SCOPED_TRACE(row["name"]);
        EXPECT_EQ(row["i_min_q"], std::to_string(fap.intra.low));
        EXPECT_EQ(row["i_max_q"], std::to_string(fap.intra.high));
        EXPECT_EQ(row["p_min_q"], std::to_string(fap.inter.low));
        EXPECT_EQ(row["p_max_q"], std::to_string(fap.inter.high));
        ++settled;
    }
    EXPECT_EQ(settled, 65U);
}

TEST(Fap, VisemesAndExpressionsAreThoseOfTheStandard) {
    const auto viseme_rows = table("visemes.csv");
    const auto expression_rows = table("expressions.csv");
    if (viseme_rows.empty() || expression_rows.empty()) GTEST_SKIP() << "the tables of the standard are not there";
    ASSERT_EQ(viseme_rows.size(), viseme_names.size());
    ASSERT_EQ(expression_rows.size(), expression_names.size());
    for (std::size_t i = 1; i < viseme_names.size(); ++i) {
        EXPECT_EQ(viseme_rows[i].at("common_short_name"), viseme_names[i].name);
        EXPECT_EQ(viseme_rows[i].at("phonemes_sampa"), viseme_names[i].phonemes);
    }
    for (std::size_t i = 0; i < expression_names.size(); ++i)
        EXPECT_EQ(expression_rows[i].at("name"), expression_names[i]);
}

TEST(Fap, TheFeaturePointsThatMoveAreThoseOfTheStandard) {
    const auto rows = table("fdps.csv");
    if (rows.empty()) GTEST_SKIP() << "the table of the standard is not there";
    std::size_t moved = 0;
    for (const Row& row : rows) {
        std::string list;
        for (int n = 1; n <= 68; ++n)
            if (fap_info(n).point == row.at("id")) list += fmt::format("{}{}", list.empty() ? "" : " ", n);
        if (row.at("id") == "6.4") list = "47";  // the other end of what 47 rolls
        EXPECT_EQ(row.at("faps"), list) << row.at("id");
        moved += list.empty() ? 0U : 1U;
    }
    EXPECT_EQ(moved, 46U);
}

TEST(Fap, MirroringTwiceChangesNothing) {
    for (int n = 1; n <= 68; ++n) {
        const Fap& fap = fap_info(n);
        EXPECT_EQ(fap_info(fap.mirror).mirror, n);
        EXPECT_EQ(fap_info(fap.mirror).mirror_sign, fap.mirror_sign);
        if (fap.axis != FapAxis::roll && !fap.point.empty()) {
            EXPECT_EQ(mirror_point(fap.point), fap_info(fap.mirror).point);
        }
    }
}

// In the mirror x changes its sign, and so do turns about y and z.
TEST(Fap, AMirroredParameterMovesTheMirroredWay) {
    for (int n = 3; n <= 68; ++n) {
        const Fap &fap = fap_info(n), &other = fap_info(fap.mirror);
        const bool turned_over = fap.axis == FapAxis::x || fap.axis == FapAxis::turn_y || fap.axis == FapAxis::turn_z;
        EXPECT_EQ(fap.axis, other.axis);
        EXPECT_EQ(fap.unit, other.unit);
        EXPECT_EQ((turned_over ? -1 : 1) * fap.sign, fap.mirror_sign * other.sign) << fap.name;
    }
}

TEST(Fap, InnerAndOuterLipsMoveAlike) {
    int pairs = 0;
    for (int n = 1; n <= 68; ++n) {
        const Fap& fap = fap_info(n);
        if (fap.partner == 0) continue;
        const Fap& partner = fap_info(fap.partner);
        EXPECT_EQ(partner.partner, n);
        EXPECT_EQ(partner.axis, fap.axis);
        EXPECT_EQ(partner.sign, fap.sign);
        EXPECT_EQ(partner.unit, fap.unit);
        ++pairs;
    }
    EXPECT_EQ(pairs, 20);
}

TEST(Fap, GroupsAreRunsOfTheTable) {
    for (std::size_t g = 0; g < 10; ++g)
        for (std::size_t i = fap_group_starts[g]; i < fap_group_starts[g + 1]; ++i)
            EXPECT_EQ(faps[i].group, static_cast<int>(g) + 1);
}

TEST(Fap, AUnitIsA1024thOfTheDistanceOnTheFace) {
    Fapu fapu;
    fapu.irisd = 10.24, fapu.es = 1024, fapu.ens = 2048, fapu.mns = 512, fapu.mw = 3072;
    EXPECT_DOUBLE_EQ(unit_length(fapu, FapUnit::irisd), 0.01);
    EXPECT_DOUBLE_EQ(unit_length(fapu, FapUnit::es), 1);
    EXPECT_DOUBLE_EQ(unit_length(fapu, FapUnit::ens), 2);
    EXPECT_DOUBLE_EQ(unit_length(fapu, FapUnit::mns), 0.5);
    EXPECT_DOUBLE_EQ(unit_length(fapu, FapUnit::mw), 3);
    EXPECT_DOUBLE_EQ(unit_length(fapu, FapUnit::angle), 1e-5);
    EXPECT_EQ(unit_length(fapu, FapUnit::none), 0);
}

}  // namespace
}  // namespace mien
