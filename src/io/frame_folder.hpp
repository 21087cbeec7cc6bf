// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <filesystem>
#include <string_view>

#include "mien/mesh_sequence.hpp"

namespace mien {

/// Whether name `a` comes before `b` where digits count as the number that they write: "frame_9" before "frame_10".
bool is_before_by_number(std::string_view a, std::string_view b);

/// Reads a folder of OBJ or PLY files as the rows of a head, the first as the neutral one. Throws Error naming the
/// file, expected and found.
MeshSequence read_frames(const std::filesystem::path& folder, double rate);

}  // namespace mien
