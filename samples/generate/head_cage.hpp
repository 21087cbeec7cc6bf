// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <vector>

#include "cage.hpp"

namespace mien::samples {

/// A loop of cage points with the texture coordinates it has seen from its inside.
struct Loop {
    std::vector<std::uint32_t> points;
    std::vector<Uv> uvs;
    bool closed = true;  ///< false for the half loops round the mouth, whose ends lie at the midline
};

/// A loop to be made inside another.
struct Inset {
    std::vector<Vec3> points;
    std::vector<Uv> uvs;
    int count = 1;  ///< how many quads wide the strip between the loops will be
    Region region = Region::skin;
};

/// Joins a new loop inside `outer` by a strip of quads.
Loop add_strip(Cage& cage, const Loop& outer, const Inset& inset);

std::vector<Uv> shrunk(const std::vector<Uv>& uvs, const Uv& centre, double su, double sv);

void add_eye(Cage& cage, const Loop& orbit);
void add_mouth(Cage& cage, const Loop& surround);
void add_ear(Cage& cage, const Loop& root);
void add_nostril(Cage& cage, const Loop& rim);

/// The left half of the head's skin.
Cage head_cage();

}  // namespace mien::samples
