// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Where light comes from in each pass. Half of the passes belong to the dome, whose directions lie evenly on a sphere
// (a spiral by the golden angle); the others are dealt out to the lamps by their power. Places on a lamp and shifts of
// the picture follow sequences that fill the square evenly at every length (M. Roberts 2018: multiples of the plastic
// number's powers).

#include "render/optics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mien {

namespace {

float number(double x) {
    return static_cast<float>(x);
}

// Rows of a map from places to clip space, as OpenGL's columns.
Matrix columns(const std::array<Vec3, 4>& rows, const std::array<double, 4>& offsets) {
    Matrix m{};
    for (std::size_t r = 0; r < 4; ++r) {
        m[r] = number(rows[r].x);
        m[4 + r] = number(rows[r].y);
        m[8 + r] = number(rows[r].z);
        m[12 + r] = number(offsets[r]);
    }
    return m;
}

// The i-th place in the unit square.
std::array<double, 2> place_in_square(std::size_t i) {
    constexpr double a = 0.7548776662466927, b = 0.5698402909980532;
    const auto part = [](double x) { return x - std::floor(x); };
    const auto n = static_cast<double>(i);
    return {part(0.5 + a * (n + 1)), part(0.5 + b * (n + 1))};
}

constexpr double golden_angle = 2.399963229728653;

// The studio's own axes: right, upwards, towards the camera.
struct Studio {
    Vec3 right, up, front;
};
Studio studio_of(const Camera& camera) {
    const Vec3 right = axes_of(camera).right, up = camera.up / length(camera.up);
    return {right, up, cross(right, up)};
}

Vec3 in_studio(const Studio& studio, const Vec3& v) {
    return v.x * studio.right + v.y * studio.up + v.z * studio.front;
}

double power(const Lamp& lamp) {
    return 0.2126 * lamp.light.x + 0.7152 * lamp.light.y + 0.0722 * lamp.light.z;
}

Vec3 colour(const Rgb& c) {
    return {c[0], c[1], c[2]};
}

std::vector<Light> portrait() {
    return {
        {{-0.66, 0.52, 0.70}, {1.12F, 1.04F, 0.94F}, 13},  // key
        {{0.95, 0.10, 0.60}, {0.17F, 0.19F, 0.24F}, 22},   // fill
        {{0.62, 0.55, -0.80}, {1.25F, 1.28F, 1.36F}, 14},  // rim
    };
}

}  // namespace

Matrix view_matrix(const Camera& camera, const Ball& all, const std::array<double, 2>& shift) {
    const CameraAxes axes = axes_of(camera);
    const Vec3 eye = camera.eye - camera.target;
    const double middle = dot(eye - all.centre, axes.back);
    const double far = std::max(middle + all.radius, 1e-9 + length(eye) * 1e-3);
    const double near = std::max(middle - all.radius, far * 1e-3);
    const double x = 1 / axes.slope_x, y = -1 / axes.slope_y;
    const double shift_x = 2 * shift[0] / camera.width, shift_y = 2 * shift[1] / camera.height;
    const double a = (far + near) / (far - near), b = -2 * far * near / (far - near);
    const Vec3 w = -axes.back;
    const std::array<Vec3, 4> rows{x * axes.right + shift_x * w, y * axes.up + shift_y * w, a * w, w};
    std::array<double, 4> offsets{};
    for (std::size_t r = 0; r < 4; ++r) offsets[r] = -dot(rows[r], eye);
    offsets[2] += b;
    return columns(rows, offsets);
}

Matrix place_matrix(const Affine& map, const Vec3& origin) {
    const auto& [a, b, c] = map.columns;
    const Vec3 at = map.offset - origin;
    return {number(a.x), number(a.y), number(a.z), 0, number(b.x),  number(b.y),  number(b.z),  0,
            number(c.x), number(c.y), number(c.z), 0, number(at.x), number(at.y), number(at.z), 1};
}

Matrix turn_matrix(const Affine& map) {
    const auto& [a, b, c] = map.columns;
    const double side = determinant(map) < 0 ? -1 : 1;
    return place_matrix({{side * cross(b, c), side * cross(c, a), side * cross(a, b)}, {}}, {});
}

std::vector<Lamp> lamps_of(const Look& look, const Camera& camera) {
    const Studio studio = studio_of(camera);
    std::vector<Lamp> lamps;
    for (const Light& light : look.lights.empty() ? portrait() : look.lights) {
        Lamp lamp;
        const Vec3 direction = in_studio(studio, light.direction);
        lamp.direction = direction / length(direction);
        const Vec3 side = cross(studio.up, lamp.direction);
        const Vec3 across = length(side) > 1e-6 ? side / length(side) : studio.right;
        const double half = std::tan(light.half_size * std::numbers::pi / 180);
        // Lamps that mirror each other have places that mirror each other.
        lamp.across = (light.direction.x < 0 ? -half : half) * across;
        lamp.upward = half * cross(lamp.direction, across);
        lamp.light = look.exposure * colour(light.colour);
        lamps.push_back(lamp);
    }
    return lamps;
}

std::vector<Pass> passes_of(const Look& look, const Camera& camera, std::span<const Lamp> lamps) {
    const Studio studio = studio_of(camera);
    const std::size_t dome = look.passes / 2;
    double total = 0;
    for (const Lamp& lamp : lamps) total += power(lamp);
    std::vector<Pass> passes;
    for (std::size_t l = 0; l < lamps.size(); ++l) {
        const double share = total > 0 ? power(lamps[l]) / total : 0;
        const auto count =
            static_cast<std::size_t>(std::max(1.0, std::round(share * static_cast<double>(look.passes - dome))));
        for (std::size_t i = 0; i < count; ++i) {
            const auto [u, v] = place_in_square(i);
            const Vec3 at = lamps[l].direction + (2 * u - 1) * lamps[l].across + (2 * v - 1) * lamps[l].upward;
            passes.push_back({static_cast<int>(l), at / length(at), lamps[l].light / static_cast<double>(count), {}});
        }
    }
    for (std::size_t i = 0; i < dome; ++i) {
        // Each place and its mirror image: faces are nearly symmetric, and so should their shadows be.
        const std::size_t number = i / 2, pairs = (dome + 1) / 2;
        const auto pair = static_cast<double>(number);
        const double side = i % 2 == 0 ? 1 : -1;
        const double y = 1 - (2 * pair + 1) / static_cast<double>(pairs);
        const double across = std::sqrt(1 - y * y), angle = golden_angle * pair;
        const double high = 0.5 + 0.5 * y, share = high * high * (3 - 2 * high);
        const Vec3 light = look.exposure * (colour(look.ground) + share * (colour(look.sky) - colour(look.ground)));
        passes.push_back({-1,
                          in_studio(studio, {side * across * std::cos(angle), y, across * std::sin(angle)}),
                          4.0 / static_cast<double>(dome) * light,
                          {}});
    }
    // The picture is shifted to few places, each with its share of every lamp; passes of one place follow each other.
    const std::size_t shifts = std::clamp<std::size_t>(look.passes / 4, 4, 16);
    std::vector<Pass> ordered;
    for (std::size_t shift = 0; shift < shifts; ++shift)
        for (std::size_t i = shift; i < passes.size(); i += shifts) {
            ordered.push_back(passes[i]);
            ordered.back().light = static_cast<double>(passes.size()) * passes[i].light;
            const auto [u, v] = place_in_square(shift);
            ordered.back().shift = {u - 0.5, v - 0.5};
        }
    return ordered;
}

Ball shadow_window(const Camera& camera, const Ball& all) {
    const CameraAxes axes = axes_of(camera);
    const double seen = 1.3 * length(camera.eye - camera.target) * std::hypot(axes.slope_x, axes.slope_y);
    const double radius = std::max(seen, 0.35 * all.radius);
    return radius < all.radius ? Ball{{}, radius} : all;
}

ShadowView shadow_view(const Vec3& direction, const Ball& window, const Ball& all, int size,
                       const std::array<double, 2>& shift) {
    const Vec3 off = std::abs(direction.y) < 0.9 ? Vec3{0, 1, 0} : Vec3{1, 0, 0};
    const Vec3 side = cross(off, direction);
    const Vec3 x = side / length(side), y = cross(direction, x);
    ShadowView shadow;
    shadow.texel = 2 * window.radius / size;
    shadow.depth = 2 * all.radius;
    const double s = 1 / window.radius, d = 1 / all.radius;
    const double shift_x = shift[0] * shadow.texel, shift_y = shift[1] * shadow.texel;
    const std::array<Vec3, 4> rows{s * x, s * y, -d * direction, Vec3{}};
    const std::array<double, 4> offsets{s * (shift_x - dot(x, window.centre)), s * (shift_y - dot(y, window.centre)),
                                        d * dot(direction, all.centre), 1};
    shadow.view = columns(rows, offsets);
    std::array<Vec3, 4> half = rows;
    std::array<double, 4> half_offsets = offsets;
    for (std::size_t r = 0; r < 3; ++r) {
        half[r] = 0.5 * half[r];
        half_offsets[r] = 0.5 * offsets[r] + 0.5;
    }
    shadow.lookup = columns(half, half_offsets);
    return shadow;
}

}  // namespace mien
