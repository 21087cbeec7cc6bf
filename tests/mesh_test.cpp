// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/mesh.hpp"

#include <array>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mien {
namespace {

using testing::ElementsAre;

TEST(Mesh, AFreshMeshHasNoFaces) {
    EXPECT_EQ(face_count(Mesh{}), 0U);
    EXPECT_EQ(vertex_count(Mesh{}), 0U);
}

TEST(Mesh, FacesKeepTheirCornersAndTheirOrder) {
    Mesh mesh;
    mesh.positions.resize(6);
    add_face(mesh, std::array{0U, 1U, 2U, 3U});
    add_face(mesh, std::array{5U, 4U, 3U});
    ASSERT_EQ(face_count(mesh), 2U);
    EXPECT_THAT(face(mesh, 0), ElementsAre(0, 1, 2, 3));
    EXPECT_THAT(face(mesh, 1), ElementsAre(5, 4, 3));
}

TEST(Mesh, TheBoxHoldsEveryVertexWhetherAFaceUsesItOrNot) {
    Mesh mesh;
    mesh.positions = {{1, 2, 3}, {-2, 4, 3}, {0, 0, -9}};
    const Box box = bounding_box(mesh);
    EXPECT_EQ(box.low, (Vec3{-2, 0, -9}));
    EXPECT_EQ(box.high, (Vec3{1, 4, 3}));
    EXPECT_EQ(diagonal(box), 13);  // of 3, 4 and 12
}

TEST(Mesh, TheBoxOfNothingIsNothing) {
    EXPECT_EQ(diagonal(bounding_box(Mesh{})), 0);
}

}  // namespace
}  // namespace mien
