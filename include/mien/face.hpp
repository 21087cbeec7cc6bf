// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mien/mesh.hpp"

namespace mien {

/// The axes along which a feature point moves. A point constrained along an axis behaves there as an ordinary vertex,
/// carried by the points near it (Kshirsagar et al., section 2).
struct Axes {
    bool x = true, y = true, z = true;
    friend constexpr bool operator==(const Axes&, const Axes&) = default;
};

/// A named place on a face that carries motion: an MPEG-4 feature definition point ("8.4") or a user's own.
struct FeaturePoint {
    std::string id;
    std::uint32_t vertex = 0;  ///< index into the mesh's positions
    Vec3 position;             ///< neutral position, in the mesh's unit
    Axes moves;
    double snapped = 0;  ///< how far the given position was moved to reach that vertex; 0 when a vertex was given
};

/// A neutral head with its feature points: what is rigged, measured and retargeted to.
struct Face {
    Mesh mesh;
    std::vector<FeaturePoint> points;  ///< ids are unique, no two share a position
};

/// Index of the point called `id`, or nothing.
std::optional<std::size_t> find_point(std::span<const FeaturePoint> points, std::string_view id);

/// The same head with only the named points, in the order of the face. Unknown ids are ignored.
Face with_points(const Face& face, std::span<const std::string> ids);

/// Distance between the two eye centres, each the middle of its corner points (3.7 and 3.11, 3.8 and 3.12): the measure
/// of length that rigs and retargets use. Where corners are missing it is estimated from the pupils (3.5, 3.6), the lid
/// points, or at last as 0.6 of the root-mean-square radius of all the points. Zero only for a single point.
double eye_distance(std::span<const FeaturePoint> points);

enum class Side { left, middle, right };  ///< of the subject, not of the one who looks at it

/// One of the 84 feature points that MPEG-4 defines.
struct StandardPoint {
    std::string_view id;
    Side side = Side::middle;
    std::string_view mirror;  ///< the point on the other side of the face; itself on the midline
    std::string_view place;   ///< where it is, in words
};

/// All of them, in the order of the standard.
std::span<const StandardPoint> standard_points();

/// The MPEG-4 point on the other side of the face; the point itself on the midline; empty for ids of no MPEG-4 point.
std::string_view mirror_point(std::string_view id);

}  // namespace mien
