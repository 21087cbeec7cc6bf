// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include "algorithms/shape_field.hpp"

#include "mien/algorithms/weld.hpp"
#include "mien/face.hpp"

namespace mien {

/// The places of the tongue: of the parts that are called so, or of the island that 6.1 (its tip) lies on.
std::vector<std::uint32_t> tongue_places(const Face& face, const Weld& weld);

/// Moves the tongue out between the lips: its tip 0.42 of an eye distance beyond them and a little down, its root
/// not. `turn`: how the face lies, `lips`: between them at rest.
void put_out_tongue(const Face& face, const Weld& weld, const std::vector<std::uint32_t>& places,
                    const Quaternion& turn, const Vec3& lips, ShapeField& field);

}  // namespace mien
