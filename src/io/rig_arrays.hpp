// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The long lists of a rig file: plain numbers in a buffer view of their own, named in the extension by
// {"bufferView": 7, "count": 1200}. An empty list has no view, since glTF knows no view of no bytes.

#pragma once

#include <cstddef>
#include <cstring>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "io/gltf_builder.hpp"

namespace mien {

/// Appends the numbers and returns how the extension names them.
template <class T>
nlohmann::json append_array(GltfDocument& document, const std::vector<T>& values) {
    nlohmann::json array = {{"count", values.size()}};
    if (!values.empty())
        array["bufferView"] = append_view(document, std::as_bytes(std::span(values)), BufferTarget::none);
    return array;
}

/// The bytes of the array that `owner` names `name`. Throws Error naming the JSON pointer when it is missing, its view
/// does not lie in the buffer or does not hold exactly its count of elements.
std::span<const std::byte> array_bytes(const GltfDocument& document, const nlohmann::json& owner, const char* name,
                                       const std::string& pointer, std::size_t element_size);

/// The numbers themselves; what they mean is for the caller to check.
template <class T>
std::vector<T> read_array(const GltfDocument& document, const nlohmann::json& owner, const char* name,
                          const std::string& pointer) {
    const std::span<const std::byte> bytes = array_bytes(document, owner, name, pointer, sizeof(T));
    std::vector<T> values(bytes.size() / sizeof(T));
    if (!values.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
}

}  // namespace mien
