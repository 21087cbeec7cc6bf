// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "mien/take.hpp"

namespace mien {

/// TRC of Motion Analysis: units mm, cm or m; blank, NaN and 0 0 0 cells are lost samples, and one lost coordinate
/// loses the sample. The marker count has to fit, the frame count may lie. A row at the time of the row before takes
/// its place; a time that goes back is refused. A file without named markers gives a take without points. Throws Error
/// naming line and column, what was expected and what was found.
Take parse_trc(std::span<const std::byte> bytes);

/// The same file back, with enough digits to read equal numbers. TRC has to state a unit: mm when the take states none.
/// Head poses are not kept. A sample seen exactly at the origin is written "-0 0 0", since "0 0 0" means lost.
/// Throws Error when a name holds a tab or the end of a line, or at another unit than mm, cm and m.
std::string format_trc(const Take& take);

}  // namespace mien
