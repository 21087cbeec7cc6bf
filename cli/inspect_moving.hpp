// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <filesystem>

#include "verb.hpp"

#include "mien/mesh.hpp"

namespace mien::cli {

/// Whether a file is a point cache, by its extension.
bool is_point_cache(const std::filesystem::path& file);

/// Tells the report what a point cache or a folder of frames holds.
void inspect_point_cache(const std::filesystem::path& file, Report& report);
Mesh inspect_frames(const std::filesystem::path& folder, Report& report);

/// Tells the report what animations the file has and what each moves; nothing where it has none or cannot have any.
void inspect_animations(const std::filesystem::path& file, Report& report);

}  // namespace mien::cli
