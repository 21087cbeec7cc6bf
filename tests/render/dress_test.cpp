// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/render/dress.hpp"

#include <array>
#include <gmock/gmock.h>

namespace mien {
namespace {

Scene scene_of_names(const std::vector<std::string>& names) {
    Scene scene;
    scene.nodes.emplace_back();
    scene.materials.emplace_back();
    for (const std::string& name : names) {
        scene.surfaces.emplace_back();
        scene.surfaces.back().name = name;
        scene.surfaces.back().positions.resize(3);
    }
    return scene;
}

const Material& worn(const Scene& scene, std::size_t surface) {
    return scene.materials[scene.surfaces[surface].material];
}

TEST(Dress, PlainSurfacesAreDressedByTheirName) {
    Scene scene = scene_of_names({"Head", "eye_left", "Eyelashes", "teeth_upper", "tongue", "LeftEyelid"});
    dress(scene);
    EXPECT_GT(worn(scene, 0).scatter[0], worn(scene, 0).scatter[2]) << "skin lets red light through furthest";
    EXPECT_EQ(worn(scene, 1).scatter[0], 0);
    EXPECT_LT(worn(scene, 2).colour[1], 0.1F) << "lashes are dark";
    EXPECT_GT(worn(scene, 3).colour[2], 0.4F) << "teeth are light";
    EXPECT_GT(worn(scene, 4).colour[0], 2 * worn(scene, 4).colour[1]) << "a tongue is red";
    EXPECT_EQ(worn(scene, 5).scatter, worn(scene, 0).scatter) << "a lid is skin";
}

TEST(Dress, PlainIsWhatReadersGiveWhereAFileHasNoMaterial) {
    for (const float grey : {0.8F, 1.0F}) {
        Scene scene = scene_of_names({"tongue"});
        scene.materials[0].name = "plain";
        scene.materials[0].colour = {grey, grey, grey, 1};
        scene.materials[0].roughness = 0.7F;
        dress(scene);
        EXPECT_GT(worn(scene, 0).colour[0], 2 * worn(scene, 0).colour[1]);
    }
}

TEST(Dress, AMaterialThatSaysWhatItIsStaysAsItIs) {
    Scene scene = scene_of_names({"hat"});
    scene.materials[0].colour = {0.1F, 0.2F, 0.9F, 1};
    dress(scene);
    EXPECT_EQ(scene.materials.size(), 1U);
    EXPECT_EQ(worn(scene, 0).scatter, (std::array<float, 3>{}));
}

TEST(Dress, LightTravelsUnderWhatIsCalledSkinAndUnderWhatTheRigMovesMost) {
    Scene scene = scene_of_names({"a", "b", "c"});
    scene.materials.assign(3, {});
    for (std::uint32_t m = 0; m < 3; ++m) {
        scene.materials[m].colour = {0.6F, 0.4F, 0.3F, 1};
        scene.surfaces[m].material = m;
    }
    scene.materials[0].name = "MySkin";
    Rig rig;
    rig.rest.resize(9);
    rig.points.resize(1);
    rig.row_starts = {0, 0, 0, 0, 0, 0, 0, 1, 2, 3};  // the third surface moves
    rig.row_points = {0, 0, 0};
    rig.weights.resize(3);
    dress(scene, &rig);
    EXPECT_GT(scene.materials[0].scatter[0], 0);
    EXPECT_EQ(scene.materials[1].scatter[0], 0);
    EXPECT_GT(scene.materials[2].scatter[0], 0);
}

TEST(Dress, AClearCorneaHasNoColourOfItsOwn) {
    Scene scene = scene_of_names({"eye_left"});
    scene.materials[0].name = "Cornea";
    scene.materials[0].colour = {1, 1, 1, 0.1F};
    scene.materials[0].alpha = Material::Alpha::blend;
    dress(scene);
    EXPECT_EQ(worn(scene, 0).colour, (std::array<float, 4>{0, 0, 0, 0.1F}));
}

TEST(Dress, WhatTheFileSaysOfScatterIsKept) {
    Scene scene = scene_of_names({"a"});
    scene.materials[0].name = "skin";
    scene.materials[0].scatter = {0.1F, 0.1F, 0.1F};
    dress(scene);
    EXPECT_EQ(worn(scene, 0).scatter[0], 0.1F);
}

TEST(Dress, AnEyeballOfTheRigIsAnEyeWhateverItsName) {
    Scene scene = scene_of_names({"Sphere.001"});
    Rig rig;
    rig.rest.resize(3);
    rig.row_starts = {0, 0, 0, 0};
    rig.eyeballs = {{"eye", {0, 1, 2}, {}, {}}};
    dress(scene, &rig);
    EXPECT_LT(worn(scene, 0).roughness, 0.3F);
}

}  // namespace
}  // namespace mien
