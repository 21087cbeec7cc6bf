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

/// Joins a new loop inside `outer` by a strip of quads that will be `count` quads wide.
Loop add_strip(Cage& cage, const Loop& outer, const std::vector<Vec3>& points, const std::vector<Uv>& uvs, int count);

std::vector<Uv> shrunk(const std::vector<Uv>& uvs, const Uv& centre, double su, double sv);

void add_eye(Cage& cage, const Loop& orbit);
void add_mouth(Cage& cage, const Loop& surround);
void add_ear(Cage& cage, const Loop& root);
void add_nostril(Cage& cage, const Loop& rim);

/// The left half of the head's skin.
Cage head_cage();

}  // namespace mien::samples
