// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/render/renderer.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <utility>

#include "render/gl_context.hpp"
#include "render/model.hpp"
#include "render/painter.hpp"

#include "mien/error.hpp"

namespace mien {

// Members end in the opposite order: the context last.
struct Renderer::Parts {
    GlContext context;
    Mover mover;
    Painter painter;
    std::map<ModelId, Instance> models;
    ModelId next = 1;

    explicit Parts(bool software) : context(software) {}
    Parts(const Parts&) = delete;
    Parts& operator=(const Parts&) = delete;
    ~Parts() {
        try {
            context.use();
        } catch (const Error&) {
            // Another thread holds the context: what is on the device ends with it.
        }
    }

    Instance& at(ModelId model) {
        const auto found = models.find(model);
        if (found == models.end())
            throw Error(fmt::format("render: expected a model that was uploaded, found number {}", model));
        context.use();
        return found->second;
    }
    ModelId add(Instance instance);
};

namespace {

void measure(Instance& instance) {
    std::vector<Vec3f> positions(instance.still->vertices);
    read_posed(instance, 0, positions);
    const auto box_of = [&](std::size_t first, std::size_t count) {
        Mesh part;
        part.positions.assign(positions.begin() + static_cast<std::ptrdiff_t>(first),
                              positions.begin() + static_cast<std::ptrdiff_t>(first + count));
        return bounding_box(part);
    };
    instance.rest = box_of(0, positions.size());
    for (const Piece& piece : instance.still->pieces) {
        const Box box = box_of(piece.first_vertex, piece.vertex_count);
        instance.centres.push_back(0.5 * (box.low + box.high));
    }
}

Amounts at_rest(const StillModel& still) {
    return still.scene.nodes.empty() ? amounts_of(still, {}, {}) : amounts_of(still, rest_pose(still.scene));
}

void check(const Camera& camera) {
    if (camera.width == 0 || camera.height == 0)
        throw Error(fmt::format("render: expected a picture with pixels, found {} x {}", camera.width, camera.height));
    if (!(camera.field_of_view > 0 && camera.field_of_view < 180))
        throw Error(fmt::format("render: expected a field of view above 0 and below 180 degrees, found {}",
                                camera.field_of_view));
    const double off_line = length(cross(camera.up, camera.eye - camera.target));
    if (!std::isfinite(off_line) || !(off_line > 0))
        throw Error(
            "render: expected a camera that looks at something and an upward direction off that line, found neither");
}

void check(const Look& look) {
    if (look.passes < 8 || look.passes > 1024)
        throw Error(fmt::format("render: expected 8 to 1024 passes, found {}", look.passes));
    if (look.lights.size() > 8)
        throw Error(fmt::format("render: expected at most 8 lights, found {}", look.lights.size()));
    for (const Light& light : look.lights)
        if (!(length(light.direction) > 0) || !is_finite(light.direction) ||
            !(light.half_size >= 0 && light.half_size <= 45))
            throw Error(
                "render: expected every light to have a direction and a half size of 0 to 45 degrees, found one "
                "without");
}

void check_vertices(std::size_t expected, std::size_t found) {
    if (expected != found)
        throw Error(fmt::format("render: expected one for each of the model's {} vertices, found {}", expected, found));
}

// The prior as far as it tells the weights of its shapes; the shapes themselves are on the device.
Prior solve_of(const Prior& prior) {
    return {std::vector<MorphTarget>(prior.shapes.size()), prior.response, prior.stiffness};
}

}  // namespace

ModelId Renderer::Parts::add(Instance instance) {
    models.emplace(next, std::move(instance));
    return next++;
}

Renderer::Renderer(const RendererOptions& options) : parts_(std::make_unique<Parts>(options.software)) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

std::string Renderer::device() const {
    return parts_->context.device;
}

ModelId Renderer::upload(const Scene& scene) {
    parts_->context.use();
    StillModel still = make_still(scene, geometry_of(scene));
    still.tables = tables_of(scene);
    still.scene.nodes = scene.nodes;
    still.scene.skins = scene.skins;
    Instance instance = make_instance(std::make_shared<const StillModel>(std::move(still)));
    parts_->mover.run(instance, at_rest(*instance.still));
    measure(instance);
    return parts_->add(std::move(instance));
}

ModelId Renderer::upload(const Scene& scene, const Movement& movement) {
    parts_->context.use();
    StillModel still = make_still(scene, geometry_of(scene, movement));
    if (movement.rig != nullptr) {
        still.rig.points = movement.rig->points;
        still.rig.eyeballs = movement.rig->eyeballs;
        if (movement.rig->prior) still.rig.prior = solve_of(*movement.rig->prior);
    }
    still.shapes = movement.shapes.size();
    Instance instance = make_instance(std::make_shared<const StillModel>(std::move(still)));
    parts_->mover.run(instance, at_rest(*instance.still));
    measure(instance);
    return parts_->add(std::move(instance));
}

ModelId Renderer::copy(ModelId model) {
    const Instance& from = parts_->at(model);
    Instance instance = make_instance(from.still);
    instance.place = from.place;
    instance.rest = from.rest;
    instance.centres = from.centres;
    parts_->mover.run(instance, at_rest(*instance.still));
    return parts_->add(std::move(instance));
}

void Renderer::remove(ModelId model) {
    parts_->at(model);
    parts_->models.erase(model);
}

void Renderer::place(ModelId model, const Affine& map) {
    parts_->at(model).place = map;
}

void Renderer::pose(ModelId model, const ScenePose& pose) {
    const Instance& instance = parts_->at(model);
    const std::size_t nodes = instance.still->scene.nodes.size();
    if (nodes == 0)
        throw Error(
            "render: expected displacements or weights for a model that a rig or shapes move, found a scene's pose");
    if (pose.worlds.size() != nodes || pose.morph_weights.size() != nodes)
        throw Error(fmt::format("render: expected the pose of a scene with {} nodes, found one of {}", nodes,
                                pose.worlds.size()));
    parts_->mover.run(instance, amounts_of(*instance.still, pose));
}

void Renderer::pose(ModelId model, std::span<const Vec3f> displacements, std::span<const float> weights) {
    const Instance& instance = parts_->at(model);
    const StillModel& still = *instance.still;
    if (!still.scene.nodes.empty())
        throw Error("render: expected a scene's pose for a model that its scene moves, found displacements or weights");
    if (!displacements.empty() && displacements.size() != still.rig.points.size())
        throw Error(fmt::format("render: expected displacements of {} points, found {}", still.rig.points.size(),
                                displacements.size()));
    if (!weights.empty() && weights.size() != still.shapes)
        throw Error(fmt::format("render: expected weights of {} shapes, found {}", still.shapes, weights.size()));
    parts_->mover.run(instance, amounts_of(still, displacements, weights));
}

void Renderer::paint(ModelId model, const Paint& paint) {
    Instance& instance = parts_->at(model);
    if (!paint.values.empty()) check_vertices(instance.still->vertices, paint.values.size());
    instance.low = paint.low;
    instance.high = paint.high > paint.low ? paint.high : paint.low + 1;
    instance.scale = paint.scale;
    set_values(instance, paint.values);
}

Picture Renderer::draw(std::span<const ModelId> models, const Camera& camera, const Look& look) {
    if (models.empty()) throw Error("render: expected at least one model to draw, found none");
    check(camera);
    check(look);
    std::vector<const Instance*> instances;
    for (const ModelId model : models) instances.push_back(&parts_->at(model));
    return parts_->painter.draw(instances, camera, look);
}

std::size_t Renderer::vertex_count(ModelId model) const {
    return parts_->at(model).still->vertices;
}

Box Renderer::rest_box(ModelId model) const {
    const Instance& instance = parts_->at(model);
    const Box& rest = instance.rest;
    Mesh corners;
    for (const double x : {rest.low.x, rest.high.x})
        for (const double y : {rest.low.y, rest.high.y})
            for (const double z : {rest.low.z, rest.high.z})
                corners.positions.push_back(to_float(moved(instance.place, {x, y, z})));
    return bounding_box(corners);
}

void Renderer::read_positions(ModelId model, std::span<Vec3f> positions) const {
    const Instance& instance = parts_->at(model);
    check_vertices(instance.still->vertices, positions.size());
    read_posed(instance, 0, positions);
}

void Renderer::read_normals(ModelId model, std::span<Vec3f> normals) const {
    const Instance& instance = parts_->at(model);
    check_vertices(instance.still->vertices, normals.size());
    read_posed(instance, 1, normals);
}

}  // namespace mien
