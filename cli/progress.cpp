// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "progress.hpp"

#include <cstdio>
#include <fmt/format.h>
#include <unistd.h>
#include <utility>

namespace mien::cli {

using std::chrono::steady_clock;
using namespace std::chrono_literals;

Progress::Progress(std::string what, bool quiet)
    : what_(std::move(what)),
      terminal_(!quiet && isatty(STDERR_FILENO) != 0),
      start_(steady_clock::now()),
      drawn_(start_) {}

Progress::~Progress() {
    if (shown_) std::fputs("\r\033[K", stderr);
}

void Progress::operator()(std::size_t done, std::size_t all) {
    const auto now = steady_clock::now();
    if (!terminal_ || all == 0 || now - start_ < 1s || now - drawn_ < 100ms) return;
    drawn_ = now;
    shown_ = true;
    const std::size_t bars = 30 * done / all;
    fmt::print(stderr, "\r\033[K{} [{:<30}] {} of {}", what_, std::string(bars, '#'), done, all);
    std::fflush(stderr);
}

}  // namespace mien::cli
