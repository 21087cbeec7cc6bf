// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Atomic writing: a file or folder is filled under a temporary name beside its target, forced to the disk and renamed
// at the end, so a reader finds the old content or the new and never a part.

#pragma once

#include <filesystem>
#include <string_view>

namespace mien {

/// Throws Error (Kind::access): "PATH: cannot write: WHY", or why by the number of a system error.
[[noreturn]] void cannot_write(const std::filesystem::path& path, std::string_view why);
[[noreturn]] void cannot_write(const std::filesystem::path& path, int error);

/// Whether there is anything by that name, a link that leads nowhere included.
bool is_there(const std::filesystem::path& path);

/// Throws Error when there is something by that name and overwriting it was not asked for.
void refuse_existing(const std::filesystem::path& path, bool overwrite);

/// Forces a file or a folder to the disk; the error names the target that it is for.
void synchronize(const std::filesystem::path& path, const std::filesystem::path& target);

/// A name beside the target that no other file has; what is there is gone with this object unless it was moved to its
/// target.
class Temporary {
public:
    Temporary(const std::filesystem::path& target, bool overwrite);
    Temporary(const Temporary&) = delete;
    Temporary& operator=(const Temporary&) = delete;
    ~Temporary();

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

    /// Renames it. Without `overwrite` the rename itself refuses a target that came to be in the meantime (renameat2
    /// of Linux; elsewhere the check beforehand has to do).
    void move_to_target() const;

private:
    std::filesystem::path target_, path_;
    bool overwrite_;
};

}  // namespace mien
