// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/io/c3d.hpp"

#include "fuzz.hpp"
#include "io/promise.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace mien;
    return fuzz::run(data, size, parse_c3d, [](const Take& take) {
        fuzz::expect(hostile::keeps_promise(take), "rising times, whole samples");
    });
}
