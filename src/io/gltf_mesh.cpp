// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The meshes of a glTF 2.0 document (specification, 3.7) as one mesh in the space of the scene. Primitives may share
// accessors, so a short file can ask for many vertices; what it may ask for in all is bounded.

#include <array>
#include <fmt/format.h>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <string>

#include "io/gltf_accessors.hpp"
#include "io/gltf_codecs.hpp"
#include "io/gltf_document.hpp"
#include "io/gltf_instances.hpp"
#include "io/gltf_json.hpp"
#include "io/gltf_rest_pose.hpp"
#include "io/text.hpp"

#include "mien/io/gltf.hpp"

namespace mien {

namespace {

using nlohmann::json;

// How much may still be read: far more than any head has, and less than a machine's memory.
struct Budget {
    std::uint64_t vertices = 0, corners = 0, morph_vertices = 0, morph_deltas = 0;
};

// Primitives may share one accessor, so that a small file makes a mesh of any size: what is read may grow with the
// bytes that are there, far beyond what any exporter reaches.
Budget budget_of(std::uint64_t bytes) {
    return {(1U << 18U) + 6 * bytes, (1U << 19U) + 8 * bytes, (1U << 21U) + 96 * bytes, (1U << 19U) + 8 * bytes};
}

void spend(std::uint64_t& left, std::uint64_t amount, const char* what, const std::string& pointer) {
    if (amount > left) fail_at(pointer, fmt::format("at most {} more {}", left, what), std::to_string(amount));
    left -= amount;
}

// The mesh while it grows.
struct Growing {
    const GltfDocument& document;
    Mesh mesh;
    Budget budget;
    bool any_uvs = false;
    std::map<std::string, std::size_t> morph_numbers;  // of a name in mesh.morph_targets
};

// One primitive while it is read.
struct Primitive {
    const json& value;
    std::string pointer;
    std::size_t vertices = 0;
    std::uint32_t first_vertex = 0;
    std::vector<Affine> maps;  // one for all vertices, or one a vertex

    [[nodiscard]] const Affine& map(std::size_t vertex) const { return maps.size() == 1 ? maps[0] : maps[vertex]; }
};

Vec3 vec3_at(const std::vector<float>& numbers, std::size_t element) {
    return {numbers[element * 3], numbers[element * 3 + 1], numbers[element * 3 + 2]};
}

Vec3f checked_float(const Vec3& v, const std::string& pointer) {
    const Vec3f narrow = to_float(v);
    if (!is_finite(narrow)) fail_at(pointer, "finite numbers in the scene", "one that runs over");
    return narrow;
}

// The accessor of an attribute, or nothing.
std::optional<std::size_t> attribute(const json& owner, const char* name, const std::string& pointer) {
    const auto found = find_whole(owner, name, pointer);
    return found ? std::optional<std::size_t>(*found) : std::nullopt;
}

void check_counts(const Growing& out, const json& attributes, std::size_t vertices, const std::string& pointer) {
    for (const auto& [name, accessor] : attributes.items()) {
        const std::size_t count = accessor_count(out.document, whole_number(accessor, pointer));
        if (count != vertices)
            fail_at(pointer, fmt::format("{} elements in every attribute", vertices),
                    fmt::format("{} in {}", count, shown(name)));
    }
}

// A primitive without POSITION, which an extension would fill, has no vertices here.
std::size_t primitive_vertices(const Growing& out, const json& primitive, const std::string& pointer) {
    const json& attributes = object_member(primitive, "attributes", pointer);
    const auto positions = attribute(attributes, "POSITION", pointer + "/attributes");
    if (!positions) return 0;
    const std::size_t vertices = accessor_count(out.document, *positions);
    check_counts(out, attributes, vertices, pointer + "/attributes");
    return vertices;
}

void add_positions(Growing& out, const Primitive& primitive) {
    if (primitive.vertices == 0) return;
    const std::string pointer = primitive.pointer + "/attributes/POSITION";
    const std::vector<float> numbers =
        read_floats(out.document, primitive.value["attributes"]["POSITION"].get<std::size_t>(), 3, pointer);
    for (std::size_t v = 0; v < primitive.vertices; ++v)
        out.mesh.positions.push_back(checked_float(moved(primitive.map(v), vec3_at(numbers, v)), pointer));
}

std::vector<std::uint32_t> sequence(std::size_t size) {
    std::vector<std::uint32_t> numbers(size);
    std::iota(numbers.begin(), numbers.end(), 0U);
    return numbers;
}

std::vector<std::uint32_t> primitive_indices(const Growing& out, const Primitive& primitive) {
    const std::string pointer = primitive.pointer + "/indices";
    const auto accessor = attribute(primitive.value, "indices", primitive.pointer);
    if (!accessor || primitive.vertices == 0) return sequence(primitive.vertices);
    std::vector<std::uint32_t> indices = read_indices(out.document, *accessor, pointer);
    for (std::size_t i = 0; i < indices.size(); ++i)
        if (indices[i] >= primitive.vertices)
            fail_at(pointer, fmt::format("indices below {}", primitive.vertices),
                    fmt::format("{} as number {}", indices[i], i));
    return indices;
}

using Triangle = std::array<std::uint32_t, 3>;
enum class Mode : std::uint8_t { triangles = 4, strip, fan };

std::size_t triangle_count(Mode mode, std::size_t indices) {
    if (mode == Mode::triangles) return indices / 3;
    return indices < 3 ? 0 : indices - 2;
}

// Every other triangle of a strip is wound the other way round and is turned (specification, 3.7.2.1).
Triangle triangle(Mode mode, const std::vector<std::uint32_t>& indices, std::size_t t) {
    switch (mode) {
        case Mode::triangles:
            return {indices[3 * t], indices[3 * t + 1], indices[3 * t + 2]};
        case Mode::strip:
            return {indices[t], indices[t + 1 + t % 2], indices[t + 2 - t % 2]};
        default:
            return {indices[0], indices[t + 1], indices[t + 2]};
    }
}

// One texture coordinate a vertex; empty where the primitive has none.
std::vector<float> primitive_uvs(Growing& out, const Primitive& primitive) {
    const std::string pointer = primitive.pointer + "/attributes";
    const json& attributes = object_member(primitive.value, "attributes", primitive.pointer);
    const auto accessor = attribute(attributes, "TEXCOORD_0", pointer);
    if (!accessor || primitive.vertices == 0) return {};
    out.any_uvs = true;
    return read_floats(out.document, *accessor, 2, pointer + "/TEXCOORD_0");
}

void add_triangle(Growing& out, const Primitive& primitive, const Triangle& corners, const std::vector<float>& uvs) {
    Triangle in_mesh{};
    for (std::size_t c = 0; c < 3; ++c) {
        in_mesh[c] = primitive.first_vertex + corners[c];
        const std::size_t at = std::size_t{corners[c]} * 2;
        out.mesh.corner_uvs.push_back(uvs.empty() ? Vec2f{} : Vec2f{uvs[at], uvs[at + 1]});
    }
    add_face(out.mesh, in_mesh);
}

// A map that mirrors turns the winding (specification, 3.7.4), so that the front stays in front.
void add_faces(Growing& out, const Primitive& primitive) {
    const std::uint64_t number = whole_member(primitive.value, "mode", primitive.pointer, 4);
    if (number > 6) fail_at(primitive.pointer + "/mode", "0 to 6", std::to_string(number));
    if (number < 4) return;
    const auto mode = static_cast<Mode>(number);
    const auto accessor = attribute(primitive.value, "indices", primitive.pointer);
    const std::size_t length = accessor ? accessor_count(out.document, *accessor) : primitive.vertices;
    spend(out.budget.corners, std::uint64_t{triangle_count(mode, length)} * 3, "corners", primitive.pointer);
    const std::vector<std::uint32_t> indices = primitive_indices(out, primitive);
    const std::vector<float> uvs = primitive_uvs(out, primitive);
    const bool mirrors = primitive.maps.size() == 1 && determinant(primitive.maps[0]) < 0;
    for (std::size_t t = 0; t < triangle_count(mode, indices.size()); ++t) {
        const Triangle corners = triangle(mode, indices, t);
        add_triangle(out, primitive, mirrors ? Triangle{corners[0], corners[2], corners[1]} : corners, uvs);
    }
}

// The names that exporters leave in the extras of a mesh or, for want of these, of its first primitive.
const json* given_names(const json& mesh) {
    const json* const owners[]{&mesh, &mesh["primitives"][0]};
    for (const json* owner : owners) {
        if (!owner->contains("extras") || !(*owner)["extras"].is_object()) continue;
        const json& extras = (*owner)["extras"];
        if (extras.contains("targetNames") && extras["targetNames"].is_array()) return &extras["targetNames"];
    }
    return nullptr;
}

// The names of a mesh's targets, each once: what has none is called by its number, and what comes again gets one.
std::vector<std::string> target_names(const json& mesh, std::size_t targets) {
    const json* given = given_names(mesh);
    std::vector<std::string> names;
    std::set<std::string> taken;
    for (std::size_t t = 0; t < targets; ++t) {
        std::string name;
        if (given != nullptr && t < given->size() && (*given)[t].is_string()) (*given)[t].get_to(name);
        if (name.empty()) name = fmt::format("morph_{}", t + 1);
        while (!taken.insert(name).second) name += fmt::format("_{}", t + 1);
        names.push_back(std::move(name));
    }
    return names;
}

MorphTarget& target_of(Growing& out, const std::string& name) {
    const auto [at, added] = out.morph_numbers.emplace(name, out.mesh.morph_targets.size());
    if (added) out.mesh.morph_targets.push_back({name, {}, {}});
    return out.mesh.morph_targets[at->second];
}

void add_deltas(Growing& out, const Primitive& primitive, MorphTarget& target, std::size_t accessor,
                const std::string& pointer) {
    if (accessor_count(out.document, accessor) != primitive.vertices)
        fail_at(pointer, fmt::format("{} elements", primitive.vertices),
                std::to_string(accessor_count(out.document, accessor)));
    spend(out.budget.morph_vertices, primitive.vertices, "vertices of morph targets", pointer);
    const std::vector<float> numbers = read_floats(out.document, accessor, 3, pointer);
    const std::size_t before = target.vertices.size();
    for (std::size_t v = 0; v < primitive.vertices; ++v) {
        const Vec3f delta = checked_float(turned(primitive.map(v), vec3_at(numbers, v)), pointer);
        if (delta == Vec3f{}) continue;
        target.vertices.push_back(primitive.first_vertex + static_cast<std::uint32_t>(v));
        target.deltas.push_back(delta);
    }
    spend(out.budget.morph_deltas, target.vertices.size() - before, "vertices that morph targets move", pointer);
}

void add_morphs(Growing& out, const Primitive& primitive, const std::vector<std::string>& names) {
    const json& targets = array_member(primitive.value, "targets", primitive.pointer);
    for (std::size_t t = 0; t < targets.size(); ++t) {
        MorphTarget& target = target_of(out, names[t]);
        const std::string pointer = fmt::format("{}/targets/{}", primitive.pointer, t);
        const auto accessor = attribute(targets[t], "POSITION", pointer);
        if (accessor && primitive.vertices > 0) add_deltas(out, primitive, target, *accessor, pointer + "/POSITION");
    }
}

std::string part_name(const Growing& out, std::size_t mesh, const Standing& standing) {
    const std::string own = text_member(out.document.json["meshes"][mesh], "name", fmt::format("/meshes/{}", mesh));
    if (!own.empty() || !standing.node) return own;
    return text_member(out.document.json["nodes"][*standing.node], "name", fmt::format("/nodes/{}", *standing.node));
}

void add_primitive(Growing& out, const Primitive& primitive, Part part, const std::vector<std::string>& names) {
    part.first_vertex = primitive.first_vertex;
    part.vertex_count = static_cast<std::uint32_t>(primitive.vertices);
    part.first_face = static_cast<std::uint32_t>(face_count(out.mesh));
    add_positions(out, primitive);
    add_faces(out, primitive);
    add_morphs(out, primitive, names);
    part.face_count = static_cast<std::uint32_t>(face_count(out.mesh)) - part.first_face;
    out.mesh.parts.push_back(std::move(part));
}

void add_mesh(Growing& out, std::size_t m, const Standing& standing) {
    const json& value = out.document.json["meshes"][m];
    const std::string pointer = fmt::format("/meshes/{}", m);
    const json& primitives = array_member(value, "primitives", pointer);
    std::vector<std::string> names;
    for (std::size_t p = 0; p < primitives.size(); ++p) {
        const std::string below = fmt::format("{}/primitives/{}", pointer, p);
        const std::size_t targets = array_member(primitives[p], "targets", below).size();
        if (p == 0) names = target_names(value, targets);
        if (targets != names.size())
            fail_at(below + "/targets", fmt::format("{} as in the first primitive", names.size()),
                    std::to_string(targets));
        const std::size_t vertices = primitive_vertices(out, primitives[p], below);
        const Primitive primitive{primitives[p], below, vertices, static_cast<std::uint32_t>(vertex_count(out.mesh)),
                                  vertex_maps(out.document, standing, primitives[p], vertices, below)};
        const Part part{part_name(out, m, standing), static_cast<std::uint32_t>(m), static_cast<std::uint32_t>(p)};
        add_primitive(out, primitive, part, names);
    }
}

// Before anything is read, so that what is too much is refused at once.
void spend_vertices(Growing& out) {
    const json& meshes = array_member(out.document.json, "meshes", "");
    std::size_t vertices = 0;
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        const json& primitives = array_member(meshes[m], "primitives", fmt::format("/meshes/{}", m));
        for (std::size_t p = 0; p < primitives.size(); ++p) {
            const std::string pointer = fmt::format("/meshes/{}/primitives/{}", m, p);
            const std::size_t count = primitive_vertices(out, primitives[p], pointer);
            spend(out.budget.vertices, count, "vertices", pointer);
            vertices += count;
        }
    }
    out.mesh.positions.reserve(vertices);
}

}  // namespace

Mesh parse_gltf(std::span<const std::byte> bytes, const Fetch& fetch) {
    GltfDocument document = load_gltf(bytes, fetch);
    decompress(document);
    copy_instances(document, (1U << 20U) + 8 * std::uint64_t{bytes.size()});
    check_accessors(document);
    Growing out{document, {}, budget_of(document.binary.size()), false, {}};
    spend_vertices(out);
    const std::vector<Standing> stands = standings(document);
    for (std::size_t m = 0; m < stands.size(); ++m) add_mesh(out, m, stands[m]);
    if (!out.any_uvs) out.mesh.corner_uvs.clear();
    out.mesh.unit.assign(1, 'm');
    out.mesh.gltf = format_glb(document);
    return std::move(out.mesh);
}

}  // namespace mien
