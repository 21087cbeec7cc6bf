// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/render/camera.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

#include "render/optics.hpp"

#include "mien/error.hpp"

namespace mien {

CameraAxes axes_of(const Camera& camera) {
    const Vec3 back = camera.eye - camera.target;
    CameraAxes axes;
    axes.back = back / length(back);
    const Vec3 right = cross(camera.up, axes.back);
    axes.right = right / length(right);
    axes.up = cross(axes.back, axes.right);
    axes.slope_y = std::tan(camera.field_of_view * std::numbers::pi / 360);
    axes.slope_x = axes.slope_y * camera.width / camera.height;
    return axes;
}

namespace {

// From what is looked at to the camera.
Vec3 direction_of(View view) {
    const auto at = [](double azimuth, double height) {
        const double a = azimuth * std::numbers::pi / 180, h = height * std::numbers::pi / 180;
        return Vec3{std::sin(a) * std::cos(h), std::sin(h), std::cos(a) * std::cos(h)};
    };
    switch (view) {
        case View::side:
            return at(90, 0);
        case View::three_quarter:
            return at(35, 4);
        case View::front:
            break;
    }
    return at(0, 0);
}

// The distance from which a point, given from the middle of the box, stays within the slopes.
double distance_for(const Vec3& p, const CameraAxes& axes, double free) {
    return dot(p, axes.back) + std::max(std::abs(dot(p, axes.right)) / (axes.slope_x * free),
                                        std::abs(dot(p, axes.up)) / (axes.slope_y * free));
}

}  // namespace

Camera frame(const Box& box, View view, std::uint32_t width, std::uint32_t height, double margin) {
    if (width == 0 || height == 0)
        throw Error(fmt::format("frame: expected a picture with pixels, found {} x {}", width, height));
    if (!is_finite(box.low) || !is_finite(box.high)) throw Error("frame: expected a finite box, found one that is not");
    Camera camera;
    camera.width = width;
    camera.height = height;
    camera.target = 0.5 * (box.low + box.high);
    camera.eye = camera.target + direction_of(view);
    const CameraAxes axes = axes_of(camera);
    const Vec3 half = 0.5 * (box.high - box.low);
    double away = 0;
    for (const double x : {-half.x, half.x})
        for (const double y : {-half.y, half.y})
            for (const double z : {-half.z, half.z})
                away = std::max(away, distance_for({x, y, z}, axes, std::max(1 - 2 * margin, 0.05)));
    if (away > 0) camera.eye = camera.target + away * axes.back;
    return camera;
}

std::optional<Seen> project(const Camera& camera, const Vec3& point) {
    const CameraAxes axes = axes_of(camera);
    const Vec3 from_eye = point - camera.eye;
    const double depth = -dot(from_eye, axes.back);
    if (!(depth > 0)) return std::nullopt;
    return Seen{(0.5 + 0.5 * dot(from_eye, axes.right) / (depth * axes.slope_x)) * camera.width,
                (0.5 - 0.5 * dot(from_eye, axes.up) / (depth * axes.slope_y)) * camera.height, depth};
}

}  // namespace mien
