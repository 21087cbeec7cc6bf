// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The GLB container of glTF 2.0 (specification, chapter 4): a header of twelve bytes, a JSON chunk, then at most one
// BIN chunk. Chunks of other types may follow and are left out, as the specification asks.

#include "io/glb.hpp"

#include <bit>
#include <cstdint>
#include <cstring>
#include <fmt/format.h>
#include <limits>
#include <string>

#include "io/json_text.hpp"
#include "io/text.hpp"

#include "mien/error.hpp"

namespace mien {

namespace {

using nlohmann::json;
using Bytes = std::span<const std::byte>;

constexpr std::uint32_t magic = 0x46546C67;      // "glTF"
constexpr std::uint32_t json_type = 0x4E4F534A;  // "JSON"
constexpr std::uint32_t bin_type = 0x004E4942;   // "BIN"
constexpr std::size_t header_size = 12;
constexpr std::size_t chunk_header_size = 8;

static_assert(std::endian::native == std::endian::little, "GLB numbers are copied as they lie in memory");

std::uint32_t uint32_at(Bytes bytes, std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

[[noreturn]] void fail(std::size_t byte, std::string_view sentence) {
    throw Error(fmt::format("glb byte {}: {}", byte, sentence));
}

// The bytes that the header speaks of. What follows them is no part of the file and is left out.
Bytes checked_container(Bytes bytes) {
    if (bytes.size() < header_size)
        fail(bytes.size(), fmt::format("expected a header of {} bytes, found the end of the file", header_size));
    if (uint32_at(bytes, 0) != magic)
        fail(0, fmt::format("expected \"glTF\", found {}", shown(as_text(bytes.first(4)))));
    if (uint32_at(bytes, 4) != 2) fail(4, fmt::format("expected version 2, found {}", uint32_at(bytes, 4)));
    const std::uint32_t length = uint32_at(bytes, 8);
    if (length < header_size || length > bytes.size())
        fail(8, fmt::format("expected a length of at most the file's {} bytes, found {}", bytes.size(), length));
    return bytes.first(length);
}

struct Chunk {
    std::uint32_t type = 0;
    Bytes content;
};

// The chunk at `at`, which is moved behind it.
Chunk next_chunk(Bytes bytes, std::size_t& at) {
    if (bytes.size() - at < chunk_header_size)
        fail(at, fmt::format("expected a chunk header of {} bytes, found {}", chunk_header_size, bytes.size() - at));
    const std::size_t length = uint32_at(bytes, at);
    const std::size_t left = bytes.size() - at - chunk_header_size;
    if (length > left) fail(at, fmt::format("expected a chunk of at most {} bytes, found one of {}", left, length));
    if (length % 4 != 0) fail(at, fmt::format("expected a chunk length that is a multiple of 4, found {}", length));
    const Chunk chunk{uint32_at(bytes, at + 4), bytes.subspan(at + chunk_header_size, length)};
    at += chunk_header_size + length;
    return chunk;
}

void append_uint32(std::vector<std::byte>& bytes, std::size_t value) {
    const auto narrow = static_cast<std::uint32_t>(value);
    const auto raw = std::as_bytes(std::span(&narrow, 1));
    bytes.insert(bytes.end(), raw.begin(), raw.end());
}

std::size_t padded(std::size_t size) {
    return (size + 3) / 4 * 4;
}

void append_chunk(std::vector<std::byte>& bytes, std::uint32_t type, Bytes content, std::byte padding) {
    append_uint32(bytes, padded(content.size()));
    append_uint32(bytes, type);
    bytes.insert(bytes.end(), content.begin(), content.end());
    bytes.resize(padded(bytes.size()), padding);
}

// The JSON that the file gets: its only buffer has the size of the BIN chunk.
json with_buffer(const GltfDocument& document) {
    json root = document.json;
    if (document.binary.empty()) {
        root.erase("buffers");
    } else {
        json buffer = root.contains("buffers") && !root["buffers"].empty() ? root["buffers"][0] : json::object();
        buffer["byteLength"] = document.binary.size();
        root["buffers"] = json::array({std::move(buffer)});
    }
    return root;
}

}  // namespace

json parse_gltf_json(std::span<const std::byte> bytes) {
    check_size(bytes, "gltf");
    json root = parse_json(as_text(bytes), "gltf");
    if (!root.is_object()) throw Error(fmt::format("gltf: expected an object outside, found {}", shown_json(root)));
    return root;
}

GltfDocument parse_glb(std::span<const std::byte> bytes) {
    const Bytes container = checked_container(bytes);
    std::size_t at = header_size;
    const Chunk first = next_chunk(container, at);
    if (first.type != json_type)
        fail(header_size + 4, fmt::format("expected a JSON chunk first, found type {:#010x}", first.type));
    GltfDocument document{parse_gltf_json(first.content), {}, {}};
    for (bool second = true; at < container.size(); second = false) {
        const Chunk chunk = next_chunk(container, at);
        if (second && chunk.type == bin_type) document.binary.assign(chunk.content.begin(), chunk.content.end());
        if (!second && (chunk.type == bin_type || chunk.type == json_type))
            fail(at - chunk.content.size() - 4, "expected one JSON and one BIN chunk at the beginning, found another");
    }
    return document;
}

std::vector<std::byte> format_glb(const GltfDocument& document) {
    const std::string text = with_buffer(document).dump(-1, ' ', false, json::error_handler_t::replace);
    const std::size_t size = header_size + chunk_header_size + padded(text.size()) +
                             (document.binary.empty() ? 0 : chunk_header_size + padded(document.binary.size()));
    if (size > std::numeric_limits<std::uint32_t>::max())
        throw Error(fmt::format("glb: expected at most 4 GiB, found {} bytes to write", size));
    std::vector<std::byte> bytes;
    bytes.reserve(size);
    append_uint32(bytes, magic);
    append_uint32(bytes, 2);
    append_uint32(bytes, size);
    append_chunk(bytes, json_type, as_bytes(text), std::byte{' '});
    if (!document.binary.empty()) append_chunk(bytes, bin_type, document.binary, std::byte{0});
    return bytes;
}

}  // namespace mien
