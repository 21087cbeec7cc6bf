// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The accessors of glTF 2.0 (specification, 3.6.2) and KHR_mesh_quantization. Numbers are copied out of the bytes, so
// that an address that is not aligned, which the specification forbids and many write, does no harm.

#include "io/gltf_accessors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>

#include "io/gltf_document.hpp"
#include "io/gltf_json.hpp"
#include "io/text.hpp"

namespace mien {

namespace {

using nlohmann::json;

// As many elements as a file may ask for that are zeros and lie nowhere.
constexpr std::uint64_t most_zeros = std::uint64_t{1} << 24;

struct Type {
    std::string_view name;
    unsigned components = 1;
    unsigned columns = 1;
};
constexpr std::array types{Type{"SCALAR", 1, 1}, Type{"VEC2", 2, 1}, Type{"VEC3", 3, 1}, Type{"VEC4", 4, 1},
                           Type{"MAT2", 4, 2},   Type{"MAT3", 9, 3}, Type{"MAT4", 16, 4}};

// The component types of the specification by their number.
enum class Number : std::uint16_t { int8 = 5120, uint8, int16, uint16, uint32 = 5125, float32 };

std::size_t size_of(Number number) {
    switch (number) {
        case Number::int8:
        case Number::uint8:
            return 1;
        case Number::int16:
        case Number::uint16:
            return 2;
        default:
            return 4;
    }
}

// What an accessor says of itself.
struct Accessor {
    std::string pointer;
    std::uint64_t count = 0;
    Type type;
    Number number = Number::float32;
    bool normalized = false;
};

// Numbers in the binary: `count` elements, `stride` bytes from one to the next.
struct Run {
    const std::byte* begin = nullptr;
    std::uint64_t count = 0;
    std::uint64_t stride = 0;
};

Type type_at(const json& value, const std::string& pointer) {
    const std::string name = text_member(value, "type", pointer);
    const auto* const found = std::find_if(types.begin(), types.end(), [&](const Type& t) { return t.name == name; });
    if (found == types.end()) fail_at(pointer + "/type", "SCALAR, VEC2 to VEC4 or MAT2 to MAT4", shown(name));
    return *found;
}

Number number_at(const json& value, const std::string& pointer) {
    const std::uint64_t found = whole_member(value, "componentType", pointer);
    if (found < 5120 || found > 5126 || found == 5124)
        fail_at(pointer + "/componentType", "5120 to 5123, 5125 or 5126", std::to_string(found));
    return static_cast<Number>(found);
}

const json& accessor_json(const GltfDocument& document, std::size_t accessor) {
    const json& accessors = array_member(document.json, "accessors", "");
    if (accessor >= accessors.size())
        fail_at("/accessors", fmt::format("more than {} elements", accessor), std::to_string(accessors.size()));
    return accessors[accessor];
}

Accessor accessor_at(const GltfDocument& document, std::size_t accessor) {
    const json& value = accessor_json(document, accessor);
    const std::string pointer = fmt::format("/accessors/{}", accessor);
    return {pointer, whole_member(value, "count", pointer), type_at(value, pointer), number_at(value, pointer),
            bool_member(value, "normalized", pointer)};
}

// Columns of a matrix begin at multiples of four bytes.
std::uint64_t element_size(const Type& type, Number number) {
    const std::uint64_t column = std::uint64_t{type.components / type.columns} * size_of(number);
    return type.columns == 1 ? column : (column + 3) / 4 * 4 * type.columns;
}

// The run that `owner` (an accessor or a part of its sparse) asks for, all of it inside its view. No product here can
// run over: counts and strides were read as at most 2^53, and the count is held against the view's size first.
Run run_in_view(const GltfDocument& document, const json& owner, std::uint64_t count, std::uint64_t size,
                bool may_stride, const std::string& pointer) {
    const std::size_t index = whole_member(owner, "bufferView", pointer);
    check_view(document, index);
    const json& view = document.json["bufferViews"][index];
    const std::string view_pointer = fmt::format("/bufferViews/{}", index);
    const std::uint64_t length = whole_member(view, "byteLength", view_pointer);
    const std::uint64_t stride = may_stride ? whole_member(view, "byteStride", view_pointer, size) : size;
    const std::uint64_t offset = whole_member(owner, "byteOffset", pointer, 0);
    if (stride < size) fail_at(view_pointer + "/byteStride", fmt::format("at least {}", size), std::to_string(stride));
    const bool fits =
        count == 0 || (offset <= length && length - offset >= size && (length - offset - size) / stride >= count - 1);
    if (!fits)
        fail_at(pointer, fmt::format("elements inside the {} bytes of its view", length),
                fmt::format("{} from byte {} on, {} bytes apart", count, offset, stride));
    return {document.binary.data() + whole_member(view, "byteOffset", view_pointer, 0) + std::min(offset, length),
            count, stride};
}

template <class T>
T load(const std::byte* at) {
    T value;
    std::memcpy(&value, at, sizeof value);
    return value;
}

// A whole number as the fraction that it stands for (specification, 3.11).
template <class T>
float fraction(T value) {
    constexpr auto largest = static_cast<float>(std::numeric_limits<T>::max());
    return std::max(static_cast<float>(value) / largest, -1.F);
}

template <class T>
float load_float(const std::byte* at, bool normalized) {
    const T value = load<T>(at);
    if constexpr (std::is_floating_point_v<T>)
        return value;
    else
        return normalized ? fraction(value) : static_cast<float>(value);
}

float load_number(const std::byte* at, Number number, bool normalized) {
    switch (number) {
        case Number::int8:
            return load_float<std::int8_t>(at, normalized);
        case Number::uint8:
            return load_float<std::uint8_t>(at, normalized);
        case Number::int16:
            return load_float<std::int16_t>(at, normalized);
        case Number::uint16:
            return load_float<std::uint16_t>(at, normalized);
        case Number::uint32:
            return load_float<std::uint32_t>(at, normalized);
        default:
            return load_float<float>(at, normalized);
    }
}

std::uint32_t load_whole(const std::byte* at, Number number) {
    switch (number) {
        case Number::uint8:
            return load<std::uint8_t>(at);
        case Number::uint16:
            return load<std::uint16_t>(at);
        default:
            return load<std::uint32_t>(at);
    }
}

void check_whole(Number number, const std::string& pointer) {
    if (number != Number::uint8 && number != Number::uint16 && number != Number::uint32)
        fail_at(pointer + "/componentType", "5121, 5123 or 5125", std::to_string(static_cast<unsigned>(number)));
}

// The part of an accessor that differs from what lies in its view (or from zeros).
struct Sparse {
    std::string pointer;
    Number number = Number::uint32;  // of the indices
    Run indices, values;
};

std::optional<Sparse> sparse_of(const GltfDocument& document, const Accessor& accessor, const json& value) {
    if (!value.contains("sparse")) return std::nullopt;
    const std::string pointer = accessor.pointer + "/sparse";
    const json& sparse = value["sparse"];
    const std::uint64_t count = whole_member(sparse, "count", pointer);
    if (count > accessor.count)
        fail_at(pointer + "/count", fmt::format("at most {}", accessor.count), std::to_string(count));
    const json& indices = object_member(sparse, "indices", pointer);
    const json& values = object_member(sparse, "values", pointer);
    const Number number = number_at(indices, pointer + "/indices");
    check_whole(number, pointer + "/indices");
    const std::uint64_t size = element_size(accessor.type, accessor.number);
    return Sparse{pointer, number, run_in_view(document, indices, count, size_of(number), false, pointer + "/indices"),
                  run_in_view(document, values, count, size, false, pointer + "/values")};
}

// Ascending, each below the accessor's count.
std::vector<std::uint32_t> sparse_indices(const Sparse& sparse, std::uint64_t count) {
    const std::string pointer = sparse.pointer + "/indices";
    std::vector<std::uint32_t> indices(sparse.indices.count);
    for (std::size_t i = 0; i < indices.size(); ++i) {
        indices[i] = load_whole(sparse.indices.begin + i * sparse.indices.stride, sparse.number);
        if (indices[i] >= count)
            fail_at(pointer, fmt::format("indices below {}", count), fmt::format("{} as number {}", indices[i], i));
        if (i > 0 && indices[i] <= indices[i - 1])
            fail_at(pointer, "ascending indices", fmt::format("{} after {}", indices[i], indices[i - 1]));
    }
    return indices;
}

// The elements that lie in a view of their own; none where all are zeros.
Run dense_of(const GltfDocument& document, const Accessor& accessor, const json& value) {
    if (!value.contains("bufferView")) {
        if (accessor.count > most_zeros)
            fail_at(accessor.pointer + "/count", fmt::format("at most {} without a buffer view", most_zeros),
                    std::to_string(accessor.count));
        return {};
    }
    return run_in_view(document, value, accessor.count, element_size(accessor.type, accessor.number), true,
                       accessor.pointer);
}

// Every element, read by `load_element(bytes, place in the result)`.
template <class T, class Load>
std::vector<T> read_elements(const GltfDocument& document, std::size_t index, const Accessor& accessor,
                             const Load& load_element) {
    const json& value = accessor_json(document, index);
    const Run dense = dense_of(document, accessor, value);
    const std::optional<Sparse> sparse = sparse_of(document, accessor, value);
    std::vector<T> numbers(accessor.count * accessor.type.components);
    for (std::size_t i = 0; i < dense.count; ++i)
        load_element(dense.begin + i * dense.stride, numbers.data() + i * accessor.type.components);
    if (!sparse) return numbers;
    const std::vector<std::uint32_t> indices = sparse_indices(*sparse, accessor.count);
    for (std::size_t i = 0; i < indices.size(); ++i)
        load_element(sparse->values.begin + i * sparse->values.stride,
                     numbers.data() + std::size_t{indices[i]} * accessor.type.components);
    return numbers;
}

void check_components(const Accessor& accessor, unsigned components, const std::string& pointer) {
    if (accessor.type.components != components)
        fail_at(pointer, fmt::format("an accessor of {} numbers an element", components),
                fmt::format("{} at {}", accessor.type.name, accessor.pointer));
}

std::vector<std::uint32_t> read_whole(const GltfDocument& document, std::size_t index, unsigned components,
                                      const std::string& pointer) {
    const Accessor accessor = accessor_at(document, index);
    check_components(accessor, components, pointer);
    check_whole(accessor.number, accessor.pointer);
    const std::size_t size = size_of(accessor.number);
    return read_elements<std::uint32_t>(document, index, accessor, [&](const std::byte* from, std::uint32_t* to) {
        for (unsigned c = 0; c < components; ++c) to[c] = load_whole(from + c * size, accessor.number);
    });
}

}  // namespace

void check_accessors(const GltfDocument& document) {
    const std::size_t accessors = element_count(document.json, "accessors");
    for (std::size_t i = 0; i < accessors; ++i) {
        const Accessor accessor = accessor_at(document, i);
        const json& value = accessor_json(document, i);
        dense_of(document, accessor, value);
        sparse_of(document, accessor, value);
    }
}

std::size_t accessor_count(const GltfDocument& document, std::size_t accessor) {
    return accessor_at(document, accessor).count;
}

std::vector<std::uint32_t> read_indices(const GltfDocument& document, std::size_t accessor,
                                        const std::string& pointer) {
    return read_whole(document, accessor, 1, pointer);
}

std::vector<std::uint32_t> read_joints(const GltfDocument& document, std::size_t accessor, const std::string& pointer) {
    return read_whole(document, accessor, 4, pointer);
}

std::size_t element_width(const json& accessor, const std::string& pointer) {
    return type_at(accessor, pointer).components;
}

std::vector<float> read_floats(const GltfDocument& document, std::size_t index, unsigned components,
                               const std::string& pointer) {
    const Accessor accessor = accessor_at(document, index);
    check_components(accessor, components, pointer);
    const std::size_t size = size_of(accessor.number);
    const std::size_t column = element_size(accessor.type, accessor.number) / accessor.type.columns;
    const unsigned rows = components / accessor.type.columns;
    std::vector<float> numbers = read_elements<float>(document, index, accessor, [&](const std::byte* from, float* to) {
        for (unsigned c = 0; c < components; ++c)
            to[c] = load_number(from + c / rows * column + c % rows * size, accessor.number, accessor.normalized);
    });
    const auto bad = std::find_if_not(numbers.begin(), numbers.end(), [](float x) { return std::isfinite(x); });
    if (bad != numbers.end())
        fail_at(accessor.pointer, "finite numbers",
                fmt::format("{} in element {}", *bad, static_cast<std::size_t>(bad - numbers.begin()) / components));
    return numbers;
}

}  // namespace mien
