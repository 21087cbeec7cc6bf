// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "mien/vec.hpp"

namespace mien {

/// The rows of a take or track that get a key, and its time: seconds since the first row. Rows so close that floats
/// cannot tell their times apart give way to the first of them, since key times must rise.
struct Keys {
    std::vector<std::size_t> rows;
    std::vector<float> times;
};

Keys keys_of(std::span<const double> times);

/// Appends a rotation of length 1 on the side of the one before it, so that what lies between takes the short way.
void append_rotation(std::vector<float>& values, const Quaternion& q);

void append_translation(std::vector<float>& values, const Vec3& t);

}  // namespace mien
