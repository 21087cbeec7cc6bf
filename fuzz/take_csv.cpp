// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/io/take_csv.hpp"

#include "fuzz.hpp"
#include "io/promise.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace mien;
    return fuzz::run(data, size, parse_take_csv, [](const Take& take) {
        fuzz::expect(hostile::keeps_promise(take), "rising times, whole samples");
        const Take again = parse_take_csv(std::as_bytes(std::span<const char>(format_take_csv(take))));
        fuzz::expect(hostile::equal(take, again), "what is written reads back equal");
    });
}
