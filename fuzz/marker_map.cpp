// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/io/marker_map.hpp"

#include "fuzz.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace mien;
    return fuzz::run(data, size, parse_marker_map, [](const std::vector<Rename>& names) {
        fuzz::expect(!names.empty(), "markers");
        for (const Rename& name : names) fuzz::expect(!name.from.empty(), "a name for each marker");
    });
}
