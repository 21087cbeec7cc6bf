// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Kshirsagar et al., eq. 5, with its denominator folded into the weights at bind time; the same sum is the skinning of
// Dutreve et al., section 3.1. Eyeballs, which no sum of translations can turn, turn about their centre. The papers
// move no eyeballs; MPEG-4 gives them as angles (FAPs 23-26).

#include "mien/algorithms/deform.hpp"

#include <array>
#include <cassert>
#include <fmt/format.h>
#include <memory>
#include <vector>

#include "mien/error.hpp"

namespace mien {

namespace {

Vec3f moved(const Rig& rig, std::size_t v, std::span<const Vec3f> displacements) noexcept {
    Vec3f motion;
    for (std::uint32_t e = rig.row_starts[v]; e < rig.row_starts[v + 1]; ++e) {
        const Vec3f& w = rig.weights[e];
        const Vec3f& d = displacements[rig.row_points[e]];
        motion += {w.x * d.x, w.y * d.y, w.z * d.z};
    }
    return rig.rest[v] + motion;
}

void turn(const Rig& rig, const Eyeball& eyeball, std::span<const Vec3f> displacements,
          std::span<Vec3f> positions) noexcept {
    const Quaternion q = eyeball_turn(rig, eyeball, displacements);
    for (const std::uint32_t v : eyeball.vertices)
        positions[v] = to_float(eyeball.centre + rotate(q, to_double(rig.rest[v]) - eyeball.centre));
}

void add_shapes(const Prior& prior, std::span<const Vec3f> displacements, std::span<Vec3f> positions) noexcept {
    std::array<float, Prior::most_shapes> weights{};
    shape_weights(prior, displacements, std::span(weights).first(prior.shapes.size()));
    for (std::size_t k = 0; k < prior.shapes.size(); ++k) {
        const MorphTarget& shape = prior.shapes[k];
        if (weights[k] == 0) continue;
        for (std::size_t i = 0; i < shape.vertices.size(); ++i)
            positions[shape.vertices[i]] += weights[k] * shape.deltas[i];
    }
}

}  // namespace

void deform(const Rig& rig, std::span<const Vec3f> displacements, std::span<Vec3f> positions) noexcept {
    assert(displacements.size() == rig.points.size() && positions.size() == rig.rest.size());
    for (std::size_t v = 0; v < positions.size(); ++v) positions[v] = moved(rig, v, displacements);
    if (rig.prior) add_shapes(*rig.prior, displacements, positions);
    for (const Eyeball& eyeball : rig.eyeballs) turn(rig, eyeball, displacements, positions);
}

MeshSequence deform(const Rig& rig, const Mesh& mesh, const Take& take) {
    if (vertex_count(mesh) != vertex_count(rig))
        throw Error(fmt::format("deform: expected the mesh of the rig with {} vertices, found {}", vertex_count(rig),
                                vertex_count(mesh)));
    struct Performance {
        Rig rig;
        Take take;
        TakeBinding binding;
    };
    const auto performance = std::make_shared<const Performance>(Performance{rig, take, bind_take(rig, take)});
    if (performance->binding.missing.size() == rig.points.size())
        throw Error("deform: expected a take that drives at least one of the rig's points, found none");
    return {mesh, take.times, [performance](std::size_t r, std::span<Vec3f> positions) {
                std::vector<Vec3f> moves(performance->rig.points.size());
                displacements(performance->rig, performance->binding, row(performance->take, r), moves);
                deform(performance->rig, moves, positions);
            }};
}

}  // namespace mien
