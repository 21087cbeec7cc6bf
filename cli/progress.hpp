// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>

namespace mien::cli {

/// A progress line on a terminal's stderr for work that takes over a second; silent otherwise.
class Progress {
public:
    Progress(std::string what, bool quiet);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Rows done of all; draws at most ten times a second.
    void operator()(std::size_t done, std::size_t all);

private:
    std::string what_;
    bool shown_ = false;
    bool terminal_;
    std::chrono::steady_clock::time_point start_, drawn_;
};

}  // namespace mien::cli
