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
#include <memory>
#include <string>

#include "io/gltf_accessors.hpp"
#include "io/gltf_decompress.hpp"
#include "io/gltf_json.hpp"

namespace mien {

namespace {

using nlohmann::json;

constexpr const char* name = "KHR_draco_mesh_compression";

std::span<const std::byte> compressed_bytes(const GltfDocument& document, const json& extension,
                                            const std::string& pointer) {
    const std::uint64_t number = whole_member(extension, "bufferView", pointer);
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

json& accessor_of(GltfDocument& document, const json& number, const std::string& pointer) {
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

// Gives the accessor a view of its own on these bytes. `stride` 0: packed.
void store(GltfDocument& document, json& accessor, std::span<const std::byte> bytes, std::size_t stride, int target) {
    json view{
        {"buffer", 0}, {"byteOffset", append_bytes(document, bytes)}, {"byteLength", bytes.size()}, {"target", target}};
    if (stride > 0) view["byteStride"] = stride;
    accessor["bufferView"] = element_count(document.json, "bufferViews");
    accessor["byteOffset"] = 0;
    document.json["bufferViews"].push_back(std::move(view));
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

void store_attribute(GltfDocument& document, const draco::Mesh& mesh, const json& id, json& accessor,
                     const std::string& pointer) {
    const std::uint64_t unique = whole_number(id, pointer);
    const draco::PointAttribute* attribute =
        unique <= 0xFFFFFFFF ? mesh.GetAttributeByUniqueId(static_cast<std::uint32_t>(unique)) : nullptr;
    if (attribute == nullptr) fail_at(pointer, "an attribute of the Draco mesh", std::to_string(unique));
    check_count(accessor, mesh.num_points(), pointer);
    const std::size_t width = element_width(accessor, pointer);
    if (width != static_cast<std::size_t>(attribute->num_components()))
        fail_at(pointer, fmt::format("{} numbers an element", width), std::to_string(attribute->num_components()));
    with_component(whole_member(accessor, "componentType", pointer), pointer, [&](auto zero) {
        using T = decltype(zero);
        const std::size_t stride = (width * sizeof(T) + 3) / 4 * 4;
        const auto bytes = values_of<T>(*attribute, mesh.num_points(), width, stride, pointer);
        restate_bounds<T>(accessor, bytes, stride, width);
        store(document, accessor, bytes, stride, 34962);
    });
}

void store_indices(GltfDocument& document, const draco::Mesh& mesh, json& accessor, const std::string& pointer) {
    check_count(accessor, std::uint64_t{3} * mesh.num_faces(), pointer);
    with_component(whole_member(accessor, "componentType", pointer), pointer, [&](auto zero) {
        using T = decltype(zero);
        std::vector<T> indices;
        for (std::uint32_t f = 0; f < mesh.num_faces(); ++f)
            for (const draco::PointIndex& point : mesh.face(draco::FaceIndex(f))) {
                if (point.value() >= mesh.num_points() ||
                    static_cast<double>(static_cast<T>(point.value())) != point.value())
                    fail_at(pointer,
                            fmt::format("vertex numbers below {} that the accessor can hold", mesh.num_points()),
                            std::to_string(point.value()));
                indices.push_back(static_cast<T>(point.value()));
            }
        store(document, accessor, std::as_bytes(std::span(indices)), 0, 34963);
    });
}

void decompress_primitive(GltfDocument& document, json& primitive, const std::string& place, DecodeBudget& budget) {
    const std::string pointer = place + "/extensions/" + name;
    const json extension = primitive["extensions"][name];
    if (!extension.is_object()) fail_found(pointer, "an object", extension);
    if (whole_member(primitive, "mode", place, 4) != 4) fail_found(place + "/mode", "triangles (4)", primitive["mode"]);
    const auto mesh = decode(compressed_bytes(document, extension, pointer), pointer);
    spend(budget, 16 * std::uint64_t{mesh->num_points()} + 12 * std::uint64_t{mesh->num_faces()}, pointer);
    const json& attributes = object_member(primitive, "attributes", place);
    for (const auto& [semantic, id] : object_member(extension, "attributes", pointer).items()) {
        const std::string where = pointer + "/attributes/" + semantic;
        if (!attributes.contains(semantic)) fail_at(where, "an attribute of the primitive", semantic);
        store_attribute(document, *mesh, id, accessor_of(document, attributes[semantic], where), where);
    }
    if (!primitive.contains("indices")) fail_at(place, "indices, as Draco meshes have them", "none");
    store_indices(document, *mesh, accessor_of(document, primitive["indices"], place + "/indices"), place + "/indices");
    remove_extension(primitive, name);
}

}  // namespace

bool decompress_draco(GltfDocument& document, DecodeBudget& budget) {
    bool any = false;
    for (std::size_t m = 0; m < element_count(document.json, "meshes"); ++m) {
        json& mesh = document.json["meshes"][m];
        const std::string at_mesh = fmt::format("/meshes/{}", m);
        const std::size_t primitives = array_member(mesh, "primitives", at_mesh).size();
        for (std::size_t p = 0; p < primitives; ++p) {
            const std::string place = fmt::format("{}/primitives/{}", at_mesh, p);
            json& primitive = mesh["primitives"][p];
            if (!object_member(primitive, "extensions", place).contains(name)) continue;
            decompress_primitive(document, primitive, place, budget);
            any = true;
        }
    }
    return any;
}

}  // namespace mien
