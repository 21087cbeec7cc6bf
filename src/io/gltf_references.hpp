// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <nlohmann/json.hpp>

namespace mien {

/// Throws Error naming the JSON pointer, expected and found unless everything that the core of glTF 2.0 (and the
/// extensions that are read) refers to by number is there.
void check_references(const nlohmann::json& root);

}  // namespace mien
