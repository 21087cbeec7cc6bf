// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// What the tests of the renderer share: the renderer, small scenes, and how pictures are compared.

#pragma once

#include <cmath>
#include <cstdlib>
#include <gtest/gtest.h>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "shapes.hpp"

#include "mien/error.hpp"
#include "mien/render/dress.hpp"
#include "mien/render/renderer.hpp"

namespace mien::stage {

/// One renderer for all tests; none where there is no driver.
inline Renderer* renderer(std::string* why = nullptr) {
    static std::string reason;
    static const std::unique_ptr<Renderer> made = []() -> std::unique_ptr<Renderer> {
        try {
            return std::make_unique<Renderer>();
        } catch (const Error& error) {
            reason = error.what();
            return nullptr;
        }
    }();
    if (why != nullptr) *why = reason;
    return made.get();
}

class Drawing : public testing::Test {
protected:
    void SetUp() override {
        std::string why;
        if (renderer(&why) == nullptr) GTEST_SKIP() << why;
    }
    static Renderer& device() { return *renderer(); }
};

/// A mesh as a scene with one material of this colour (linear), dull.
inline Scene scene(const Mesh& mesh, std::array<float, 4> colour = {0.5F, 0.5F, 0.5F, 1}) {
    Scene scene;
    scene.nodes.emplace_back();
    scene.materials.emplace_back();
    scene.materials[0].colour = colour;
    Surface surface;
    surface.positions = mesh.positions;
    for (std::size_t f = 0; f < face_count(mesh); ++f) {
        const auto corners = face(mesh, f);
        for (std::size_t k = 2; k < corners.size(); ++k)
            surface.triangles.insert(surface.triangles.end(), {corners[0], corners[k - 1], corners[k]});
    }
    scene.surfaces.push_back(surface);
    return scene;
}

/// A square of side 2 in the plane z = `z`, facing +z, with the whole of a picture on it.
inline Scene square(std::array<float, 4> colour = {0.5F, 0.5F, 0.5F, 1}, float z = 0, float half = 1) {
    Scene made;
    made.nodes.emplace_back();
    made.materials.emplace_back();
    made.materials[0].colour = colour;
    Surface surface;
    surface.positions = {{-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}};
    surface.uvs = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    surface.triangles = {0, 1, 2, 0, 2, 3};
    made.surfaces.push_back(surface);
    return made;
}

/// Numbers from -1 to 1, the same in every run.
class Numbers {
public:
    float operator()() {
        state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
        return static_cast<float>(static_cast<double>(state_ >> 33U) / 1073741824.0 - 1.0);
    }
    Vec3f vec() {
        const float x = (*this)(), y = (*this)();
        return {x, y, (*this)()};
    }

private:
    std::uint64_t state_ = 1;
};

inline std::vector<Vec3f> positions(ModelId model) {
    std::vector<Vec3f> list(renderer()->vertex_count(model));
    renderer()->read_positions(model, list);
    return list;
}
inline std::vector<Vec3f> normals(ModelId model) {
    std::vector<Vec3f> list(renderer()->vertex_count(model));
    renderer()->read_normals(model, list);
    return list;
}

inline double farthest(const std::vector<Vec3f>& a, const std::vector<Vec3f>& b) {
    double far = a.size() == b.size() ? 0 : 1e9;
    for (std::size_t i = 0; i < a.size() && i < b.size(); ++i) far = std::max<double>(far, distance(a[i], b[i]));
    return far;
}

/// A camera that looks along -z at the square from -1 to 1.
inline Camera straight(std::uint32_t size = 64) {
    Camera camera;
    camera.eye = {0, 0, 1 / std::tan(10 * std::numbers::pi / 180)};
    camera.width = camera.height = size;
    return camera;
}

inline Look draft() {
    Look look;
    look.quality = Quality::draft;
    return look;
}
inline Look full(std::uint32_t passes = 16) {
    Look look;
    look.passes = passes;
    return look;
}

/// Red, green, blue and alpha of a pixel.
inline std::array<int, 4> pixel(const Picture& picture, std::uint32_t x, std::uint32_t y) {
    const std::size_t at = 4 * (std::size_t{y} * picture.width + x);
    return {picture.rgba[at], picture.rgba[at + 1], picture.rgba[at + 2], picture.rgba[at + 3]};
}

inline Picture mirrored(const Picture& picture) {
    Picture other = picture;
    for (std::uint32_t y = 0; y < picture.height; ++y)
        for (std::uint32_t x = 0; x < picture.width; ++x)
            for (std::size_t c = 0; c < 4; ++c)
                other.rgba[4 * (std::size_t{y} * picture.width + x) + c] =
                    picture.rgba[4 * (std::size_t{y} * picture.width + picture.width - 1 - x) + c];
    return other;
}

/// Mean difference of the channels.
inline double difference(const Picture& a, const Picture& b) {
    if (a.rgba.size() != b.rgba.size()) return 255;
    double sum = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i) sum += std::abs(int{a.rgba[i]} - int{b.rgba[i]});
    return sum / static_cast<double>(a.rgba.size());
}

inline Picture shoot(ModelId model, const Camera& camera, const Look& look) {
    return renderer()->draw(std::array{model}, camera, look);
}

}  // namespace mien::stage
