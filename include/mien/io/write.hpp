// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>

#include "mien/mesh_sequence.hpp"
#include "mien/take.hpp"

namespace mien {

struct WriteOptions {
    bool overwrite = false;  ///< replace a file that is there
    /// Called now and then with rows written and rows in all.
    std::function<void(std::size_t done, std::size_t all)> progress = {};
};

/// Writes bytes so that the path holds the old bytes or the new ones, never a part: to a temporary file beside it,
/// which is then renamed. Throws Error (Kind::access) and leaves nothing behind.
void write_file(const std::filesystem::path& path, std::span<const std::byte> bytes, const WriteOptions& options = {});

/// Writes a take by its extension: .csv .trc.
void write(const Take& take, const std::filesystem::path& path, const WriteOptions& options = {});

/// Writes a baked motion by its extension: .mdd, .pc2, or a folder of frame_000001.obj ... when the path has no
/// extension. A folder is replaced only when it holds nothing but such frames.
void write(const MeshSequence& sequence, const std::filesystem::path& path, const WriteOptions& options = {});

}  // namespace mien
