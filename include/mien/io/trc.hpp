// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "mien/take.hpp"

namespace mien {

/// TRC of Motion Analysis: units mm, cm or m; blank, NaN and 0 0 0 cells are lost samples.
/// Throws Error naming line and column, what was expected and what was found.
Take parse_trc(std::span<const std::byte> bytes);

/// The same file back, with enough digits to read equal numbers.
std::string format_trc(const Take& take);

}  // namespace mien
