// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "io/rig_arrays.hpp"

#include <bit>
#include <cstdint>
#include <fmt/format.h>

#include "io/gltf_json.hpp"

namespace mien {

namespace {

using nlohmann::json;
using Bytes = std::span<const std::byte>;

static_assert(std::endian::native == std::endian::little, "numbers are copied as they lie in memory");

// The bytes of view `index`, which `pointer` refers to.
Bytes view_bytes(const GltfDocument& document, std::uint64_t index, const std::string& pointer) {
    const json& views = array_member(document.json, "bufferViews", "");
    if (index >= views.size())
        fail_at(pointer, fmt::format("one of {} buffer views", views.size()), fmt::format("number {}", index));
    const std::string place = fmt::format("/bufferViews/{}", index);
    const json& view = views[index];
    if (whole_member(view, "buffer", place) != 0) fail_found(place + "/buffer", "0", view.at("buffer"));
    if (view.contains("byteStride")) fail_found(place + "/byteStride", "none", view.at("byteStride"));
    const std::uint64_t size = document.binary.size();
    const std::uint64_t offset = whole_member(view, "byteOffset", place, 0);
    if (offset > size) fail_at(place + "/byteOffset", fmt::format("at most {}", size), fmt::format("{}", offset));
    const std::uint64_t length = whole_member(view, "byteLength", place);
    if (length > size - offset)
        fail_at(place + "/byteLength", fmt::format("at most {}", size - offset), fmt::format("{}", length));
    return Bytes(document.binary).subspan(offset, length);
}

}  // namespace

Bytes array_bytes(const GltfDocument& document, const json& owner, const char* name, const std::string& pointer,
                  std::size_t element_size) {
    const std::string place = pointer + '/' + name;
    const json* array = find_member(owner, name, pointer);
    if (array == nullptr) fail_at(place, "an object with bufferView and count", "none");
    const std::uint64_t count = whole_member(*array, "count", place);
    if (count == 0) return {};
    const Bytes bytes = view_bytes(document, whole_member(*array, "bufferView", place), place + "/bufferView");
    // A count is at most 2^53, so this product does not overflow.
    if (count * element_size != bytes.size())
        fail_at(place + "/count",
                fmt::format("as many as a view of {} bytes has, {} bytes each", bytes.size(), element_size),
                fmt::format("{}", count));
    return bytes;
}

}  // namespace mien
