// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/io/jpeg.hpp"

#include "fuzz.hpp"
#include "io/promise.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace mien;
    return fuzz::run(data, size, parse_jpeg,
                     [](const Picture& picture) { fuzz::expect(hostile::keeps_promise(picture), "pixels"); });
}
