// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Accessors of glTF 2.0 (specification, 3.6.2) as numbers. Matrices of bytes and shorts, whose columns are padded, are
// no vertex attributes and are not met here.

#include "io/gltf_numbers.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fmt/format.h>
#include <limits>
#include <string>

#include "mien/error.hpp"

namespace mien {

namespace {

using nlohmann::json;

template <class T>
double number_at(const std::byte* at, bool normalized) {
    T value{};
    std::memcpy(&value, at, sizeof value);
    if (!normalized || !std::numeric_limits<T>::is_integer) return static_cast<double>(value);
    return std::max(static_cast<double>(value) / static_cast<double>(std::numeric_limits<T>::max()), -1.0);
}

using Reader = double (*)(const std::byte*, bool);

struct Component {
    std::size_t size;
    Reader read;
};

Component component_of(std::uint64_t type) {
    switch (type) {
        case 5120:
            return {1, number_at<std::int8_t>};
        case 5121:
            return {1, number_at<std::uint8_t>};
        case 5122:
            return {2, number_at<std::int16_t>};
        case 5123:
            return {2, number_at<std::uint16_t>};
        case 5125:
            return {4, number_at<std::uint32_t>};
        case 5126:
            return {4, number_at<float>};
        default:
            throw Error(fmt::format("gltf: expected a componentType from 5120 to 5126, found {}", type));
    }
}

// Where elements lie in the buffer.
struct Run {
    const std::byte* first;
    std::size_t stride;
};

// `place` has bufferView and byteOffset: an accessor or a sparse part of one.
Run run_of(const GltfDocument& document, const json& place, std::uint64_t count, std::size_t element) {
    const json& view = document.json.at("bufferViews").at(place.at("bufferView").get<std::size_t>());
    const auto stride = view.value("byteStride", static_cast<std::uint64_t>(element));
    const auto from = view.value("byteOffset", std::uint64_t{0}), skip = place.value("byteOffset", std::uint64_t{0});
    const std::uint64_t size = document.binary.size();
    const bool fits = from <= size && skip <= size - from && stride > 0 && element <= size - from - skip &&
                      count - 1 <= (size - from - skip - element) / stride;
    if (!fits) throw Error(fmt::format("gltf: expected an accessor within {} bytes, found one beyond", size));
    return {document.binary.data() + from + skip, static_cast<std::size_t>(stride)};
}

void put_sparse(const GltfDocument& document, const json& accessor, std::size_t width, std::vector<double>& numbers) {
    const json& sparse = accessor.at("sparse");
    const auto count = sparse.at("count").get<std::uint64_t>();
    if (count == 0) return;
    const Component index = component_of(sparse.at("indices").at("componentType").get<std::uint64_t>());
    const Component value = component_of(accessor.at("componentType").get<std::uint64_t>());
    const Run indices = run_of(document, sparse.at("indices"), count, index.size);
    const Run values = run_of(document, sparse.at("values"), count, value.size * width);
    const bool normalized = accessor.value("normalized", false);
    for (std::size_t i = 0; i < count; ++i) {
        const double at = index.read(indices.first + i * indices.stride, false);
        if (!(at >= 0 && at * static_cast<double>(width) < static_cast<double>(numbers.size())))
            throw Error(
                fmt::format("gltf: expected sparse indices within {} elements, found {}", numbers.size() / width, at));
        for (std::size_t c = 0; c < width; ++c)
            numbers[static_cast<std::size_t>(at) * width + c] =
                value.read(values.first + i * values.stride + c * value.size, normalized);
    }
}

}  // namespace

std::size_t element_width(const json& accessor) {
    const auto type = accessor.at("type").get<std::string>();
    if (type == "SCALAR") return 1;
    if (type == "VEC2") return 2;
    if (type == "VEC3") return 3;
    if (type == "VEC4" || type == "MAT2") return 4;
    if (type == "MAT3") return 9;
    if (type == "MAT4") return 16;
    throw Error(fmt::format("gltf: expected an accessor of SCALAR to MAT4, found {}", type));
}

std::vector<double> accessor_numbers(const GltfDocument& document, std::size_t index) {
    const json& accessor = document.json.at("accessors").at(index);
    const std::size_t width = element_width(accessor);
    const Component component = component_of(accessor.at("componentType").get<std::uint64_t>());
    const auto count = accessor.at("count").get<std::uint64_t>();
    if (count == 0) return {};
    if (count > std::numeric_limits<std::uint32_t>::max())
        throw Error(fmt::format("gltf: expected at most 2^32 elements in an accessor, found {}", count));
    std::vector<double> numbers;
    if (accessor.contains("bufferView")) {
        const Run run = run_of(document, accessor, count, component.size * width);
        numbers.resize(count * width);
        const bool normalized = accessor.value("normalized", false);
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t c = 0; c < width; ++c)
                numbers[i * width + c] = component.read(run.first + i * run.stride + c * component.size, normalized);
    } else {
        numbers.resize(count * width);
    }
    if (accessor.contains("sparse")) put_sparse(document, accessor, width, numbers);
    return numbers;
}

}  // namespace mien
