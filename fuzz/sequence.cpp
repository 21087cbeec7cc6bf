// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/io/sequence.hpp"

#include "fuzz.hpp"
#include "glb_mutator.hpp"
#include "io/promise.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace mien;
    const auto no_file = [](std::string_view) -> std::vector<std::byte> { throw Error("no file here"); };
    return fuzz::run(
        data, size,
        [&](std::span<const std::byte> bytes) {
            const std::vector<Animation> animations = parse_gltf_animations(bytes, no_file);
            MeshSequence sequence = parse_gltf_sequence(bytes, no_file);
            fuzz::expect(!animations.empty(), "an animation that plays is told");
            constexpr std::size_t rows = 3;
            fuzz::expect(hostile::keeps_promise(sequence, rows), "finite rows, rising times");
            return sequence;
        },
        [](const MeshSequence&) {});
}
