// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// What every reader promises of what it returns, in one place for the tests and the fuzz targets.

#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>

#include "mien/mesh.hpp"
#include "mien/mesh_sequence.hpp"
#include "mien/picture.hpp"
#include "mien/rig.hpp"
#include "mien/scene.hpp"
#include "mien/take.hpp"

namespace mien::hostile {

/// Whether a shape moves vertices of a mesh of this many, each once, by finite amounts.
inline bool keeps_promise(const MorphTarget& target, std::size_t vertices) {
    const auto& moved = target.vertices;
    return target.deltas.size() == moved.size() && (moved.empty() || moved.back() < vertices) &&
           std::adjacent_find(moved.begin(), moved.end(), std::greater_equal<>()) == moved.end() &&
           std::all_of(target.deltas.begin(), target.deltas.end(), is_finite<float>);
}

/// Whether a rig's prior can be solved: all counts fit, and no motion shows no shape.
inline bool keeps_promise(const Prior& prior, const Rig& rig) {
    const std::size_t m = prior.shapes.size();
    bool good = m <= Prior::most_shapes && prior.response.size() == m * rig.points.size() &&
                (prior.stiffness.empty() || prior.stiffness.size() == m * m);
    for (const MorphTarget& shape : prior.shapes) good = good && keeps_promise(shape, rig.rest.size());
    if (!good) return false;
    std::vector<float> weights(m);
    shape_weights(prior, std::vector<Vec3f>(rig.points.size()), weights);
    return std::all_of(weights.begin(), weights.end(), [](float w) { return w == 0; });
}

/// Whether the promise of every reader holds for this mesh.
inline bool keeps_promise(const Mesh& mesh) {
    const auto in_range = [&](std::uint32_t v) { return v < mesh.positions.size(); };
    const auto uv_finite = [](const Vec2f& uv) { return std::isfinite(uv.x) && std::isfinite(uv.y); };
    bool good = mesh.face_starts.front() == 0 && mesh.face_starts.back() == mesh.face_vertices.size();
    for (std::size_t f = 0; f < face_count(mesh); ++f)
        good = good && mesh.face_starts[f] + 3 <= mesh.face_starts[f + 1];
    for (const Part& part : mesh.parts)
        good = good && std::uint64_t{part.first_vertex} + part.vertex_count <= mesh.positions.size() &&
               std::uint64_t{part.first_face} + part.face_count <= face_count(mesh);
    for (const MorphTarget& target : mesh.morph_targets) good = good && keeps_promise(target, mesh.positions.size());
    good = good && (mesh.corner_uvs.empty() || mesh.corner_uvs.size() == mesh.face_vertices.size());
    return good && std::all_of(mesh.face_vertices.begin(), mesh.face_vertices.end(), in_range) &&
           std::all_of(mesh.positions.begin(), mesh.positions.end(), is_finite<float>) &&
           std::all_of(mesh.corner_uvs.begin(), mesh.corner_uvs.end(), uv_finite);
}

/// Times rise; a sample is finite or lost as a whole.
inline bool keeps_promise(const Take& take) {
    const auto whole = [](const Vec3& p) {
        return is_finite(p) || (std::isnan(p.x) && std::isnan(p.y) && std::isnan(p.z));
    };
    bool good = take.samples.size() == take.times.size() * take.points.size() && !take.times.empty();
    for (std::size_t r = 0; r < take.times.size(); ++r)
        good = good && std::isfinite(take.times[r]) && (r == 0 || take.times[r - 1] < take.times[r]);
    return good && std::all_of(take.samples.begin(), take.samples.end(), whole);
}

/// Times rise from 0, and the first and last `rows` rows are finite.
inline bool keeps_promise(const MeshSequence& sequence, std::size_t rows = 100) {
    std::vector<Vec3f> positions(sequence.mesh.positions.size());
    bool good = keeps_promise(sequence.mesh) && !sequence.times.empty() && sequence.times[0] == 0;
    for (std::size_t r = 0; r < sequence.times.size(); ++r) {
        good = good && std::isfinite(sequence.times[r]) && (r == 0 || sequence.times[r - 1] < sequence.times[r]);
        if (r >= rows && r + rows < sequence.times.size()) continue;
        sequence.positions(r, positions);
        good = good && std::all_of(positions.begin(), positions.end(), is_finite<float>);
    }
    return good;
}

/// As many numbers as the size says, and some.
inline bool keeps_promise(const Picture& picture) {
    return !picture.rgba.empty() && picture.rgba.size() == std::uint64_t{4} * picture.width * picture.height;
}

inline bool keeps_promise(const Affine& map) {
    return is_finite(map.columns[0]) && is_finite(map.columns[1]) && is_finite(map.columns[2]) && is_finite(map.offset);
}

/// Joints in range, weights not negative and together 1.
inline bool is_bound(const Surface& surface, const Scene& scene) {
    const std::size_t slots = surface.positions.size() * surface.influences;
    bool good = surface.joints.size() == slots && surface.weights.size() == slots &&
                surface.skin.has_value() == (surface.influences > 0);
    if (!good || !surface.skin) return good;
    good = *surface.skin < scene.skins.size();
    for (std::size_t i = 0; good && i < slots; ++i)
        good = surface.joints[i] < scene.skins[*surface.skin].joints.size() && surface.weights[i] >= 0;
    for (std::size_t v = 0; good && v < surface.positions.size(); ++v) {
        double sum = 0;
        for (std::size_t k = 0; k < surface.influences; ++k) sum += surface.weights[v * surface.influences + k];
        good = std::abs(sum - 1) < 1e-5;
    }
    return good;
}

inline bool keeps_promise(const Surface& surface, const Scene& scene) {
    const std::size_t count = surface.positions.size();
    const auto in_range = [&](std::uint32_t v) { return v < count; };
    const auto is_unit = [](const Vec3f& n) { return std::abs(length(n) - 1) < 1e-5F; };
    const auto uv_finite = [](const Vec2f& uv) { return std::isfinite(uv.x) && std::isfinite(uv.y); };
    const auto good_morph = [&](const MorphTarget& morph) { return keeps_promise(morph, count); };
    const bool sizes = surface.mesh_vertices.size() == count && surface.triangles.size() % 3 == 0 &&
                       (surface.normals.empty() || surface.normals.size() == count) &&
                       (surface.uvs.empty() || surface.uvs.size() == count);
    const bool indices = surface.node < scene.nodes.size() && surface.material < scene.materials.size();
    return sizes && indices && is_bound(surface, scene) &&
           surface.morphs.size() == scene.nodes[surface.node].morph_weights.size() &&
           std::all_of(surface.positions.begin(), surface.positions.end(), is_finite<float>) &&
           std::all_of(surface.normals.begin(), surface.normals.end(), is_unit) &&
           std::all_of(surface.uvs.begin(), surface.uvs.end(), uv_finite) &&
           std::all_of(surface.triangles.begin(), surface.triangles.end(), in_range) &&
           std::all_of(surface.morphs.begin(), surface.morphs.end(), good_morph);
}

inline bool keeps_promise(const Material& material, const Scene& scene) {
    const auto share = [](float x) { return x >= 0 && x <= 1; };
    const auto light = [](float x) { return x >= 0 && std::isfinite(x); };
    bool good = share(material.metallic) && share(material.roughness) && light(material.alpha_cutoff) &&
                std::isfinite(material.normal_scale) &&
                std::all_of(material.colour.begin(), material.colour.end(), share) &&
                std::all_of(material.emission.begin(), material.emission.end(), light) &&
                std::all_of(material.scatter.begin(), material.scatter.end(), share);
    for (const auto& picture :
         {material.colour_picture, material.roughness_picture, material.normal_picture, material.emission_picture})
        good = good && (!picture || *picture < scene.pictures.size());
    return good;
}

inline bool keeps_promise(const Channel& channel, const Scene& scene) {
    if (channel.node >= scene.nodes.size() || channel.times.empty()) return false;
    const std::size_t width = channel.property == Channel::Property::rotation ? 4
                              : channel.property == Channel::Property::morph_weights
                                  ? scene.nodes[channel.node].morph_weights.size()
                                  : 3;
    const std::size_t values = width * (channel.between == Channel::Between::cubic ? 3 : 1);
    const auto finite = [](float x) { return std::isfinite(x); };
    return channel.values.size() == channel.times.size() * values &&
           std::is_sorted(channel.times.begin(), channel.times.end()) &&
           std::all_of(channel.times.begin(), channel.times.end(), finite) &&
           std::all_of(channel.values.begin(), channel.values.end(), finite);
}

/// Whether the promise of every reader holds for this scene.
inline bool keeps_promise(const Scene& scene) {
    bool good = true;
    for (std::size_t n = 0; n < scene.nodes.size(); ++n)
        good = good && (!scene.nodes[n].parent || *scene.nodes[n].parent < n);
    for (const SceneSkin& skin : scene.skins) {
        good = good && skin.joints.size() == skin.inverse_binds.size();
        for (const std::uint32_t joint : skin.joints) good = good && joint < scene.nodes.size();
        for (const Affine& bind : skin.inverse_binds) good = good && keeps_promise(bind);
    }
    for (const Affine& world : rest_pose(scene).worlds) good = good && keeps_promise(world);
    for (const Surface& surface : scene.surfaces) good = good && keeps_promise(surface, scene);
    for (const Material& material : scene.materials) good = good && keeps_promise(material, scene);
    for (const Picture& picture : scene.pictures) good = good && keeps_promise(picture);
    for (const Channel& channel : scene.channels) good = good && keeps_promise(channel, scene);
    return good;
}

/// Whether two takes hold the same names, times and samples, lost ones too.
inline bool equal(const Take& a, const Take& b) {
    const auto same = [](const Vec3& p, const Vec3& q) { return p == q || (std::isnan(p.x) && std::isnan(q.x)); };
    return a.points == b.points && a.times == b.times && a.planar == b.planar &&
           std::equal(a.samples.begin(), a.samples.end(), b.samples.begin(), b.samples.end(), same);
}

}  // namespace mien::hostile
