// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "interrupt.hpp"

#include <csignal>

namespace mien::cli {

namespace {

volatile std::sig_atomic_t interrupted = 0;

void note(int) {
    interrupted = 1;
}

}  // namespace

void listen_for_interrupts() {
    std::signal(SIGINT, note);
    std::signal(SIGTERM, note);
}

void stop_if_interrupted() {
    if (interrupted != 0) throw Interrupted();
}

}  // namespace mien::cli
