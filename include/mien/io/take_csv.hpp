// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "mien/take.hpp"

namespace mien {

/// Our table: `time` and `<id>.x <id>.y <id>.z` columns (`_x` is read too; without z the take is planar); empty or NaN
/// cells are lost samples. Throws Error naming line and column, what was expected and what was found.
Take parse_take_csv(std::span<const std::byte> bytes);

/// The same file back, with enough digits to read equal numbers.
std::string format_take_csv(const Take& take);

}  // namespace mien
