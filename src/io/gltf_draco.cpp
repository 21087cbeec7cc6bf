// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// KHR_draco_mesh_compression: a primitive whose triangles and attributes are one Draco mesh; its accessors say what
// comes out. The decoder is told nothing that the file promises, and what it gives is held against the accessors.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <draco/compression/decode.h>
#include <exception>
#include <fmt/format.h>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "io/gltf_accessors.hpp"
#include "io/gltf_decompress.hpp"
#include "io/gltf_json.hpp"

namespace mien {

namespace {

using nlohmann::json;

constexpr const char* name = "KHR_draco_mesh_compression";

std::span<const std::byte> compressed_bytes(const GltfDocument& document, std::uint64_t number,
                                            const std::string& pointer) {
    if (number >= element_count(document.json, "bufferViews"))
        fail_at(pointer + "/bufferView", "a buffer view of the file", std::to_string(number));
    const json& view = document.json["bufferViews"][number];
    const std::string place = fmt::format("/bufferViews/{}", number);
    const std::uint64_t offset = whole_member(view, "byteOffset", place, 0);
    const std::uint64_t length = whole_member(view, "byteLength", place);
    if (offset > document.binary.size() || length > document.binary.size() - offset)
        fail_at(place, fmt::format("bytes inside the buffer's {}", document.binary.size()),
                fmt::format("{} bytes from {} on", length, offset));
    return std::span(document.binary).subspan(offset, length);
}

std::unique_ptr<draco::Mesh> decode(std::span<const std::byte> bytes, const std::string& pointer) {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    std::string trouble;
    try {
        draco::Decoder decoder;
        auto result = decoder.DecodeMeshFromBuffer(&buffer);
        if (result.ok() && result.value()) return std::move(result).value();
        trouble = result.status().error_msg_string();
    } catch (const std::exception& error) {  // out of memory, above all
        trouble = error.what();
    }
    fail_at(pointer, "a Draco mesh", fmt::format("{} bytes that are none ({})", bytes.size(), trouble));
}

const json& accessor_of(const GltfDocument& document, const json& number, const std::string& pointer) {
    const std::uint64_t index = whole_number(number, pointer);
    if (index >= element_count(document.json, "accessors"))
        fail_at(pointer, "an accessor of the file", std::to_string(index));
    return document.json["accessors"][index];
}

// One component type at a time: calls `f` with a value of the type that the accessor stores.
template <class F>
void with_component(std::uint64_t component, const std::string& pointer, F f) {
    switch (component) {
        case 5120:
            return f(std::int8_t{});
        case 5121:
            return f(std::uint8_t{});
        case 5122:
            return f(std::int16_t{});
        case 5123:
            return f(std::uint16_t{});
        case 5125:
            return f(std::uint32_t{});
        case 5126:
            return f(float{});
        default:
            fail_at(pointer + "/componentType", "a component type of glTF", std::to_string(component));
    }
}

// What one Draco mesh has filled already: the new accessor by the old one's number and the attribute.
using Filled = std::map<std::pair<std::uint64_t, std::uint64_t>, std::size_t>;
constexpr std::uint64_t triangles_id = ~std::uint64_t{0};

// One compressed mesh while it is unpacked into the accessors of the primitives that name it.
struct Unpacking {
    GltfDocument& document;
    DecodeBudget& budget;
    const draco::Mesh& mesh;
    Filled filled;
};

// Appends a copy of an accessor over these bytes; returns its number. The old one stays as it was, since a primitive
// that is not compressed, or compressed elsewhere, may read it as well. `stride` 0: packed.
std::size_t store(Unpacking& out, json accessor, std::span<const std::byte> bytes, std::size_t stride, int target) {
    json& root = out.document.json;
    json view{{"buffer", 0},
              {"byteOffset", append_bytes(out.document, bytes)},
              {"byteLength", bytes.size()},
              {"target", target}};
    if (stride > 0) view["byteStride"] = stride;
    accessor["bufferView"] = element_count(root, "bufferViews");
    accessor["byteOffset"] = 0;
    accessor.erase("sparse");
    root["bufferViews"].push_back(std::move(view));
    root["accessors"].push_back(std::move(accessor));
    return root["accessors"].size() - 1;
}

void check_count(const json& accessor, std::uint64_t decoded, const std::string& pointer) {
    const std::uint64_t count = whole_member(accessor, "count", pointer);
    if (count != decoded)
        fail_at(pointer + "/count", fmt::format("the {} elements of the Draco mesh", decoded), std::to_string(count));
}

// Bounds stated for the values before compression need not hold for those after it.
template <class T>
void restate_bounds(json& accessor, std::span<const std::byte> bytes, std::size_t stride, std::size_t width) {
    if (!accessor.contains("min") && !accessor.contains("max")) return;
    std::vector<T> low(width), high(width);
    for (std::size_t at = 0; at + width * sizeof(T) <= bytes.size(); at += stride)
        for (std::size_t c = 0; c < width; ++c) {
            T value;
            std::memcpy(&value, bytes.data() + at + c * sizeof(T), sizeof(T));
            low[c] = at == 0 ? value : std::min(low[c], value);
            high[c] = at == 0 ? value : std::max(high[c], value);
        }
    if (!bytes.empty()) accessor["min"] = low;
    if (!bytes.empty()) accessor["max"] = high;
}

template <class T>
std::vector<std::byte> values_of(const draco::PointAttribute& attribute, std::size_t points, std::size_t width,
                                 std::size_t stride, const std::string& pointer) {
    std::vector<std::byte> bytes(points * stride);
    std::array<T, 16> element{};
    for (std::size_t p = 0; p < points; ++p) {
        const auto value = attribute.mapped_index(draco::PointIndex(static_cast<std::uint32_t>(p)));
        if (value.value() >= attribute.size() ||
            !attribute.ConvertValue<T>(value, static_cast<std::int8_t>(width), element.data()))
            fail_at(pointer, "values of the accessor's type in the Draco mesh", fmt::format("none for point {}", p));
        std::memcpy(bytes.data() + p * stride, element.data(), width * sizeof(T));
    }
    return bytes;
}

const draco::PointAttribute& attribute_of(const draco::Mesh& mesh, std::uint64_t id, const std::string& pointer) {
    const draco::PointAttribute* attribute =
        id <= 0xFFFFFFFF ? mesh.GetAttributeByUniqueId(static_cast<std::uint32_t>(id)) : nullptr;
    if (attribute == nullptr) fail_at(pointer, "an attribute of the Draco mesh", std::to_string(id));
    return *attribute;
}

std::size_t store_attribute(Unpacking& out, std::uint64_t id, json accessor, const std::string& pointer) {
    const draco::PointAttribute& attribute = attribute_of(out.mesh, id, pointer);
    check_count(accessor, out.mesh.num_points(), pointer);
    const std::size_t width = element_width(accessor, pointer);
    if (width != static_cast<std::size_t>(attribute.num_components()))
        fail_at(pointer, fmt::format("{} numbers an element", width), std::to_string(attribute.num_components()));
    std::size_t stored = 0;
    with_component(whole_member(accessor, "componentType", pointer), pointer, [&](auto zero) {
        using T = decltype(zero);
        const std::size_t stride = (width * sizeof(T) + 3) / 4 * 4;
        const auto bytes = values_of<T>(attribute, out.mesh.num_points(), width, stride, pointer);
        restate_bounds<T>(accessor, bytes, stride, width);
        spend(out.budget, bytes.size(), pointer);
        stored = store(out, std::move(accessor), bytes, stride, 34962);
    });
    return stored;
}

template <class T>
std::vector<T> indices_of(const draco::Mesh& mesh, const std::string& pointer) {
    std::vector<T> indices;
    for (std::uint32_t f = 0; f < mesh.num_faces(); ++f)
        for (const draco::PointIndex& point : mesh.face(draco::FaceIndex(f))) {
            if (point.value() >= mesh.num_points() ||
                static_cast<double>(static_cast<T>(point.value())) != point.value())
                fail_at(pointer, fmt::format("vertex numbers below {} that the accessor can hold", mesh.num_points()),
                        std::to_string(point.value()));
            indices.push_back(static_cast<T>(point.value()));
        }
    return indices;
}

std::size_t store_indices(Unpacking& out, json accessor, const std::string& pointer) {
    std::size_t stored = 0;
    with_component(whole_member(accessor, "componentType", pointer), pointer, [&](auto zero) {
        const auto indices = indices_of<decltype(zero)>(out.mesh, pointer);
        spend(out.budget, std::as_bytes(std::span(indices)).size(), pointer);
        accessor["count"] = indices.size();
        accessor.erase("min");
        accessor.erase("max");
        stored = store(out, std::move(accessor), std::as_bytes(std::span(indices)), 0, 34963);
    });
    return stored;
}

// Fills what `reference` (a member that numbers an accessor) refers to, and lets it refer to what came of it.
template <class Store>
void fill(Unpacking& out, json& reference, std::uint64_t id, const std::string& pointer, const Store& store_in) {
    const json& old = accessor_of(out.document, reference, pointer);
    const auto [known, is_new] = out.filled.try_emplace({whole_number(reference, pointer), id}, 0);
    if (is_new) known->second = store_in(old);
    reference = known->second;
}

// Draco keeps triangles, whatever they were joined to before; a strip or a fan becomes a list of them.
void unpack(Unpacking& out, json& primitive, const std::string& place) {
    const std::string pointer = place + "/extensions/" + name;
    const std::uint64_t mode = whole_member(primitive, "mode", place, 4);
    if (mode < 4 || mode > 6) fail_found(place + "/mode", "triangles (4 to 6)", primitive["mode"]);
    object_member(primitive, "attributes", place);
    const json ids = object_member(primitive["extensions"][name], "attributes", pointer);
    for (const auto& [semantic, id] : ids.items()) {
        const std::string where = fmt::format("{}/attributes/{}", pointer, semantic);
        if (!primitive["attributes"].contains(semantic)) fail_at(where, "an attribute of the primitive", semantic);
        const std::uint64_t unique = whole_number(id, where);
        fill(out, primitive["attributes"][semantic], unique, where,
             [&](const json& old) { return store_attribute(out, unique, old, where); });
    }
    if (!primitive.contains("indices")) fail_at(place, "indices, as Draco meshes have them", "none");
    const std::string at_indices = place + "/indices";
    if (mode == 4)
        check_count(accessor_of(out.document, primitive["indices"], at_indices),
                    std::uint64_t{3} * out.mesh.num_faces(), at_indices);
    fill(out, primitive["indices"], triangles_id, at_indices,
         [&](const json& old) { return store_indices(out, old, at_indices); });
    primitive["mode"] = 4;
    remove_extension(primitive, name);
}

// A primitive that is compressed: where it stands in the document.
struct Compressed {
    std::size_t mesh = 0, primitive = 0;
};

std::string place_of(const Compressed& at) {
    return fmt::format("/meshes/{}/primitives/{}", at.mesh, at.primitive);
}

// The compressed primitives by the buffer view that they name, each view once.
std::map<std::uint64_t, std::vector<Compressed>> compressed_primitives(const GltfDocument& document) {
    std::map<std::uint64_t, std::vector<Compressed>> found;
    const json& meshes = array_member(document.json, "meshes", "");
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        const json& primitives = array_member(meshes[m], "primitives", fmt::format("/meshes/{}", m));
        for (std::size_t p = 0; p < primitives.size(); ++p) {
            const std::string place = place_of({m, p});
            const json& extensions = object_member(primitives[p], "extensions", place);
            if (!extensions.contains(name)) continue;
            const std::string pointer = place + "/extensions/" + name;
            found[whole_member(extensions[name], "bufferView", pointer)].push_back({m, p});
        }
    }
    return found;
}

}  // namespace

bool decompress_draco(GltfDocument& document, DecodeBudget& budget) {
    const auto all = compressed_primitives(document);
    for (const auto& [view, primitives] : all) {
        const std::string pointer = place_of(primitives.front()) + "/extensions/" + name;
        const auto mesh = decode(compressed_bytes(document, view, pointer), pointer);
        Unpacking out{document, budget, *mesh, {}};
        for (const Compressed& at : primitives)
            unpack(out, document.json["meshes"][at.mesh]["primitives"][at.primitive], place_of(at));
    }
    return !all.empty();
}

}  // namespace mien
