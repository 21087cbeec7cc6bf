// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "mien/algorithms/weld.hpp"
#include "mien/face.hpp"

namespace mien {

/// Stands for a place without a counterpart.
inline constexpr std::uint32_t no_partner = ~0U;

/// The plane that parts a head in two alike halves, and where each place of its surface is found on the other half.
struct MirrorMap {
    Vec3 across;                         ///< from one half to the other, of length 1
    double offset = 0;                   ///< of the plane: points p on it have dot(across, p) = offset
    std::vector<std::uint32_t> partner;  ///< one per place: itself on the plane, no_partner where there is none
};

/// Nothing when the head is not symmetric: when the face's points come in fewer than two pairs, or when more than one
/// place of the skin in a thousand has no counterpart within 1e-3 of the eye distance.
std::optional<MirrorMap> mirror_map(const Face& face, const Weld& weld);

/// A displacement as the mirror shows it.
inline Vec3 mirrored(const MirrorMap& map, const Vec3& d) {
    return d - (2 * dot(map.across, d)) * map.across;
}

}  // namespace mien
