// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <optional>
#include <string_view>

#include "mien/vec.hpp"

namespace mien {

/// How the feature point `id` of an ordinary face moves in the ARKit expression `shape` ("jawOpen") at full strength,
/// in eye distances and the face's own axes. Zero where it keeps still, for points that are not known and for
/// `tongueOut`.
Vec3 arkit_motion(std::string_view shape, std::string_view id);

/// Where that point lies at rest, in eye distances from the middle of the eyes; nothing for points that are not known.
std::optional<Vec3> arkit_neutral(std::string_view id);

}  // namespace mien
