// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// What the readers of face definitions share: points, and units by their definition.

#pragma once

#include <array>
#include <string_view>

#include "mien/fdp.hpp"

namespace mien {

/// A distance of `Fapu` and the name that the standard has for it.
struct NamedUnit {
    std::string_view name;
    double Fapu::*distance;
};
inline constexpr std::array<NamedUnit, 5> named_units{
    {{"IRISD0", &Fapu::irisd}, {"ES0", &Fapu::es}, {"ENS0", &Fapu::ens}, {"MNS0", &Fapu::mns}, {"MW0", &Fapu::mw}}};

/// What a unit has to be above so that displacements divide by it.
inline constexpr double least_unit = 1e-30;

/// The units that the points tell by their definition in the standard; 0 for the others.
Fapu units_of_points(std::span<const FeaturePoint> points);

/// Puts points on the nearest vertices of the mesh; they keep their positions.
void name_vertices(std::vector<FeaturePoint>& points, const Mesh& mesh);

}  // namespace mien
