// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "fuzz.hpp"
#include "io/promise.hpp"

#include "mien/io/point_cache.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace mien;
    // A head of as many vertices as the seed's.
    Mesh head;
    head.positions.resize(3);
    return fuzz::run(
        data, size,
        [&](std::span<const std::byte> bytes) {
            return parse_mdd({bytes.begin(), bytes.end()}, head);
        },
        [](const MeshSequence& sequence) {
            fuzz::expect(hostile::keeps_promise(sequence), "finite rows, rising times");
        });
}
