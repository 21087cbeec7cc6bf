// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/io/fap_text.hpp"

#include "fuzz.hpp"
#include "io/fap_promise.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace mien;
    const auto parse = [](std::span<const std::byte> bytes) { return parse_fap_text(bytes); };
    return fuzz::run(data, size, parse, [&](const FapStream& stream) {
        fuzz::expect(keeps_promise(stream), "rising numbers, choices that exist, zeros where nothing was sent");
        const FapStream again = parse(std::as_bytes(std::span<const char>(format_fap_text(stream))));
        fuzz::expect(again.frames == stream.frames && again.rate == stream.rate && again.name == stream.name,
                     "what is written reads back equal");
    });
}
