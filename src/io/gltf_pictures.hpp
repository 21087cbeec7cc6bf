// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/glb.hpp"

#include "mien/picture.hpp"

namespace mien {

/// The pictures of a document that were asked for so far.
struct Pictures {
    explicit Pictures(const GltfDocument& from);

    const GltfDocument& document;
    std::vector<Picture> read;
    std::vector<std::string> left_out;
    std::map<std::size_t, std::optional<std::uint32_t>> numbers;  ///< of a picture of the document in `read`
    std::uint64_t pixels = 0;                                     ///< that may still be unpacked
};

/// The number in `read` of the picture behind a texture. Nothing, and a sentence in `left_out`, where there is none
/// that can be read.
std::optional<std::uint32_t> picture_of(Pictures& pictures, std::size_t texture);

}  // namespace mien
