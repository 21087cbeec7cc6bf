// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/io/fit.hpp"

#include "fuzz.hpp"

#include "mien/algorithms/resolve_faps.hpp"

namespace {

// Every third parameter sent, small values and large ones.
mien::FapStream some_values() {
    mien::FapStream stream;
    stream.frames.resize(2);
    for (std::size_t i = 2; i < mien::fap_count; i += 3)
        for (mien::FapFrame& frame : stream.frames) {
            frame.mask.set(i);
            frame.value[i] = &frame == stream.frames.data() ? static_cast<int>(i) - 34 : 2147483647;
        }
    stream.frames[1].number = 1;
    return stream;
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace mien;
    return fuzz::run(data, size, parse_fit, [](const FapInterpolation& fit) {
        fuzz::expect(!fit.links.empty(), "links");
        const FapStream stream = some_values();
        const FapStream resolved = resolve_faps(stream, standard_poses(), fit);
        for (std::size_t i = 0; i < fap_count; ++i)
            fuzz::expect(!stream.frames[0].mask[i] || resolved.frames[0].value[i] == stream.frames[0].value[i],
                         "what is sent stays");
        const std::string text = format_fit(fit);
        fuzz::expect(parse_fit(std::as_bytes(std::span<const char>(text))) == fit, "what is written reads back equal");
    });
}
