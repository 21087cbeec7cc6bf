// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace mien::cli {

/// What a verb did and lost, in the order it happened: printed as lines for people, as one object for programs.
using Report = nlohmann::ordered_json;

/// Lines "key: value", nested objects indented, lists on one line; long lists are cut unless `whole`.
std::string as_lines(const Report& report, bool whole);

/// The whole report as indented JSON text; text that is no UTF-8 is replaced.
std::string as_json(const Report& report);

/// Adds a sentence to the report's "warnings".
void warn(Report& report, const std::string& sentence);

}  // namespace mien::cli
