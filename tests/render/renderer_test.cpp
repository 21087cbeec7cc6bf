// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/render/renderer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <gmock/gmock.h>

#include "render/stage.hpp"

namespace mien {
namespace {

using stage::draft;
using stage::full;
using stage::pixel;
using stage::shoot;
using stage::straight;

class Drawn : public stage::Drawing {
protected:
    ~Drawn() override {
        for (const ModelId model : made_) device().remove(model);
    }
    ModelId up(const Scene& scene) {
        made_.push_back(device().upload(scene));
        return made_.back();
    }

private:
    std::vector<ModelId> made_;
};

constexpr std::array<Quality, 2> qualities{Quality::draft, Quality::full};

Look look_of(Quality quality) {
    return quality == Quality::draft ? draft() : full();
}

// A ball with bumps that are no mirror image of themselves.
Mesh bumpy(bool mirrored) {
    Mesh mesh = shapes::ball({}, 0.7F, 24, 48);
    for (Vec3f& p : mesh.positions) {
        const float bump = 1 + 0.12F * std::sin(5 * p.x + 2 * p.y) * std::cos(4 * p.y - p.x);
        p = bump * p;
        if (mirrored) p.x = -p.x;
    }
    if (mirrored)
        for (std::size_t f = 0; f < face_count(mesh); ++f)
            std::reverse(mesh.face_vertices.begin() + mesh.face_starts[f],
                         mesh.face_vertices.begin() + mesh.face_starts[f + 1]);
    return mesh;
}

std::vector<Light> lights(double side) {
    return {{{side * 0.8, 0.5, 0.6}, {1, 0.9F, 0.8F}, 12}, {{side * -0.9, 0.1, -0.4}, {0.8F, 0.8F, 1}, 6}};
}

int brightness(const std::array<int, 4>& pixel) {
    return pixel[0] + pixel[1] + pixel[2];
}

TEST_F(Drawn, TheSameIsDrawnTwice) {
    const Scene scene = stage::scene(bumpy(false));
    for (const Quality quality : qualities) {
        const Picture first = shoot(up(scene), straight(), look_of(quality));
        EXPECT_EQ(first.rgba, shoot(up(scene), straight(), look_of(quality)).rgba);
        Renderer other;
        const ModelId model = other.upload(scene);
        EXPECT_EQ(first.rgba, other.draw(std::array{model}, straight(), look_of(quality)).rgba);
    }
}

TEST_F(Drawn, AMirroredSceneInMirroredLightIsTheMirroredPicture) {
    for (const Quality quality : qualities) {
        Look look = look_of(quality), other = look;
        look.passes = other.passes = 96;
        look.lights = lights(1);
        other.lights = lights(-1);
        const Picture right = shoot(up(stage::scene(bumpy(false))), straight(), look);
        const Picture left = shoot(up(stage::scene(bumpy(true))), straight(), other);
        EXPECT_LT(stage::difference(right, stage::mirrored(left)), 1);
        EXPECT_GT(stage::difference(right, left), 5) << "and it is not its own mirror image";
    }
}

TEST_F(Drawn, AMirroringPlaceIsAMirroredScene) {
    for (const Quality quality : qualities) {
        const ModelId placed = up(stage::scene(bumpy(false)));
        device().place(placed, {{Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}, {}});
        const Picture mirrored = shoot(up(stage::scene(bumpy(true))), straight(), look_of(quality));
        EXPECT_LT(stage::difference(shoot(placed, straight(), look_of(quality)), mirrored), 0.2);
    }
}

TEST_F(Drawn, AModelThatCameBackToRestLooksAsItDidThere) {
    Scene scene = stage::scene(bumpy(false));
    scene.surfaces[0].morphs = {{"up", {3, 4, 5, 100}, std::vector<Vec3f>(4, {0, 0.3F, 0.1F})}};
    for (const Quality quality : qualities) {
        const ModelId model = up(scene);
        const Picture rest = shoot(model, straight(), look_of(quality));
        ScenePose pose = rest_pose(scene);
        pose.morph_weights[0] = {1};
        device().pose(model, pose);
        EXPECT_NE(shoot(model, straight(), look_of(quality)).rgba, rest.rgba);
        device().pose(model, rest_pose(scene));
        EXPECT_EQ(shoot(model, straight(), look_of(quality)).rgba, rest.rgba);
    }
}

TEST_F(Drawn, TwoModelsApartAreThePixelsOfEach) {
    const ModelId left = up(stage::scene(shapes::ball({-0.5F, 0, 0}, 0.4F), {0.8F, 0.2F, 0.2F, 1}));
    const ModelId right = up(stage::scene(shapes::ball({0.5F, 0, 0}, 0.4F), {0.2F, 0.2F, 0.8F, 1}));
    const Picture both = device().draw(std::array{left, right}, straight(), draft());
    const Picture one = shoot(left, straight(), draft()), other = shoot(right, straight(), draft());
    for (std::uint32_t y = 0; y < 64; ++y)
        for (std::uint32_t x = 0; x < 64; ++x) EXPECT_EQ(pixel(both, x, y), pixel(x < 32 ? one : other, x, y));
}

TEST_F(Drawn, TheOrderOfModelsDoesNotMatter) {
    const ModelId near = up(stage::square({0.8F, 0.1F, 0.1F, 1}, 0.5F, 0.5F)), far = up(stage::square());
    for (const Quality quality : qualities)
        EXPECT_EQ(device().draw(std::array{near, far}, straight(), look_of(quality)).rgba,
                  device().draw(std::array{far, near}, straight(), look_of(quality)).rgba);
}

TEST_F(Drawn, ASceneWithoutTrianglesAndAPictureOfNothingAreErrors) {
    EXPECT_THROW(up(Scene{}), Error);
    Scene points = stage::square();
    points.surfaces[0].triangles.clear();
    EXPECT_THROW(up(points), Error);
    EXPECT_THROW(device().draw({}, straight(), draft()), Error);
}

TEST_F(Drawn, CamerasAndLooksOutOfRangeAreErrors) {
    const ModelId model = up(stage::square());
    Camera camera = straight();
    camera.width = 0;
    EXPECT_THROW(shoot(model, camera, draft()), Error);
    camera = straight();
    camera.up = {0, 0, 1};
    EXPECT_THROW(shoot(model, camera, draft()), Error);
    camera = straight();
    camera.field_of_view = 180;
    EXPECT_THROW(shoot(model, camera, draft()), Error);
    camera = straight();
    camera.width = 1000000;
    EXPECT_THROW(shoot(model, camera, draft()), Error);
    EXPECT_THROW(shoot(model, straight(), full(7)), Error);
    Look look = draft();
    look.lights.resize(9);
    EXPECT_THROW(shoot(model, straight(), look), Error);
    look.lights = {{{0, 0, 0}, {1, 1, 1}, 10}};
    EXPECT_THROW(shoot(model, straight(), look), Error);
    EXPECT_THROW(shoot(model + 1000, straight(), draft()), Error);
    EXPECT_THROW(device().paint(model, {std::array{1.0F}, 0, 1, ColourScale::heat}), Error);
    EXPECT_NO_THROW(shoot(model, straight(), draft())) << "and it draws on after them";
}

TEST_F(Drawn, AnUnlitSurfaceShowsItsColourAsItIs) {
    Scene scene = stage::square({0.5F, 0.05F, 0.9F, 1});
    scene.materials[0].unlit = true;
    for (const Quality quality : qualities) {
        const std::array<int, 4> seen = pixel(shoot(up(scene), straight(), look_of(quality)), 32, 32);
        // The sRGB curve of 0.5, 0.05 and 0.9.
        EXPECT_NEAR(seen[0], 188, 1);
        EXPECT_NEAR(seen[1], 63, 1);
        EXPECT_NEAR(seen[2], 243, 1);
    }
}

Picture quarters() {
    return {2, 2, {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 128}};
}

TEST_F(Drawn, APictureLiesOnASurfaceFromItsUpperLeftCorner) {
    Scene scene = stage::square({1, 1, 1, 1});
    scene.materials[0].unlit = true;
    scene.materials[0].colour_picture = 0;
    scene.pictures = {quarters()};
    for (const Quality quality : qualities) {
        const Picture picture = shoot(up(scene), straight(), look_of(quality));
        EXPECT_THAT(pixel(picture, 16, 16),
                    testing::ElementsAre(testing::Gt(240), testing::Lt(60), testing::Lt(60), 255));
        EXPECT_THAT(pixel(picture, 48, 16),
                    testing::ElementsAre(testing::Lt(60), testing::Gt(240), testing::Lt(60), 255));
        EXPECT_THAT(pixel(picture, 16, 48),
                    testing::ElementsAre(testing::Lt(60), testing::Lt(60), testing::Gt(240), 255));
    }
}

TEST_F(Drawn, AnUnlitPictureShowsItsOwnNumbers) {
    Scene scene = stage::square({1, 1, 1, 1});
    scene.materials[0].unlit = true;
    scene.materials[0].colour_picture = 0;
    scene.pictures = {{1, 1, {40, 128, 200, 255}}};
    for (const Quality quality : qualities) {
        const auto seen = pixel(shoot(up(scene), straight(), look_of(quality)), 32, 32);
        EXPECT_NEAR(seen[0], 40, 1);
        EXPECT_NEAR(seen[1], 128, 1);
        EXPECT_NEAR(seen[2], 200, 1);
    }
}

TEST_F(Drawn, AMaskCutsAndABlendMixes) {
    for (const Quality quality : qualities) {
        Scene back = stage::square({1, 0, 0, 1}, -0.2F, 2), front = stage::square({0, 0, 1, 0.25F});
        back.materials[0].unlit = front.materials[0].unlit = true;
        const ModelId behind = up(back);
        front.materials[0].alpha = Material::Alpha::mask;
        const Look look = look_of(quality);
        EXPECT_EQ(pixel(device().draw(std::array{behind, up(front)}, straight(), look), 32, 32)[2], 0);
        front.materials[0].colour[3] = 0.75F;
        EXPECT_EQ(pixel(device().draw(std::array{behind, up(front)}, straight(), look), 32, 32)[0], 0);
        front.materials[0].alpha = Material::Alpha::blend;
        const auto mixed = pixel(device().draw(std::array{up(front), behind}, straight(), look), 32, 32);
        EXPECT_GT(mixed[0], 40);
        EXPECT_GT(mixed[2], mixed[0]);
    }
}

TEST_F(Drawn, BackSidesShowOnlyOnTwoSidedMaterials) {
    Scene scene = stage::square({0.8F, 0.8F, 0.8F, 1});
    std::swap(scene.surfaces[0].triangles[1], scene.surfaces[0].triangles[2]);
    std::swap(scene.surfaces[0].triangles[4], scene.surfaces[0].triangles[5]);
    for (const Quality quality : qualities) {
        Look look = look_of(quality);
        look.transparent = true;
        look.sky = look.ground = {0, 0, 0};
        look.lights = {{{0, 0, 1}, {1, 1, 1}, 5}};
        scene.materials[0].double_sided = false;
        EXPECT_EQ(pixel(shoot(up(scene), straight(), look), 32, 32)[3], 0);
        scene.materials[0].double_sided = true;
        const auto seen = pixel(shoot(up(scene), straight(), look), 32, 32);
        EXPECT_EQ(seen[3], 255);
        EXPECT_GT(brightness(seen), 100) << "the side that is seen is the side that is lit";
    }
}

TEST_F(Drawn, WithoutBackgroundNothingIsClear) {
    for (const Quality quality : qualities) {
        Look look = look_of(quality);
        look.transparent = true;
        const Picture picture = shoot(up(stage::square({0.5F, 0.5F, 0.5F, 1}, 0, 0.5F)), straight(), look);
        EXPECT_THAT(pixel(picture, 2, 2), testing::ElementsAre(0, 0, 0, 0));
        EXPECT_EQ(pixel(picture, 32, 32)[3], 255);
    }
}

TEST_F(Drawn, AMarkIsWhereItsPointIsProjected) {
    const ModelId model = up(stage::square({0.1F, 0.1F, 0.1F, 1}));
    Camera camera = straight(128);
    camera.eye += Vec3{1, 0.7, 0};
    for (const Quality quality : qualities) {
        Look look = look_of(quality);
        const Vec3 place{0.3, 0.2, 0.4};
        look.marks = {{place, 6, {0, 1, 0}, false}};
        const Picture picture = shoot(model, camera, look);
        double x = 0, y = 0, all = 0;
        for (std::uint32_t j = 0; j < 128; ++j)
            for (std::uint32_t i = 0; i < 128; ++i) {
                const auto p = pixel(picture, i, j);
                const double green = std::max(0, p[1] - p[0] - 40);
                x += green * (i + 0.5);
                y += green * (j + 0.5);
                all += green;
            }
        const auto seen = project(camera, place);
        EXPECT_NEAR(x / all, seen->x, 0.7);
        EXPECT_NEAR(y / all, seen->y, 0.7);
        look.marks[0].position.z = -1;
        const auto hidden = pixel(shoot(model, camera, look), 64, 64);
        EXPECT_LT(hidden[1], hidden[0] + 10) << "a mark behind the surface is hidden";
    }
}

Scene floor_and_roof() {
    Scene scene = stage::square({0.5F, 0.5F, 0.5F, 1}, 0, 1);
    Surface roof = stage::square({0.5F, 0.5F, 0.5F, 1}, 0.5F, 0.3F).surfaces[0];
    for (Vec3f& p : roof.positions) p.y += 0.5F;
    scene.surfaces.push_back(roof);
    return scene;
}

TEST_F(Drawn, AShadowFallsAwayFromTheLamp) {
    // The roof is half a unit before the wall; a lamp at 45 degrees from above throws its shadow half a unit down.
    Look look = full(32);
    look.lights = {{{0, 1, 1}, {1, 1, 1}, 1}};
    look.sky = look.ground = {0.05F, 0.05F, 0.05F};
    const Picture picture = shoot(up(floor_and_roof()), straight(), look);
    const int shadow = brightness(pixel(picture, 32, 32)), open = brightness(pixel(picture, 32, 60));
    const int beside = brightness(pixel(picture, 8, 32));
    EXPECT_LT(2 * shadow, open);
    EXPECT_NEAR(open, beside, 6);
    look.lights[0].half_size = 30;
    const int soft = brightness(pixel(shoot(up(floor_and_roof()), straight(), look), 32, 43));
    EXPECT_GT(soft, shadow + 20) << "a larger lamp has a softer edge";
}

TEST_F(Drawn, ALampBehindASurfaceDoesNotLightItUnlessLightTravelsUnderIt) {
    for (const Quality quality : qualities) {
        Look look = look_of(quality);
        look.sky = look.ground = {0, 0, 0};
        look.lights = {{{1, 0, -0.1}, {1, 1, 1}, 0}};
        Scene scene = stage::square();
        EXPECT_LT(brightness(pixel(shoot(up(scene), straight(), look), 32, 32)), 6);
        if (quality == Quality::full) continue;  // there a flat sheet has no thickness to go through
        scene.materials[0].scatter = {1, 0.3F, 0.1F};
        const auto seen = pixel(shoot(up(scene), straight(), look), 32, 32);
        EXPECT_GT(seen[0], seen[1] + 10) << "and what comes through is red";
    }
}

TEST_F(Drawn, MoreLightIsBrighter) {
    for (const Quality quality : qualities) {
        Look look = look_of(quality);
        int last = -1;
        for (const double exposure : {0.0, 0.25, 0.5, 1.0, 2.0}) {
            look.exposure = exposure;
            const int now = brightness(pixel(shoot(up(stage::square()), straight(), look), 32, 32));
            EXPECT_GT(now, last);
            last = now;
        }
    }
}

TEST_F(Drawn, DraftAndFullAgreeWhereNothingThrowsAShadow) {
    for (const std::array<float, 3> scatter : {std::array<float, 3>{}, {1, 0.4F, 0.3F}}) {
        Scene scene = stage::square();
        scene.materials[0].scatter = scatter;
        const ModelId model = up(scene);
        const auto quick = pixel(shoot(model, straight(), draft()), 32, 32);
        const auto exact = pixel(shoot(model, straight(), full(256)), 32, 32);
        for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(quick[c], exact[c], 6);
    }
}

TEST_F(Drawn, FinelyAndCoarselyCutSurfacesAreLitAlike) {
    // A draft lights many small triangles at their corners and few large ones in every pixel.
    const Picture fine = shoot(up(stage::scene(shapes::ball({}, 0.8F, 96, 96))), straight(), draft());
    const Picture coarse = shoot(up(stage::scene(shapes::ball({}, 0.8F, 24, 36))), straight(), draft());
    EXPECT_LT(stage::difference(fine, coarse), 1);
}

TEST_F(Drawn, WhatGlowsNeedsNoLight) {
    for (const Quality quality : qualities) {
        Look look = look_of(quality);
        look.exposure = 0;
        Scene scene = stage::square();
        scene.materials[0].emission = {0, 1, 0};
        const auto seen = pixel(shoot(up(scene), straight(), look), 32, 32);
        EXPECT_GT(seen[1], 150);
        EXPECT_EQ(seen[0], 0);
    }
}

TEST_F(Drawn, ANormalPictureTiltsTheSurfaceTowardsGrowingU) {
    for (const Quality quality : qualities) {
        Look look = look_of(quality);
        look.sky = look.ground = {0.02F, 0.02F, 0.02F};
        look.lights = {{{0.9, 0, 0.5}, {1, 1, 1}, 2}};
        Scene scene = stage::square();
        const auto with = [&](std::uint8_t x, std::uint8_t y) {
            scene.pictures = {{1, 1, {x, y, 218, 255}}};
            return brightness(pixel(shoot(up(scene), straight(), look), 32, 32));
        };
        const int plain = brightness(pixel(shoot(up(scene), straight(), look), 32, 32));
        scene.materials[0].normal_picture = 0;
        EXPECT_GT(with(218, 128), plain + 20) << "u grows to the right, where the lamp is";
        EXPECT_LT(with(38, 128), plain - 20);
        EXPECT_NEAR(with(128, 255), with(128, 1), 6) << "and v is across the lamp";
        look.lights[0].direction = {0, 0.9, 0.5};
        EXPECT_GT(with(128, 218), plain + 20) << "green tilts upwards in the picture";
    }
}

TEST_F(Drawn, PaintShowsOnlyWhereThereAreNumbers) {
    const ModelId model = up(stage::square({0.5F, 0.5F, 0.5F, 1}));
    for (const Quality quality : qualities) {
        const Look look = look_of(quality);
        device().paint(model, {});
        const auto plain = pixel(shoot(model, straight(), look), 32, 32);
        const auto painted = [&](float value) {
            device().paint(model, {std::array{value, value, value, value}, 2, 4, ColourScale::opposite});
            return pixel(shoot(model, straight(), look), 32, 32);
        };
        EXPECT_GT(painted(2)[2], painted(2)[0] + 40) << "the low end is blue";
        EXPECT_GT(painted(4)[0], painted(4)[2] + 40) << "the high end is red";
        EXPECT_EQ(painted(std::nanf("")), plain);
    }
}

TEST_F(Drawn, TheWireIsDrawnOverTheSurface) {
    const ModelId model = up(stage::square({0.6F, 0.6F, 0.6F, 1}));
    for (const Quality quality : qualities) {
        Look look = look_of(quality);
        const auto plain = pixel(shoot(model, straight(), look), 32, 32);
        look.wire = true;
        const Picture wired = shoot(model, straight(), look);
        EXPECT_LT(brightness(pixel(wired, 32, 31)), brightness(plain) - 30) << "the diagonal";
        EXPECT_NEAR(brightness(pixel(wired, 20, 10)), brightness(plain), 12);
    }
}

TEST_F(Drawn, TheRestBoxIsInItsPlace) {
    const ModelId model = up(stage::square());
    device().place(model, {{Vec3{2, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}, {5, 0, 0}});
    const Box box = device().rest_box(model);
    EXPECT_LT(distance(box.low, {3, -1, 0}) + distance(box.high, {7, 1, 0}), 1e-6);
}

}  // namespace
}  // namespace mien
