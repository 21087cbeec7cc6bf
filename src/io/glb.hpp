// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

namespace mien {

/// A glTF document in memory: the JSON tree and the one buffer that everything lies in (buffer 0, no uri).
struct GltfDocument {
    nlohmann::json json;
    std::vector<std::byte> binary;
    std::vector<std::string> left_out{};  ///< what the file names and the document goes without, a sentence each
};

/// Splits a GLB container into its JSON and BIN chunks. Throws Error naming the byte, expected and found: magic,
/// version, lengths, chunk order, text that is no JSON, nesting deeper than 64.
GltfDocument parse_glb(std::span<const std::byte> bytes);

/// Parses the text of a .gltf: the same checks for the JSON; `binary` stays empty.
nlohmann::json parse_gltf_json(std::span<const std::byte> bytes);

/// A GLB container: chunks padded to four bytes, `buffers[0].byteLength` set. Equal documents give equal bytes.
std::vector<std::byte> format_glb(const GltfDocument& document);

}  // namespace mien
