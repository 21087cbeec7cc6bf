// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The primitives of a mesh of a document (glTF 2.0, 3.7.2), for whoever wants them as one mesh or as surfaces.

#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "io/glb.hpp"

#include "mien/affine.hpp"
#include "mien/mesh.hpp"

namespace mien {

/// How much may still be read. Primitives, places and channels may share one accessor, so that a small file asks for
/// any amount: what is read may grow with the bytes that are there, far beyond what any exporter reaches.
struct ReadBudget {
    std::uint64_t vertices = 0, corners = 0, morph_vertices = 0, morph_deltas = 0, influences = 0, key_numbers = 0,
                  targets = 0;
};
ReadBudget read_budget(std::uint64_t bytes);

/// Takes `amount` of what is left. Throws Error naming `pointer` when less is left.
void spend(std::uint64_t& left, std::uint64_t amount, const char* what, const std::string& pointer);

/// One primitive while it is read. It refers to the document.
struct Primitive {
    const GltfDocument* document = nullptr;
    const nlohmann::json* value = nullptr;
    std::string pointer;
    std::size_t vertices = 0;                           ///< 0 without POSITION, which an extension would fill
    std::uint32_t first_vertex = 0;                     ///< number of its first vertex in what is read
    std::vector<Affine> maps = std::vector<Affine>(1);  ///< where its vertices go: one for all of them, or one a vertex

    [[nodiscard]] const Affine& map(std::size_t vertex) const { return maps.size() == 1 ? maps[0] : maps[vertex]; }
};

/// The primitives of a mesh, each of whose attributes has one element a vertex and as many targets as the first.
std::vector<Primitive> primitives_of(const GltfDocument& document, std::size_t mesh);

/// The primitive's attributes, and where they stand.
const nlohmann::json& attributes_of(const Primitive& primitive);
std::string attributes_pointer(const Primitive& primitive);

/// The number that `owner` has for an accessor of this name, or nothing.
std::optional<std::size_t> find_accessor(const nlohmann::json& owner, const std::string& name,
                                         const std::string& pointer);

/// Three numbers of an accessor's element.
Vec3 vec3_at(const std::vector<float>& numbers, std::size_t element);

/// Where the vertices are. Throws Error if a map takes one beyond what a float holds.
std::vector<Vec3f> positions_of(const Primitive& primitive);

/// Three corners a triangle, strips and fans taken apart and turned round where the one map mirrors, so that the front
/// stays in front; nothing for points and lines.
std::vector<std::uint32_t> triangles_of(const Primitive& primitive, ReadBudget& budget);

/// One texture coordinate a vertex of set number `set`; nothing where the primitive has no such set.
std::vector<Vec2f> uvs_of(const Primitive& primitive, std::uint64_t set);

/// How many morph targets a mesh has.
std::size_t target_count(const GltfDocument& document, std::size_t mesh);

/// The names of a mesh's targets, each once: what has none is called by its number, and what comes again gets one.
std::vector<std::string> target_names(const GltfDocument& document, std::size_t mesh);

/// Adds what target number `target` of the primitive moves to `morph`, whose vertices count from `first` on.
void add_morph(const Primitive& primitive, std::size_t target, std::uint32_t first, ReadBudget& budget,
               MorphTarget& morph);

}  // namespace mien
