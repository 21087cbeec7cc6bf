// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// FAP streams for tests: real files from beside the project, and random ones of all masks.

#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <random>
#include <string>

#include "io/fap_promise.hpp"

namespace mien {

/// The texts of the real files by name; empty when they are not there.
inline std::map<std::string, std::string> fap_samples() {
    std::map<std::string, std::string> samples;
    const std::filesystem::path folder = std::filesystem::path(MIEN_SHARED) / "mpeg4/samples";
    if (!std::filesystem::is_directory(folder)) return samples;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (entry.path().extension() != ".fap") continue;
        std::ifstream file(entry.path(), std::ios::binary);
        samples[entry.path().filename().string()].assign(std::istreambuf_iterator<char>(file), {});
    }
    return samples;
}

/// A number from 0 to n - 1.
inline std::uint32_t below(std::mt19937& random, std::uint32_t n) {
    return static_cast<std::uint32_t>(random() % n);
}

/// A mask of one of many kinds: nothing, everything, one parameter, whole groups, any.
inline FapMask random_mask(std::mt19937& random) {
    FapMask mask;
    const auto kind = random() % 6;
    if (kind == 0) return mask;
    if (kind == 1) return mask.set();
    if (kind == 2) return mask.set(random() % fap_count);
    const auto share = random() % 10;
    for (std::size_t g = 0; g < 10; ++g) {
        const bool whole = random() % 2 == 0;
        for (std::size_t i = fap_group_starts[g]; i < fap_group_starts[g + 1]; ++i)
            mask[i] = kind == 3 ? whole : random() % 10 < share;
    }
    return mask;
}

/// Frames whose masks stay for a while, whose values wander and jump, and some of whose numbers are left out.
inline FapStream random_stream(std::mt19937& random, std::size_t frames) {
    FapStream stream;
    stream.rate = static_cast<double>(1 + random() % 960) / 16;
    FapMask mask = random_mask(random);
    std::uint32_t number = below(random, 40);
    const int reach = 1 << (random() % 14);
    for (std::size_t f = 0; f < frames; ++f) {
        FapFrame& frame = stream.frames.emplace_back();
        if (random() % 8 == 0) mask = random_mask(random);
        frame.number = number;
        number += below(random, 4) == 0 ? 1 + below(random, 40) : 1;
        frame.mask = mask;
        const auto any = [&](unsigned most) { return static_cast<std::uint8_t>(random() % (most + 1)); };
        if (mask[0]) frame.viseme = {any(14), any(14), any(63), any(1) == 1};
        if (mask[1]) frame.expression = {any(6), any(63), any(6), any(63), any(1) == 1, any(1) == 1};
        for (std::size_t i = 2; i < fap_count; ++i)
            if (mask[i]) frame.value[i] = static_cast<int>(random() % (2 * static_cast<unsigned>(reach) + 1)) - reach;
    }
    return stream;
}

}  // namespace mien
