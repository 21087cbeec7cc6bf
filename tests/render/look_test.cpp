// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/render/look.hpp"

#include <array>
#include <gtest/gtest.h>

#include "render/stage.hpp"

#include "mien/error.hpp"
#include "mien/render/renderer.hpp"

namespace mien {
namespace {

Scene triangle() {
    Scene scene;
    scene.materials.emplace_back();
    scene.nodes.emplace_back();
    Surface surface;
    surface.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    surface.triangles = {0, 1, 2};
    scene.surfaces.push_back(surface);
    return scene;
}

class LookTest : public stage::Drawing {};

TEST_F(LookTest, OutOfRangeIsRefused) {
    Renderer& renderer = *stage::renderer();
    const std::array heads{renderer.upload(triangle())};
    const Camera camera = frame(renderer.rest_box(heads[0]), View::front, 16, 16);
    const auto refuses = [&](const Look& look) { EXPECT_THROW((void)renderer.draw(heads, camera, look), Error); };
    Look look;
    look.passes = 7;
    refuses(look);
    look.passes = 1025;
    refuses(look);
    look = {};
    look.lights = {Light{{0, 0, 0}}};
    refuses(look);
    look.lights = {Light{{0, 0, 1}, {1, 1, 1}, 46}};
    refuses(look);
}

}  // namespace
}  // namespace mien
