// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "io/gltf_primitive.hpp"

#include <array>
#include <fmt/format.h>
#include <numeric>
#include <set>

#include "io/gltf_accessors.hpp"
#include "io/gltf_json.hpp"
#include "io/text.hpp"

namespace mien {

namespace {

using nlohmann::json;

Vec3f checked_float(const Vec3& v, const std::string& pointer) {
    const Vec3f narrow = to_float(v);
    if (!is_finite(narrow)) fail_at(pointer, "finite numbers in the scene", "one that runs over");
    return narrow;
}

void check_counts(const Primitive& primitive) {
    const std::string pointer = attributes_pointer(primitive);
    for (const auto& [name, accessor] : attributes_of(primitive).items()) {
        const std::size_t count = accessor_count(*primitive.document, whole_number(accessor, pointer));
        if (count != primitive.vertices)
            fail_at(pointer, fmt::format("{} elements in every attribute", primitive.vertices),
                    fmt::format("{} in {}", count, shown(name)));
    }
}

std::size_t targets_of(const json& primitive, const std::string& pointer) {
    return array_member(primitive, "targets", pointer).size();
}

Primitive primitive_of(const GltfDocument& document, const json& value, std::string pointer) {
    Primitive primitive{&document, &value, std::move(pointer)};
    const auto positions = find_accessor(attributes_of(primitive), "POSITION", attributes_pointer(primitive));
    if (!positions) return primitive;
    primitive.vertices = accessor_count(document, *positions);
    check_counts(primitive);
    return primitive;
}

std::vector<std::uint32_t> sequence(std::size_t size) {
    std::vector<std::uint32_t> numbers(size);
    std::iota(numbers.begin(), numbers.end(), 0U);
    return numbers;
}

std::vector<std::uint32_t> indices_of(const Primitive& primitive) {
    const std::string pointer = primitive.pointer + "/indices";
    const auto accessor = find_accessor(*primitive.value, "indices", primitive.pointer);
    if (!accessor || primitive.vertices == 0) return sequence(primitive.vertices);
    std::vector<std::uint32_t> indices = read_indices(*primitive.document, *accessor, pointer);
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

}  // namespace

ReadBudget read_budget(std::uint64_t bytes) {
    return {(1U << 18U) + 6 * bytes,  (1U << 19U) + 8 * bytes, (1U << 21U) + 96 * bytes, (1U << 19U) + 8 * bytes,
            (1U << 20U) + 24 * bytes, (1U << 19U) + 8 * bytes, (1U << 17U) + bytes / 16};
}

void spend(std::uint64_t& left, std::uint64_t amount, const char* what, const std::string& pointer) {
    if (amount > left) fail_at(pointer, fmt::format("at most {} more {}", left, what), std::to_string(amount));
    left -= amount;
}

std::vector<Primitive> primitives_of(const GltfDocument& document, std::size_t mesh) {
    const std::string pointer = fmt::format("/meshes/{}", mesh);
    const json& values = array_member(document.json["meshes"][mesh], "primitives", pointer);
    std::vector<Primitive> primitives;
    for (std::size_t p = 0; p < values.size(); ++p) {
        const std::string below = fmt::format("{}/primitives/{}", pointer, p);
        const std::size_t first = targets_of(values[0], pointer + "/primitives/0");
        const std::size_t targets = targets_of(values[p], below);
        if (targets != first)
            fail_at(below + "/targets", fmt::format("{} as in the first primitive", first), std::to_string(targets));
        primitives.push_back(primitive_of(document, values[p], below));
    }
    return primitives;
}

const json& attributes_of(const Primitive& primitive) {
    return object_member(*primitive.value, "attributes", primitive.pointer);
}

std::string attributes_pointer(const Primitive& primitive) {
    return primitive.pointer + "/attributes";
}

std::optional<std::size_t> find_accessor(const json& owner, const std::string& name, const std::string& pointer) {
    const auto found = find_whole(owner, name.c_str(), pointer);
    return found ? std::optional<std::size_t>(*found) : std::nullopt;
}

Vec3 vec3_at(const std::vector<float>& numbers, std::size_t element) {
    return {numbers[element * 3], numbers[element * 3 + 1], numbers[element * 3 + 2]};
}

std::vector<Vec3f> positions_of(const Primitive& primitive) {
    std::vector<Vec3f> positions;
    if (primitive.vertices == 0) return positions;
    const std::string pointer = attributes_pointer(primitive) + "/POSITION";
    const std::vector<float> numbers =
        read_floats(*primitive.document, attributes_of(primitive)["POSITION"].get<std::size_t>(), 3, pointer);
    positions.reserve(primitive.vertices);
    for (std::size_t v = 0; v < primitive.vertices; ++v)
        positions.push_back(checked_float(moved(primitive.map(v), vec3_at(numbers, v)), pointer));
    return positions;
}

std::vector<std::uint32_t> triangles_of(const Primitive& primitive, ReadBudget& budget) {
    const std::uint64_t number = whole_member(*primitive.value, "mode", primitive.pointer, 4);
    if (number > 6) fail_at(primitive.pointer + "/mode", "0 to 6", std::to_string(number));
    std::vector<std::uint32_t> corners;
    if (number < 4) return corners;
    const auto mode = static_cast<Mode>(number);
    const auto accessor = find_accessor(*primitive.value, "indices", primitive.pointer);
    const std::size_t length = accessor ? accessor_count(*primitive.document, *accessor) : primitive.vertices;
    spend(budget.corners, std::uint64_t{triangle_count(mode, length)} * 3, "corners", primitive.pointer);
    const std::vector<std::uint32_t> indices = indices_of(primitive);
    const bool mirrors = primitive.maps.size() == 1 && determinant(primitive.maps[0]) < 0;
    for (std::size_t t = 0; t < triangle_count(mode, indices.size()); ++t) {
        const auto [a, b, c] = triangle(mode, indices, t);
        corners.insert(corners.end(), {a, mirrors ? c : b, mirrors ? b : c});
    }
    return corners;
}

std::vector<Vec2f> uvs_of(const Primitive& primitive, std::uint64_t set) {
    const std::string name = fmt::format("TEXCOORD_{}", set), pointer = attributes_pointer(primitive);
    const auto accessor = find_accessor(attributes_of(primitive), name, pointer);
    std::vector<Vec2f> uvs;
    if (!accessor || primitive.vertices == 0) return uvs;
    const std::vector<float> numbers = read_floats(*primitive.document, *accessor, 2, pointer + '/' + name);
    uvs.reserve(primitive.vertices);
    for (std::size_t v = 0; v < primitive.vertices; ++v) uvs.push_back({numbers[2 * v], numbers[2 * v + 1]});
    return uvs;
}

std::size_t target_count(const GltfDocument& document, std::size_t mesh) {
    const std::string pointer = fmt::format("/meshes/{}", mesh);
    const json& primitives = array_member(document.json["meshes"][mesh], "primitives", pointer);
    return primitives.empty() ? 0 : targets_of(primitives[0], pointer + "/primitives/0");
}

std::vector<std::string> target_names(const GltfDocument& document, std::size_t number) {
    const json& mesh = document.json["meshes"][number];
    const std::size_t targets = target_count(document, number);
    const json* extras = mesh.contains("extras") && mesh["extras"].is_object() ? &mesh["extras"] : nullptr;
    const json* given = extras != nullptr && extras->contains("targetNames") ? &(*extras)["targetNames"] : nullptr;
    std::vector<std::string> names;
    std::set<std::string> taken;
    for (std::size_t t = 0; t < targets; ++t) {
        const bool named = given != nullptr && given->is_array() && t < given->size() && (*given)[t].is_string();
        std::string name;
        if (named) (*given)[t].get_to(name);
        if (name.empty()) name = fmt::format("morph_{}", t + 1);
        if (!taken.insert(name).second) name += fmt::format("_{}", t + 1);
        taken.insert(name);
        names.push_back(std::move(name));
    }
    return names;
}

void add_morph(const Primitive& primitive, std::size_t target, std::uint32_t first, ReadBudget& budget,
               MorphTarget& morph) {
    const std::string above = fmt::format("{}/targets/{}", primitive.pointer, target), pointer = above + "/POSITION";
    const auto accessor = find_accessor((*primitive.value)["targets"][target], "POSITION", above);
    if (!accessor || primitive.vertices == 0) return;
    if (accessor_count(*primitive.document, *accessor) != primitive.vertices)
        fail_at(pointer, fmt::format("{} elements", primitive.vertices),
                std::to_string(accessor_count(*primitive.document, *accessor)));
    spend(budget.morph_vertices, primitive.vertices, "vertices of morph targets", pointer);
    const std::vector<float> numbers = read_floats(*primitive.document, *accessor, 3, pointer);
    const std::size_t before = morph.vertices.size();
    for (std::size_t v = 0; v < primitive.vertices; ++v) {
        const Vec3f delta = checked_float(turned(primitive.map(v), vec3_at(numbers, v)), pointer);
        if (delta == Vec3f{}) continue;
        morph.vertices.push_back(first + static_cast<std::uint32_t>(v));
        morph.deltas.push_back(delta);
    }
    spend(budget.morph_deltas, morph.vertices.size() - before, "vertices that morph targets move", pointer);
}

}  // namespace mien
