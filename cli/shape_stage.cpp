// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "shape_stage.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "mien/algorithms/upright.hpp"
#include "mien/io/scene.hpp"
#include "mien/render/dress.hpp"

namespace mien::cli {

namespace {

Affine upright(const Face& face) {
    const Quaternion back = conjugate(face_turn(face.points).value_or(Quaternion{}));
    return affine_map({}, back, {1, 1, 1});
}

// The face's points in their place, without ears and crown; some more above and below for brows and an open mouth.
Box face_box(const Face& face, const Affine& place) {
    std::vector<Vec3> points;
    for (const FeaturePoint& point : face.points)
        if (!point.id.starts_with("10.") && !point.id.starts_with("11.") && !point.id.starts_with("7."))
            points.push_back(moved(place, point.position));
    if (points.empty())
        for (const FeaturePoint& point : face.points) points.push_back(moved(place, point.position));
    Box box = bounding_box(points);
    const double spare = 0.18 * (box.high.y - box.low.y);
    box.low.y -= spare;
    box.high.y += spare;
    return box;
}

}  // namespace

ShapeStage::ShapeStage(const Face& face, const Rig& rig, const LookFlags& look, Size size)
    : scene_(scene_of(face.mesh)), place_(upright(face)), renderer_(RendererOptions{look.software}) {
    dress(scene_, &rig);
    camera_ = frame(face_box(face, place_), look.view, size.width, size.height, 0.06);
    look_.quality = look.quality;
    look_.passes = look.passes > 0 ? look.passes : 16;
    look_.wire = look.wire;
}

ModelId ShapeStage::enter(std::span<const MorphTarget> shapes) {
    const ModelId model = renderer_.upload(scene_, Movement{nullptr, shapes});
    renderer_.place(model, place_);
    return model;
}

Picture ShapeStage::picture(ModelId model, std::span<const float> weights, std::span<const float> error, float low,
                            float high) {
    renderer_.pose(model, {}, weights);
    std::vector<float> values;
    if (!error.empty())
        for (const Surface& surface : scene_.surfaces)
            for (const std::uint32_t v : surface.mesh_vertices)
                values.push_back(error[v] < low ? std::numeric_limits<float>::quiet_NaN() : error[v]);
    renderer_.paint(model, {values, low, high, ColourScale::heat});
    return renderer_.draw(std::array{model}, camera_, look_);
}

}  // namespace mien::cli
