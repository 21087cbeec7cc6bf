// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The two halves of decompression, and what both do to a document.

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/glb.hpp"

namespace mien {

/// How many bytes the whole document may still grow by: many views may name the same few compressed bytes.
struct DecodeBudget {
    std::uint64_t bytes = 0;
};

/// Takes `bytes` out of the budget. Throws Error naming `pointer` when it holds fewer.
void spend(DecodeBudget& budget, std::uint64_t bytes, const std::string& pointer);

/// Whether any buffer view was compressed with meshopt; all of them are plain afterwards.
bool decompress_meshopt(GltfDocument& document, DecodeBudget& budget);

/// Whether any primitive was compressed with Draco; the accessors of all of them are plain afterwards.
bool decompress_draco(GltfDocument& document, DecodeBudget& budget);

/// Appends bytes at a multiple of four and returns where they begin.
std::size_t append_bytes(GltfDocument& document, std::span<const std::byte> bytes);

/// Takes an extension out of an object's `extensions`, and these too when they are empty then.
void remove_extension(nlohmann::json& object, const char* name);

}  // namespace mien
