// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/algorithms/expressions.hpp"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <set>
#include <sstream>
#include <vector>

namespace mien {
namespace {

std::vector<std::string> names_of(ShapeSet set) {
    std::vector<std::string> names;
    for (const NamedShape& shape : named_shapes())
        if (shape.set == set) names.emplace_back(shape.name);
    return names;
}

// A column of one of the tables beside the project, its empty cells left out.
std::vector<std::string> column(const std::string& file, std::size_t number) {
    std::ifstream in(std::filesystem::path(MIEN_SHARED) / "data" / "names" / file);
    std::vector<std::string> cells;
    std::string line;
    std::getline(in, line);
    while (std::getline(in, line)) {
        std::istringstream row(line);
        std::string cell;
        for (std::size_t c = 0; c <= number; ++c) std::getline(row, cell, ',');
        if (!cell.empty()) cells.push_back(cell);
    }
    return cells;
}

struct Standard {
    ShapeSet set;
    const char* file;
    std::size_t column;
};

TEST(Expressions, names_are_those_of_the_standards_in_their_order) {
    if (!std::filesystem::exists(std::filesystem::path(MIEN_SHARED) / "data" / "names"))
        GTEST_SKIP() << "no tables of names beside the project";
    EXPECT_EQ(names_of(ShapeSet::arkit), column("arkit52.csv", 1));
    EXPECT_EQ(names_of(ShapeSet::visemes), column("oculus_visemes.csv", 2));
    const std::vector<std::string> vrm = names_of(ShapeSet::vrm), wanted = column("vrm_expressions.csv", 2);
    EXPECT_EQ(std::set(vrm.begin(), vrm.end()), std::set(wanted.begin(), wanted.end()));
    EXPECT_EQ(vrm.size(), wanted.size());
}

TEST(Expressions, there_are_52_and_15_and_18_of_them_with_names_of_their_own) {
    EXPECT_EQ(names_of(ShapeSet::arkit).size(), 52U);
    EXPECT_EQ(names_of(ShapeSet::visemes).size(), 15U);
    EXPECT_EQ(names_of(ShapeSet::vrm).size(), 18U);
    std::set<std::string_view> all;
    for (const NamedShape& shape : named_shapes()) EXPECT_TRUE(all.insert(shape.name).second) << shape.name;
}

TEST(Expressions, every_part_is_an_arkit_shape_or_its_two_sides) {
    for (const NamedShape& shape : named_shapes())
        for (const ShapePart& part : shape.parts) {
            const ShapeSides sides = sides_of(part.shape);
            EXPECT_FALSE(sides.first.empty()) << shape.name << ": " << part.shape;
            EXPECT_EQ(mirror_shape(sides.first), sides.second.empty() ? mirror_shape(sides.first) : sides.second);
            EXPECT_GT(part.weight, 0) << shape.name;
            EXPECT_LE(part.weight, 1.5) << shape.name;
        }
}

TEST(Expressions, the_mirror_of_the_mirror_is_the_shape) {
    std::size_t sided = 0;
    for (const NamedShape& shape : named_shapes()) {
        EXPECT_EQ(mirror_shape(mirror_shape(shape.name)), shape.name);
        sided += mirror_shape(shape.name) != shape.name ? 1U : 0U;
    }
    EXPECT_EQ(sided, 2U * (20U + 2U));  // 20 pairs of ARKit, blink and look of VRM
    EXPECT_EQ(mirror_shape("jawLeft"), "jawRight");
    EXPECT_EQ(mirror_shape("mouthClose"), "mouthClose");
}

TEST(Expressions, a_viseme_of_lips_that_seal_leaves_the_jaw_shut) {
    for (const NamedShape& shape : named_shapes()) {
        if (shape.name != "viseme_PP") continue;
        for (const ShapePart& part : shape.parts) EXPECT_NE(part.shape, "jawOpen");
    }
}

TEST(Expressions, names_are_known_in_the_spellings_that_are_about) {
    EXPECT_EQ(standard_shape("eyeBlinkLeft"), "eyeBlinkLeft");
    EXPECT_EQ(standard_shape("eyeBlink_L"), "eyeBlinkLeft");
    EXPECT_EQ(standard_shape("eyeBlink_R"), "eyeBlinkRight");
    EXPECT_EQ(standard_shape("EyeBlinkLeft"), "eyeBlinkLeft");
    EXPECT_EQ(standard_shape("viseme_aa"), "viseme_aa");
    EXPECT_EQ(standard_shape("smirk"), std::nullopt);
    EXPECT_EQ(standard_shape(""), std::nullopt);
}

}  // namespace
}  // namespace mien
