// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <set>

namespace mien {

/// Takes pictures out of a document: `images` are numbers in its array "images". Textures keep their place but lose
/// these as their source, and materials no longer name a texture that has no source left.
void drop_pictures(nlohmann::json& root, const std::set<std::size_t>& images);

}  // namespace mien
