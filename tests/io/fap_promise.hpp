// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cmath>

#include "mien/fap.hpp"

namespace mien {

/// What every reader promises of a stream: a rate above 0, numbers that rise, choices that exist, zeros where nothing
/// was sent.
inline bool keeps_promise(const FapStream& stream) {
    bool good = std::isfinite(stream.rate) && stream.rate > 0 && !stream.frames.empty();
    for (std::size_t f = 0; f < stream.frames.size(); ++f) {
        const FapFrame& frame = stream.frames[f];
        const Viseme& v = frame.viseme;
        const Expression& e = frame.expression;
        good = good && (f == 0 || stream.frames[f - 1].number < frame.number);
        good = good && v.select1 <= 14 && v.select2 <= 14 && v.blend <= 63;
        good = good && e.select1 <= 6 && e.select2 <= 6 && e.intensity1 <= 63 && e.intensity2 <= 63;
        good = good && (frame.mask[0] || v == Viseme{}) && (frame.mask[1] || e == Expression{});
        for (std::size_t i = 0; i < fap_count; ++i) good = good && ((i >= 2 && frame.mask[i]) || frame.value[i] == 0);
    }
    return good;
}

}  // namespace mien
