// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "mien/fap_interpolation.hpp"

namespace mien {

/// An interpolation table from JSON: {"links": [{"from": [3], "to": [{"fap": 5, "numerator": [...], "denominator":
/// [...]}]}]}, a term being {"coefficient": -0.5, "exponents": [1], "impulse": {"fap": 3, "value": 0}} with the last
/// two optional, as is the denominator. The order of the links is their priority. Keys that start with `_` are ignored.
/// The form is ours: the standard has the table as a node of a scene (docs/mpeg4.md). Throws Error naming the JSON
/// pointer: another key, a key given twice, what `interpolated_faps` refuses, no links.
FapInterpolation parse_fit(std::span<const std::byte> bytes);

/// The same file back: it reads back as an equal table.
std::string format_fit(const FapInterpolation& fit);

}  // namespace mien
