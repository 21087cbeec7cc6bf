// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// A GLB states its lengths, so that most changes to its bytes break the container and reach nothing behind it. This
// mutator, of which libFuzzer takes notice by its name, changes the JSON or the binary and states the lengths anew; one
// change in eight goes to the container itself.

#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <vector>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace mien::fuzz {

constexpr std::size_t header_size = 12, chunk_header_size = 8;

/// The content of the two chunks of a GLB.
struct Glb {
    std::array<std::vector<std::uint8_t>, 2> chunks;
};

inline std::uint32_t length_at(const std::uint8_t* data) {
    std::uint32_t length = 0;
    std::memcpy(&length, data, sizeof length);
    return length;
}

/// The chunks, if the container is whole.
inline std::optional<Glb> split_glb(const std::uint8_t* data, std::size_t size) {
    if (size < header_size || std::memcmp(data, "glTF", 4) != 0) return std::nullopt;
    Glb glb;
    std::size_t at = header_size;
    for (std::vector<std::uint8_t>& chunk : glb.chunks) {
        if (at == size) break;
        if (size - at < chunk_header_size) return std::nullopt;
        const std::uint32_t length = length_at(data + at);
        at += chunk_header_size;
        if (length > size - at) return std::nullopt;
        chunk.assign(data + at, data + at + length);
        at += length;
    }
    if (at != size) return std::nullopt;
    return glb;
}

inline void append_word(std::vector<std::uint8_t>& bytes, std::uint32_t word) {
    for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::uint8_t>(word >> shift));
}

inline std::vector<std::uint8_t> join_glb(Glb glb) {
    constexpr std::array<std::uint32_t, 2> kinds{0x4E4F534A, 0x004E4942};
    constexpr std::array<std::uint8_t, 2> padding{' ', 0};
    std::vector<std::uint8_t> bytes{'g', 'l', 'T', 'F', 2, 0, 0, 0, 0, 0, 0, 0};
    for (std::size_t c = 0; c < 2; ++c) {
        std::vector<std::uint8_t>& chunk = glb.chunks[c];
        if (c == 1 && chunk.empty()) break;
        chunk.resize((chunk.size() + 3) / 4 * 4, padding[c]);
        append_word(bytes, static_cast<std::uint32_t>(chunk.size()));
        append_word(bytes, kinds[c]);
        bytes.insert(bytes.end(), chunk.begin(), chunk.end());
    }
    const auto size = static_cast<std::uint32_t>(bytes.size());
    std::memcpy(bytes.data() + 8, &size, sizeof size);
    return bytes;
}

inline std::size_t mutate_glb(std::uint8_t* data, std::size_t size, std::size_t max_size, unsigned seed) {
    constexpr std::size_t most_padding = 2 * 3;
    std::optional<Glb> glb = split_glb(data, size);
    if (!glb || seed % 8 == 0 || size + chunk_header_size + most_padding > max_size)
        return LLVMFuzzerMutate(data, size, max_size);
    std::vector<std::uint8_t>& chunk = glb->chunks[seed % 8 < 6 ? 0 : 1];
    const std::size_t before = chunk.size();
    chunk.resize(before + max_size - size - chunk_header_size - most_padding);
    chunk.resize(LLVMFuzzerMutate(chunk.data(), before, chunk.size()));
    const std::vector<std::uint8_t> bytes = join_glb(*std::move(glb));
    std::copy(bytes.begin(), bytes.end(), data);
    return bytes.size();
}

}  // namespace mien::fuzz

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed) {
    return mien::fuzz::mutate_glb(data, size, max_size, seed);
}
