// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// What a fuzz target does with one input: the parser refuses it with Error, or what it returns keeps its promise.

#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <span>

#include "mien/error.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace mien::fuzz {

/// Stops the fuzzer, which keeps the input, when a promise is broken.
inline void expect(bool kept, const char* promise) {
    if (kept) return;
    std::fprintf(stderr, "broken promise: %s\n", promise);
    std::abort();
}

/// Parses one input and hands what comes of it to `check`.
template <class Parse, class Check>
int run(const std::uint8_t* data, std::size_t size, const Parse& parse, const Check& check) {
    const auto parsed = [&]() -> decltype(std::optional(parse(std::as_bytes(std::span(data, size))))) {
        try {
            return parse(std::as_bytes(std::span(data, size)));
        } catch (const Error& error) {
            expect(error.what()[0] != '\0', "an error says something");
            return std::nullopt;
        }
    }();
    if (parsed) check(*parsed);
    return 0;
}

}  // namespace mien::fuzz
