// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/fat.hpp"

#include <functional>
#include <gmock/gmock.h>
#include <limits>

#include "refusal.hpp"

namespace mien {
namespace {

using testing::HasSubstr;

// A table of a head with four vertices.
Fat small_table() {
    FaceDefTables jaw{3, 0, {{{-10, 0, 10}, {1, 3}, {{0, 1, 0}, {0, 1, 0}, {0, 2, 0}, {0, 2, 0}}}}, {}};
    FaceDefTables yaw{23, 0, {}, {{0, TransformField::rotation, {0, 1, 0}, 1e-5, {}, {}}}};
    return {{{"left eye", {0, 2}, {1, 1, 1}}}, {jaw, yaw}};
}

std::string refused(const std::function<void(Fat&)>& change) {
    Fat fat = small_table();
    change(fat);
    return refusal([&] { check_fat(fat, 4); });
}

TEST(Fat, IsAcceptedWhenItIsWhatItsCommentsSay) {
    EXPECT_NO_THROW(check_fat(small_table(), 4));
    EXPECT_NO_THROW(check_fat({}, 0));
    Fat visemes;
    for (int select = 1; select <= 14; ++select) visemes.tables.push_back({1, select, {}, {}});
    EXPECT_NO_THROW(check_fat(visemes, 0));
}

TEST(Fat, IsRefusedWithVerticesThatTheHeadLacks) {
    EXPECT_THAT(refusal([] { check_fat(small_table(), 3); }), HasSubstr("below 3, found 3"));
    EXPECT_THAT(refused([](Fat& fat) { fat.nodes[0].vertices = {0, 4}; }), HasSubstr("left eye"));
    EXPECT_THAT(refused([](Fat& fat) { fat.tables[0].meshes[0].vertices = {3, 1}; }), HasSubstr("ascend"));
    EXPECT_THAT(refused([](Fat& fat) { fat.tables[0].meshes[0].vertices = {1, 1}; }), HasSubstr("ascend"));
}

TEST(Fat, IsRefusedWithBordersThatDoNotAscendThroughZero) {
    EXPECT_THAT(refused([](Fat& fat) { fat.tables[0].meshes[0].borders = {0}; }), HasSubstr("two interval borders"));
    EXPECT_THAT(refused([](Fat& fat) { fat.tables[0].meshes[0].borders = {-10, 5, 10}; }), HasSubstr("-10 5 10"));
    EXPECT_THAT(refused([](Fat& fat) { fat.tables[0].meshes[0].borders = {0, 10, 10}; }), HasSubstr("0 10 10"));
}

TEST(Fat, IsRefusedWithoutAFiniteVectorPerVertexAndInterval) {
    EXPECT_THAT(refused([](Fat& fat) { fat.tables[0].meshes[0].displacements.pop_back(); }),
                HasSubstr("expected 4 displacements, one per vertex and interval, found 3"));
    EXPECT_THAT(refused([](Fat& fat) { fat.tables[0].meshes[0].displacements.resize(2); }),
                HasSubstr("expected 4 displacements, one per vertex and interval, found 2"));
    EXPECT_THAT(
        refused([](Fat& fat) { fat.tables[0].meshes[0].displacements[0].x = std::numeric_limits<float>::infinity(); }),
        HasSubstr("finite"));
}

TEST(Fat, IsRefusedWithTransformsThatMeanNothing) {
    EXPECT_THAT(refused([](Fat& fat) { fat.tables[1].transforms[0].node = 1; }), HasSubstr("node below 1, found 1"));
    EXPECT_THAT(refused([](Fat& fat) { fat.tables[1].transforms[0].axis = {0, 2, 0}; }), HasSubstr("length 1"));
    EXPECT_THAT(refused([](Fat& fat) { fat.tables[1].transforms[0].angle = std::numeric_limits<double>::quiet_NaN(); }),
                HasSubstr("FAP 23"));
}

TEST(Fat, IsRefusedWithTablesOfNoParameterOrOutOfOrder) {
    EXPECT_THAT(refused([](Fat& fat) { fat.tables[0].fap = 69; }), HasSubstr("from 1 to 68, found 69"));
    EXPECT_THAT(refused([](Fat& fat) { fat.tables[0].high_level_select = 1; }), HasSubstr("select from 0 to 0"));
    EXPECT_THAT(refused([](Fat& fat) { fat.tables[0].fap = 1; }), HasSubstr("select from 1 to 14, found 0"));
    EXPECT_THAT(refused([](Fat& fat) { fat.tables[0].fap = 23; }), HasSubstr("each once"));
}

}  // namespace
}  // namespace mien
