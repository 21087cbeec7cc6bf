// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <optional>
#include <string_view>

#include "mien/vec.hpp"

namespace mien {

/// Where a point lies on a face of ordinary proportions: in eye distances from the middle between the eyes, +x the
/// subject's left, +y up, +z forward. Nothing for ids that it does not know, and for ears, hair, teeth and tongue.
std::optional<Vec3> generic_position(std::string_view id);

}  // namespace mien
