// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace mien {

/// The rows of a take or track that get a key, and its time: seconds since the first row. Rows so close that floats
/// cannot tell their times apart give way to the first of them, since key times must rise.
struct Keys {
    std::vector<std::size_t> rows;
    std::vector<float> times;
};

Keys keys_of(std::span<const double> times);

}  // namespace mien
