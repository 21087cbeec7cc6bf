// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mien {

/// What a uri of a glTF holds or names: the bytes of a data: URI, or the path of a file beside the document.
bool is_data_uri(std::string_view uri);

/// The bytes of a data: URI in base64. Throws Error naming `pointer`, expected and found.
std::vector<std::byte> decode_data_uri(std::string_view uri, const std::string& pointer);

/// A relative uri as a path, percent signs decoded. Throws Error for other schemes, absolute and empty ones.
std::string relative_path(std::string_view uri, const std::string& pointer);

/// The media type of a picture by its first bytes (PNG, JPEG, WebP, KTX 2); empty for anything else.
std::string_view picture_type(std::span<const std::byte> bytes);

}  // namespace mien
