// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Weights are brought to a sum of 1, which quantised ones miss by a little; negative ones count as nothing. A vertex
// without any weight hangs on the first joint that it names, as it does in common viewers.

#include "io/gltf_surface.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>
#include <utility>

#include "io/gltf_accessors.hpp"
#include "io/gltf_binding.hpp"
#include "io/gltf_json.hpp"

namespace mien {

namespace {

using nlohmann::json;

std::vector<Vec3f> normals_of(const Primitive& primitive) {
    const std::string pointer = attributes_pointer(primitive);
    const auto accessor = find_accessor(attributes_of(primitive), "NORMAL", pointer);
    std::vector<Vec3f> normals;
    if (!accessor || primitive.vertices == 0) return normals;
    const std::vector<float> numbers = read_floats(*primitive.document, *accessor, 3, pointer + "/NORMAL");
    normals.reserve(primitive.vertices);
    for (std::size_t v = 0; v < primitive.vertices; ++v) {
        const Vec3 normal = vec3_at(numbers, v);
        const double size = length(normal);
        normals.push_back(size > 0 ? to_float(normal / size) : Vec3f{0, 0, 1});
    }
    return normals;
}

std::vector<Vec2f> mapped_uvs(const Primitive& primitive, const PictureMapping& mapping) {
    std::vector<Vec2f> uvs = uvs_of(primitive, mapping.set);
    for (Vec2f& uv : uvs) {
        uv = mapped(mapping, uv);
        if (!std::isfinite(uv.x) || !std::isfinite(uv.y))
            fail_at(fmt::format("{}/TEXCOORD_{}", attributes_pointer(primitive), mapping.set),
                    "finite texture coordinates after KHR_texture_transform", "one that runs over");
    }
    return uvs;
}

// The weights of one vertex, not negative and together 1.
void normalise(std::span<float> weights) {
    double sum = 0;
    for (float& w : weights) sum += w = std::max(w, 0.0F);
    if (sum > 0)
        for (float& w : weights) w = static_cast<float>(w / sum);
    else
        weights[0] = 1;
}

}  // namespace

Surface read_surface(const Primitive& primitive, const PictureMapping& mapping, const std::vector<std::string>& morphs,
                     ReadBudget& budget) {
    spend(budget.vertices, primitive.vertices, "vertices", primitive.pointer);
    spend(budget.targets, morphs.size(), "morph targets", primitive.pointer);
    Surface surface;
    surface.positions = positions_of(primitive);
    surface.normals = normals_of(primitive);
    surface.uvs = mapped_uvs(primitive, mapping);
    surface.triangles = triangles_of(primitive, budget);
    surface.mesh_vertices.resize(primitive.vertices);
    std::iota(surface.mesh_vertices.begin(), surface.mesh_vertices.end(), primitive.first_vertex);
    for (std::size_t t = 0; t < morphs.size(); ++t) {
        surface.morphs.push_back({morphs[t], {}, {}});
        add_morph(primitive, t, 0, budget, surface.morphs.back());
    }
    return surface;
}

void bind_surface(Surface& surface, const Primitive& primitive, std::uint32_t skin, std::size_t joints,
                  ReadBudget& budget) {
    const unsigned sets = joint_set_count(primitive);
    if (sets == 0) return;
    const std::size_t slots = std::size_t{4} * sets;
    spend(budget.influences, primitive.vertices * slots, "joints of vertices", attributes_pointer(primitive));
    surface.skin = skin;
    surface.influences = static_cast<std::uint32_t>(slots);
    surface.joints.resize(primitive.vertices * slots);
    surface.weights.resize(primitive.vertices * slots);
    for (unsigned s = 0; s < sets; ++s) {
        const JointSet set = read_joint_set(primitive, s, joints);
        for (std::size_t e = 0; e < set.joints.size(); ++e) {
            const std::size_t slot = e / 4 * slots + std::size_t{4} * s + e % 4;
            surface.joints[slot] = static_cast<std::uint16_t>(set.joints[e]);
            surface.weights[slot] = set.weights[e];
        }
    }
    for (std::size_t v = 0; v < primitive.vertices; ++v)
        normalise(std::span(surface.weights).subspan(v * slots, slots));
}

}  // namespace mien
