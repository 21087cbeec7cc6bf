// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// EXT_meshopt_compression: a buffer view that names compressed bytes, a mode and perhaps a filter. The decoder is safe
// on any bytes but gives garbage for garbage, so what comes out is checked again by whoever reads the accessors.

#include <cstdint>
#include <fmt/format.h>
#include <meshoptimizer.h>
#include <string>

#include "io/gltf_decompress.hpp"
#include "io/gltf_json.hpp"

namespace mien {

namespace {

using nlohmann::json;

// No mode of the codec makes one byte into more than 64: 256 elements of the same value take four bytes per byte of
// one.
constexpr std::uint64_t largest_growth = 128;

struct Compressed {
    std::span<const std::byte> bytes;
    std::size_t count = 0, stride = 0;
    std::string mode, filter;
};

void check_stride(const Compressed& view, const std::string& pointer) {
    const bool right = view.mode == "ATTRIBUTES" ? view.stride % 4 == 0 && view.stride > 0 && view.stride <= 256
                                                 : view.stride == 2 || view.stride == 4;
    if (!right)
        fail_at(pointer + "/byteStride", view.mode == "ATTRIBUTES" ? "a multiple of 4 from 4 to 256" : "2 or 4",
                std::to_string(view.stride));
    if (view.mode == "TRIANGLES" && view.count % 3 != 0)
        fail_at(pointer + "/count", "a multiple of 3", std::to_string(view.count));
}

void check_filter(const Compressed& view, const std::string& pointer) {
    const bool right =
        view.filter == "NONE" || (view.mode == "ATTRIBUTES" &&
                                  ((view.filter == "OCTAHEDRAL" && (view.stride == 4 || view.stride == 8)) ||
                                   (view.filter == "QUATERNION" && view.stride == 8) || view.filter == "EXPONENTIAL"));
    if (!right)
        fail_at(pointer + "/filter", "a filter that goes with the mode and the stride", '"' + view.filter + '"');
}

Compressed read_extension(const GltfDocument& document, const json& extension, const std::string& pointer) {
    const std::uint64_t offset = whole_member(extension, "byteOffset", pointer, 0);
    const std::uint64_t length = whole_member(extension, "byteLength", pointer);
    if (whole_member(extension, "buffer", pointer) != 0 || offset > document.binary.size() ||
        length > document.binary.size() - offset)
        fail_at(pointer, fmt::format("bytes inside the buffer's {}", document.binary.size()),
                fmt::format("{} bytes from {} on", length, offset));
    Compressed view;
    view.bytes = std::span(document.binary).subspan(offset, length);
    view.mode = text_member(extension, "mode", pointer);
    view.filter = text_member(extension, "filter", pointer);
    if (view.filter.empty()) view.filter = "NONE";
    if (view.mode != "ATTRIBUTES" && view.mode != "TRIANGLES" && view.mode != "INDICES")
        fail_at(pointer + "/mode", "ATTRIBUTES, TRIANGLES or INDICES", '"' + view.mode + '"');
    view.count = whole_member(extension, "count", pointer);
    view.stride = whole_member(extension, "byteStride", pointer);
    check_stride(view, pointer);
    check_filter(view, pointer);
    if (view.count == 0 || view.count > largest_growth * length / view.stride)
        fail_at(pointer + "/count", fmt::format("what {} compressed bytes can hold", length),
                fmt::format("{} elements of {} bytes", view.count, view.stride));
    return view;
}

std::vector<std::byte> decode(const Compressed& view, const std::string& pointer) {
    std::vector<std::byte> plain(view.count * view.stride);
    const auto* bytes = reinterpret_cast<const unsigned char*>(view.bytes.data());
    const int failure =
        view.mode == "ATTRIBUTES"
            ? meshopt_decodeVertexBuffer(plain.data(), view.count, view.stride, bytes, view.bytes.size())
        : view.mode == "TRIANGLES"
            ? meshopt_decodeIndexBuffer(plain.data(), view.count, view.stride, bytes, view.bytes.size())
            : meshopt_decodeIndexSequence(plain.data(), view.count, view.stride, bytes, view.bytes.size());
    if (failure != 0)
        fail_at(pointer, fmt::format("{} compressed elements of {} bytes", view.count, view.stride),
                fmt::format("{} bytes that are no such thing (decoder {})", view.bytes.size(), failure));
    if (view.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(plain.data(), view.count, view.stride);
    if (view.filter == "QUATERNION") meshopt_decodeFilterQuat(plain.data(), view.count, view.stride);
    if (view.filter == "EXPONENTIAL") meshopt_decodeFilterExp(plain.data(), view.count, view.stride);
    return plain;
}

}  // namespace

bool decompress_meshopt(GltfDocument& document, DecodeBudget& budget) {
    bool any = false;
    for (std::size_t i = 0; i < element_count(document.json, "bufferViews"); ++i) {
        json& view = document.json["bufferViews"][i];
        const std::string pointer = fmt::format("/bufferViews/{}", i);
        if (!object_member(view, "extensions", pointer).contains("EXT_meshopt_compression")) continue;
        const std::string place = pointer + "/extensions/EXT_meshopt_compression";
        const json extension = view["extensions"]["EXT_meshopt_compression"];
        if (!extension.is_object()) fail_found(place, "an object", extension);
        const Compressed compressed = read_extension(document, extension, place);
        spend(budget, compressed.count * compressed.stride, place);
        const std::vector<std::byte> plain = decode(compressed, place);
        view["buffer"] = 0;
        view["byteOffset"] = append_bytes(document, plain);
        view["byteLength"] = plain.size();
        remove_extension(view, "EXT_meshopt_compression");
        any = true;
    }
    return any;
}

}  // namespace mien
