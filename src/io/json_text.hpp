// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// JSON that people write by hand (feature points, marker maps): stricter than the standard, because a key given twice
// is a mistake that a parser would swallow.

#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mien {

struct JsonText {
    nlohmann::json value;
    /// Every key of the outermost object, and of the objects right in it, in file order: where it lies, and the key.
    struct Key {
        bool outermost = true;
        std::string parent;  ///< the key of the object it lies in
        std::string name;
    };
    std::vector<Key> keys;
};

/// The members that lie in `parent` (empty: outermost), in file order, those with a leading underscore left out.
std::vector<std::string> keys_of(const JsonText& text, std::string_view parent);

/// Parses it. Throws Error naming the byte or the key: no JSON, bad UTF-8, numbers out of range, nesting deeper than
/// 64, a key given twice in one object, anything else than an object outside.
JsonText parse_json_text(std::span<const std::byte> bytes, std::string_view format);

/// Parses JSON that programs write: the same checks but for keys given twice, of which the last one holds.
nlohmann::json parse_json(std::string_view text, std::string_view format);

/// Throws Error if brackets are nested deeper than 64.
void check_json_depth(std::string_view text, std::string_view format);

/// A JSON pointer: "/points/8.4", with "~" and "/" in names escaped and shortened where a name is very long.
std::string json_pointer(std::initializer_list<std::string_view> names);

/// A value as it is written, for a sentence; shortened.
std::string shown_json(const nlohmann::json& value);

}  // namespace mien
