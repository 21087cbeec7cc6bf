// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "io/temporary.hpp"

#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <fmt/format.h>
#include <system_error>
#include <unistd.h>

#include "mien/error.hpp"

namespace mien {

namespace fs = std::filesystem;

namespace {

fs::path free_name(const fs::path& target) {
    for (int n = 0;; ++n) {
        fs::path name = target;
        name += fmt::format(".part-{}-{}", getpid(), n);
        if (!is_there(name)) return name;
    }
}

}  // namespace

void cannot_write(const fs::path& path, std::string_view why) {
    throw Error(fmt::format("{}: cannot write: {}", path.string(), why), Error::Kind::access);
}

void cannot_write(const fs::path& path, int error) {
    cannot_write(path, std::generic_category().message(error));
}

bool is_there(const fs::path& path) {
    std::error_code error;
    return fs::exists(fs::symlink_status(path, error));
}

void refuse_existing(const fs::path& path, bool overwrite) {
    if (!overwrite && is_there(path)) cannot_write(path, "it is there already; overwriting it has to be asked for");
}

void synchronize(const fs::path& path, const fs::path& target) {
    const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) cannot_write(target, errno);
    const int failed = fsync(file) != 0 ? errno : 0;
    close(file);
    if (failed != 0 && failed != EINVAL) cannot_write(target, failed);
}

Temporary::Temporary(const fs::path& target, bool overwrite)
    : target_(target), path_(free_name(target)), overwrite_(overwrite) {}

Temporary::~Temporary() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

void Temporary::move_to_target() const {
    if (overwrite_) {
        if (std::rename(path_.c_str(), target_.c_str()) != 0) cannot_write(target_, errno);
        return;
    }
#ifdef RENAME_NOREPLACE
    if (renameat2(AT_FDCWD, path_.c_str(), AT_FDCWD, target_.c_str(), RENAME_NOREPLACE) == 0) return;
    if (errno != EINVAL && errno != ENOSYS) cannot_write(target_, errno);
#endif
    refuse_existing(target_, false);
    if (std::rename(path_.c_str(), target_.c_str()) != 0) cannot_write(target_, errno);
}

}  // namespace mien
