// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include "io/glb.hpp"

namespace mien {

/// Drops the accessors and buffer views that nothing refers to, with their bytes, and renumbers what is left. Leaves
/// all as it is when the document uses extensions that may refer to them in ways unknown here.
void drop_unused_numbers(GltfDocument& document);

}  // namespace mien
