// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <stdexcept>

namespace mien::cli {

/// Ctrl-C was pressed (exit status 130).
class Interrupted : public std::runtime_error {
public:
    Interrupted() : std::runtime_error("stopped; nothing was written") {}
};

/// From now on Ctrl-C and a request to end only leave a note, so that work can be put down tidily.
void listen_for_interrupts();

/// Throws Interrupted if the note is there.
void stop_if_interrupted();

}  // namespace mien::cli
