// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Views and accessors as glTF 2.0 wants them (specification, 3.6): every view begins at a multiple of four, so every
// component type is aligned, and holds one accessor.

#include "io/gltf_builder.hpp"

#include <algorithm>
#include <cassert>

namespace mien {

using nlohmann::json;

namespace {

enum class Component : std::uint16_t { uint8 = 5121, uint16 = 5123, uint32 = 5125, float32 = 5126 };

const char* name(Elements elements) {
    switch (elements) {
        case Elements::scalar:
            return "SCALAR";
        case Elements::vec2:
            return "VEC2";
        case Elements::vec3:
            return "VEC3";
        case Elements::vec4:
            return "VEC4";
        case Elements::mat4:
            return "MAT4";
    }
    return "SCALAR";
}

template <class T>
std::size_t append_accessor(GltfDocument& document, std::span<const T> values, Component component, Elements elements,
                            BufferTarget target) {
    const auto width = static_cast<std::size_t>(elements);
    assert(!values.empty() && values.size() % width == 0);
    const std::size_t view = append_view(document, std::as_bytes(values), target);
    return append_object(document, "accessors",
                         {{"bufferView", view},
                          {"componentType", static_cast<int>(component)},
                          {"count", values.size() / width},
                          {"type", name(elements)}});
}

void add_bounds(json& accessor, std::span<const float> values, std::size_t width) {
    json low = json::array(), high = json::array();
    for (std::size_t c = 0; c < width; ++c) {
        float least = values[c], greatest = values[c];
        for (std::size_t i = c; i < values.size(); i += width) {
            least = std::min(least, values[i]);
            greatest = std::max(greatest, values[i]);
        }
        low.push_back(least);
        high.push_back(greatest);
    }
    accessor["min"] = std::move(low);
    accessor["max"] = std::move(high);
}

}  // namespace

std::size_t append_object(GltfDocument& document, const std::string& array, json object) {
    json& list = document.json[array];
    if (!list.is_array()) list = json::array();
    list.push_back(std::move(object));
    return list.size() - 1;
}

std::size_t append_view(GltfDocument& document, std::span<const std::byte> bytes, BufferTarget target) {
    document.binary.resize((document.binary.size() + 3) / 4 * 4);
    json view = {{"buffer", 0}, {"byteOffset", document.binary.size()}, {"byteLength", bytes.size()}};
    if (target != BufferTarget::none) view["target"] = static_cast<int>(target);
    document.binary.insert(document.binary.end(), bytes.begin(), bytes.end());
    return append_object(document, "bufferViews", std::move(view));
}

std::size_t append_floats(GltfDocument& document, std::span<const float> values, Elements elements, BufferTarget target,
                          Bounds bounds) {
    const std::size_t accessor = append_accessor(document, values, Component::float32, elements, target);
    if (bounds == Bounds::given)
        add_bounds(document.json["accessors"][accessor], values, static_cast<std::size_t>(elements));
    return accessor;
}

std::size_t append_vectors(GltfDocument& document, std::span<const Vec3f> values, BufferTarget target, Bounds bounds) {
    std::vector<float> numbers;
    numbers.reserve(3 * values.size());
    for (const Vec3f& v : values) numbers.insert(numbers.end(), {v.x, v.y, v.z});
    return append_floats(document, numbers, Elements::vec3, target, bounds);
}

std::size_t append_bytes(GltfDocument& document, std::span<const std::uint8_t> values, Elements elements,
                         BufferTarget target) {
    return append_accessor(document, values, Component::uint8, elements, target);
}

std::size_t append_shorts(GltfDocument& document, std::span<const std::uint16_t> values, Elements elements,
                          BufferTarget target) {
    return append_accessor(document, values, Component::uint16, elements, target);
}

std::size_t append_ints(GltfDocument& document, std::span<const std::uint32_t> values, Elements elements,
                        BufferTarget target) {
    return append_accessor(document, values, Component::uint32, elements, target);
}

std::size_t append_indices(GltfDocument& document, std::span<const std::uint32_t> indices) {
    const std::uint32_t greatest = *std::max_element(indices.begin(), indices.end());
    // 65535 itself would restart the primitive.
    if (greatest >= 0xFFFF) return append_ints(document, indices, Elements::scalar, BufferTarget::indices);
    const std::vector<std::uint16_t> narrow(indices.begin(), indices.end());
    return append_shorts(document, narrow, Elements::scalar, BufferTarget::indices);
}

}  // namespace mien
