// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "mien/algorithms/surface_distance.hpp"
#include "mien/algorithms/weld.hpp"
#include "mien/face.hpp"

namespace mien {

/// A slit of the skin: the edges of an upper and a lower lid, or of the lips.
struct Margin {
    enum class Kind { left_lids, right_lids, lips };
    Kind kind = Kind::lips;
    Vec3 up;                            ///< the direction in which it opens, of length 1
    std::vector<std::uint32_t> points;  ///< of the face, in the middle of its two edges: upper, lower
    /// Places from one corner to the other, both corners included: shortest paths along edges through the feature
    /// points of each edge. They share the corners and perhaps a little more beside them.
    std::vector<std::uint32_t> upper, lower;
};

/// The slits whose corners and middles the face's points name. A slit whose edges are one path for the most part is
/// none: the mouth of a head whose lips were modelled as one.
std::vector<Margin> find_margins(const Face& face, const Weld& weld, const EdgeGraph& graph);

/// A place on the edge of a slit, between two places next to each other.
struct OnEdge {
    std::uint32_t from = 0, to = 0;
    double share = 0;  ///< 0 at `from`, 1 at `to`
};

/// Places opposite each other on the two edges, at even steps of the chord from corner to corner at rest.
struct Opposite {
    OnEdge upper, lower;
};
std::vector<Opposite> opposite_places(const Margin& margin, const Face& face, const Weld& weld, std::size_t count);

/// How far a slit is open at even steps of the chord between its corners, once its places have moved to where `at`
/// says: upper less lower edge along `margin.up`, both where they lie on the same line across the chord then.
std::vector<double> openings(const Margin& margin, const std::function<Vec3(std::uint32_t place)>& at,
                             std::size_t count);

/// Where along the chord between the corners (0 to 1, clamped) each place of an edge lies.
std::vector<double> along_chord(const std::vector<std::uint32_t>& edge, const Face& face, const Weld& weld);

/// The place of an edge at `along` of the chord; `chord`: one share per place, as along_chord gives them.
OnEdge on_edge(const std::vector<std::uint32_t>& edge, const std::vector<double>& chord, double along);

/// What `at` (a value per place) is there.
Vec3 value_on(const OnEdge& place, const std::function<Vec3(std::uint32_t place)>& at);

}  // namespace mien
