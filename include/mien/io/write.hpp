// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <span>
#include <string>

#include "mien/fdp.hpp"
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

/// Files of one kind, numbered from 1 and written one after the other.
struct Frames {
    std::string extension;  ///< with its dot: ".png"
    std::size_t count = 0;
    std::function<void(std::size_t row, std::ostream& out)> write;  ///< called once per row, in order
};

/// Writes a folder of frame_000001.png ... as a whole or not at all. A folder is replaced only when it holds nothing
/// but such frames.
void write_folder(const Frames& frames, const std::filesystem::path& path, const WriteOptions& options = {});

/// A file of a folder.
struct NamedFile {
    std::string name;  ///< without any folder
    std::string bytes;
};

/// Writes a folder that holds these files and nothing else, as a whole or not at all. A folder is replaced only when it
/// holds nothing but files of these names.
void write_folder(std::span<const NamedFile> files, const std::filesystem::path& path,
                  const WriteOptions& options = {});

/// Writes a take by its extension: .csv .trc.
void write(const Take& take, const std::filesystem::path& path, const WriteOptions& options = {});

/// Writes a face definition by its extension: .fat .bt .json all of it, .fdp its points and units, .fapu its units.
void write(const Fdp& fdp, const std::filesystem::path& path, const WriteOptions& options = {});

/// Writes a baked motion by its extension: .mdd, .pc2, or a folder of frame_000001.obj ... when the path has no
/// extension. A folder is replaced only when it holds nothing but such frames.
void write(const MeshSequence& sequence, const std::filesystem::path& path, const WriteOptions& options = {});

}  // namespace mien
