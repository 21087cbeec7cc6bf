// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "io/glb.hpp"

namespace mien {

/// Throws Error naming the JSON pointer, expected and found unless every accessor of the document says something
/// possible: known types, all bytes inside its buffer view, and no count that no bytes stand behind.
void check_accessors(const GltfDocument& document);

/// How many elements an accessor has.
std::size_t accessor_count(const GltfDocument& document, std::size_t accessor);

/// Numbers per element of an accessor, by its `type` ("VEC3": 3). `pointer` is the accessor's.
std::size_t element_width(const nlohmann::json& accessor, const std::string& pointer);

/// All numbers of an accessor of `components` numbers an element: interleaved, sparse and normalized ones too. Throws
/// Error if it has another type, or a number is not finite. `pointer` names who asks.
std::vector<float> read_floats(const GltfDocument& document, std::size_t accessor, unsigned components,
                               const std::string& pointer);

/// An accessor of single whole numbers without sign.
std::vector<std::uint32_t> read_indices(const GltfDocument& document, std::size_t accessor, const std::string& pointer);

/// An accessor of four whole numbers without sign an element: the joints of a skin.
std::vector<std::uint32_t> read_joints(const GltfDocument& document, std::size_t accessor, const std::string& pointer);

}  // namespace mien
