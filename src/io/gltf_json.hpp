// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Members of a glTF's JSON whose type is looked at before they are used: whatever is wrong is named by its JSON
// pointer.

#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mien {

/// Throws Error: "gltf /accessors/3/count: expected ..., found ...".
[[noreturn]] void fail_at(const std::string& pointer, std::string_view expected, std::string_view found);
[[noreturn]] void fail_found(const std::string& pointer, std::string_view expected, const nlohmann::json& found);

/// The member, or null where there is none. Throws Error if `object` is none.
const nlohmann::json* find_member(const nlohmann::json& object, const char* name, const std::string& pointer);

/// A member that has to be an array or an object; an empty one where there is none.
const nlohmann::json& array_member(const nlohmann::json& object, const char* name, const std::string& pointer);
const nlohmann::json& object_member(const nlohmann::json& object, const char* name, const std::string& pointer);

/// A member that has to be a whole number from 0 to 2^53; nothing, or the fallback, where there is none.
std::optional<std::uint64_t> find_whole(const nlohmann::json& object, const char* name, const std::string& pointer);
std::uint64_t whole_member(const nlohmann::json& object, const char* name, const std::string& pointer,
                           std::optional<std::uint64_t> fallback = std::nullopt);

/// A member that has to be true or false, and one that has to be a text; false and empty where there is none.
bool bool_member(const nlohmann::json& object, const char* name, const std::string& pointer);
std::string text_member(const nlohmann::json& object, const char* name, const std::string& pointer);

/// A member that has to be a finite number; the fallback where there is none.
double number_member(const nlohmann::json& object, const char* name, const std::string& pointer, double fallback);

/// A member that has to be an array of `size` finite numbers; nothing where there is none.
std::optional<std::vector<double>> find_numbers(const nlohmann::json& object, const char* name, std::size_t size,
                                                const std::string& pointer);

/// `value` itself as a whole number from 0 to 2^53.
std::uint64_t whole_number(const nlohmann::json& value, const std::string& pointer);

/// How many elements an array of the document has; 0 where it has no such array.
std::size_t element_count(const nlohmann::json& root, const char* name);

}  // namespace mien
