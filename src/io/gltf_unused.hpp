// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <vector>

#include "io/glb.hpp"

namespace mien {

/// Drops the accessors and buffer views that nothing refers to, with their bytes, and renumbers what is left. Leaves
/// all as it is when the document uses extensions that may refer to them in ways unknown here.
void drop_unused_numbers(GltfDocument& document);
/// The same without the bytes, which stay where they are.
void drop_unused_numbers(nlohmann::json& root);

/// For each buffer view whether anything refers to it that is of use itself; of an accessor that nothing refers to
/// nothing is. All of them when the document uses extensions that may refer to them in ways unknown here.
std::vector<bool> used_views(nlohmann::json& root);

}  // namespace mien
