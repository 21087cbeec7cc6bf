// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

namespace mien {

struct IsolatedLimits {
    std::uint64_t memory = 0;   ///< bytes that may be allocated beyond what this process has
    std::uint32_t seconds = 0;  ///< of processor time
};

/// Runs `work` in a process of its own and returns what it returned: for a library that was not made for hostile files,
/// so that it can neither bring this process down nor change anything in it. What it prints goes nowhere. Throws Error
/// with the sentence of what `work` threw; one that starts with `name` when it crashed or went beyond a limit.
std::vector<std::byte> run_isolated(std::string_view name, const IsolatedLimits& limits,
                                    const std::function<std::vector<std::byte>()>& work);

}  // namespace mien
