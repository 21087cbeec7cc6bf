// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/glb.hpp"

#include "mien/vec.hpp"

namespace mien {

/// What a buffer view is bound to when it is drawn (glTF's bufferView.target).
enum class BufferTarget : std::uint16_t {
    none = 0,          ///< key frames, inverse bind matrices, sparse parts
    vertices = 34962,  ///< ARRAY_BUFFER
    indices = 34963,   ///< ELEMENT_ARRAY_BUFFER
};

/// Numbers per element of an accessor.
enum class Elements : std::uint8_t { scalar = 1, vec2 = 2, vec3 = 3, vec4 = 4, mat4 = 16 };

/// Whether an accessor says the least and the greatest of each of its components, as positions and key times must.
enum class Bounds : std::uint8_t { left_out, given };

/// Every function appends at the end of `document` and returns the index of what it appended. Two of them never belong
/// into one list of arguments: compilers evaluate those in different orders.

/// Appends an object to the array `array` of the document ("nodes"), which is made when missing.
std::size_t append_object(GltfDocument& document, const std::string& array, nlohmann::json object);

/// Appends bytes to the buffer, at a multiple of four, and a view of them.
std::size_t append_view(GltfDocument& document, std::span<const std::byte> bytes, BufferTarget target);

/// Appends an accessor with its view. `values`: one element or more, component by component; for `vec3` positions,
/// x y z x y z. Bytes and shorts of vertices must come in elements of four bytes or a multiple.
std::size_t append_floats(GltfDocument& document, std::span<const float> values, Elements elements, BufferTarget target,
                          Bounds bounds = Bounds::left_out);
std::size_t append_vectors(GltfDocument& document, std::span<const Vec3f> values, BufferTarget target,
                           Bounds bounds = Bounds::left_out);
std::size_t append_bytes(GltfDocument& document, std::span<const std::uint8_t> values, Elements elements,
                         BufferTarget target);
std::size_t append_shorts(GltfDocument& document, std::span<const std::uint16_t> values, Elements elements,
                          BufferTarget target);
std::size_t append_ints(GltfDocument& document, std::span<const std::uint32_t> values, Elements elements,
                        BufferTarget target);

/// Appends the vertex numbers of a primitive: 16 bits each where all of them fit, otherwise 32.
std::size_t append_indices(GltfDocument& document, std::span<const std::uint32_t> indices);

}  // namespace mien
