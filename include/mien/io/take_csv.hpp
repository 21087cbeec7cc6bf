// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "mien/take.hpp"

namespace mien {

/// Our table: `time` and `<id>.x <id>.y <id>.z` columns (`_x` is read too; without z the take is planar), any order,
/// no others; commas between cells, quotes allowed. Empty, NaN and 0,0,0 cells are lost samples, and one lost
/// coordinate loses the sample. Coordinates beyond 1e15 are refused, and so are semicolons and decimal commas. A row at
/// the time of the row before takes its place; a time that goes back is refused. Throws Error naming line and column,
/// what was expected and what was found.
Take parse_take_csv(std::span<const std::byte> bytes);

/// The same file back, with enough digits to read equal numbers. Unit and head poses are not kept. A sample seen
/// exactly at the origin is written "-0,0,0", since "0,0,0" means lost. Throws Error when a name holds a tab or the end
/// of a line.
std::string format_take_csv(const Take& take);

}  // namespace mien
