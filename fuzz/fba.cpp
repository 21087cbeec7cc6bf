// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/io/fba.hpp"

#include "fuzz.hpp"
#include "io/fap_promise.hpp"

namespace {

// The stream coded again, or nothing when it skips more frames than are written.
std::optional<mien::EncodedFaps> coded(const mien::FapStream& stream, int quant) {
    try {
        return mien::format_fba(stream, {.quant = quant});
    } catch (const mien::Error&) {
        return std::nullopt;
    }
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace mien;
    return fuzz::run(data, size, parse_fba, [&](const DecodedFaps& decoded) {
        fuzz::expect(keeps_promise(decoded.stream), "rising numbers, choices that exist, zeros where nothing was sent");
        const auto again = coded(decoded.stream, static_cast<int>(size % 32));
        if (!again) return;
        const DecodedFaps back = parse_fba(std::as_bytes(std::span<const char>(again->bytes)));
        fuzz::expect(back.cut.empty() && back.stream.frames == again->decoded.frames, "what is coded decodes equal");
    });
}
