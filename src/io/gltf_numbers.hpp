// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <vector>

#include "io/glb.hpp"

namespace mien {

/// The numbers of an accessor of a document as a reader left it (uncompressed, one buffer), element by element:
/// normalised integers as fractions, sparse parts put in. Throws Error where it points out of the buffer.
std::vector<double> accessor_numbers(const GltfDocument& document, std::size_t accessor);

/// Numbers per element of an accessor's `type` ("VEC3": 3). Throws Error for any other text.
std::size_t element_width(const nlohmann::json& accessor);

/// Drops the accessors and buffer views that nothing refers to, with their bytes, and renumbers what is left. Leaves
/// all as it is when the document uses extensions that may refer to them in ways unknown here.
void drop_unused_numbers(GltfDocument& document);

}  // namespace mien
