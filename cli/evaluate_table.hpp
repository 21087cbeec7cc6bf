// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <span>
#include <string>

#include "report.hpp"

#include "mien/algorithms/evaluate.hpp"

namespace mien::cli {

/// Everything that was measured, for programs.
Report as_report(const Evaluation& evaluation);

/// Tables for a terminal: the shapes by what was measured; several methods side by side by their error. `whole`: also
/// the regions of every shape.
std::string as_table(std::span<const Evaluation> evaluations, bool whole);

}  // namespace mien::cli
