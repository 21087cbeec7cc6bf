// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "io/gltf_json.hpp"

#include <cmath>
#include <fmt/format.h>

#include "io/json_text.hpp"

#include "mien/error.hpp"

namespace mien {

using nlohmann::json;

namespace {

constexpr std::uint64_t largest_whole = std::uint64_t{1} << 53;

std::string below(const std::string& pointer, const char* name) {
    return pointer + '/' + name;
}

double finite_number(const json& value, const std::string& pointer) {
    if (!value.is_number()) fail_found(pointer, "a number", value);
    const auto number = value.get<double>();
    if (!std::isfinite(number)) fail_found(pointer, "a finite number", value);
    return number;
}

}  // namespace

void fail_at(const std::string& pointer, std::string_view expected, std::string_view found) {
    throw Error(fmt::format("gltf {}: expected {}, found {}", pointer.empty() ? "/" : pointer, expected, found));
}

void fail_found(const std::string& pointer, std::string_view expected, const json& found) {
    fail_at(pointer, expected, shown_json(found));
}

const json* find_member(const json& object, const char* name, const std::string& pointer) {
    if (!object.is_object()) fail_found(pointer, "an object", object);
    const auto found = object.find(name);
    return found == object.end() ? nullptr : &*found;
}

const json& array_member(const json& object, const char* name, const std::string& pointer) {
    static const json none = json::array();
    const json* found = find_member(object, name, pointer);
    if (found != nullptr && !found->is_array()) fail_found(below(pointer, name), "an array", *found);
    return found == nullptr ? none : *found;
}

const json& object_member(const json& object, const char* name, const std::string& pointer) {
    static const json none = json::object();
    const json* found = find_member(object, name, pointer);
    if (found != nullptr && !found->is_object()) fail_found(below(pointer, name), "an object", *found);
    return found == nullptr ? none : *found;
}

std::uint64_t whole_number(const json& value, const std::string& pointer) {
    constexpr const char* expected = "a whole number from 0 to 2^53";
    if (value.is_number_unsigned() && value.get<std::uint64_t>() <= largest_whole) return value.get<std::uint64_t>();
    // A number that was set in memory may have a sign.
    if (value.is_number_integer() && !value.is_number_unsigned() && value.get<std::int64_t>() >= 0)
        return value.get<std::uint64_t>();
    // Some exporters write 3.0 where 3 is meant, which JSON does not tell apart.
    if (!value.is_number_float()) fail_found(pointer, expected, value);
    const auto number = value.get<double>();
    if (!(number >= 0 && number <= static_cast<double>(largest_whole)) || std::floor(number) != number)
        fail_found(pointer, expected, value);
    return static_cast<std::uint64_t>(number);
}

std::optional<std::uint64_t> find_whole(const json& object, const char* name, const std::string& pointer) {
    const json* found = find_member(object, name, pointer);
    if (found == nullptr) return std::nullopt;
    return whole_number(*found, below(pointer, name));
}

std::uint64_t whole_member(const json& object, const char* name, const std::string& pointer,
                           std::optional<std::uint64_t> fallback) {
    const std::optional<std::uint64_t> found = find_whole(object, name, pointer);
    if (!found && !fallback) fail_at(below(pointer, name), "a whole number", "none");
    return found ? *found : *fallback;
}

double number_member(const json& object, const char* name, const std::string& pointer, double fallback) {
    const json* found = find_member(object, name, pointer);
    return found == nullptr ? fallback : finite_number(*found, below(pointer, name));
}

std::optional<std::vector<double>> find_numbers(const json& object, const char* name, std::size_t size,
                                                const std::string& pointer) {
    const json* found = find_member(object, name, pointer);
    if (found == nullptr) return std::nullopt;
    const std::string place = below(pointer, name);
    if (!found->is_array() || found->size() != size) fail_found(place, fmt::format("{} numbers", size), *found);
    std::vector<double> numbers;
    for (std::size_t i = 0; i < size; ++i)
        numbers.push_back(finite_number((*found)[i], fmt::format("{}/{}", place, i)));
    return numbers;
}

bool bool_member(const json& object, const char* name, const std::string& pointer) {
    const json* found = find_member(object, name, pointer);
    if (found != nullptr && !found->is_boolean()) fail_found(below(pointer, name), "true or false", *found);
    return found != nullptr && found->get<bool>();
}

std::string text_member(const json& object, const char* name, const std::string& pointer) {
    const json* found = find_member(object, name, pointer);
    if (found != nullptr && !found->is_string()) fail_found(below(pointer, name), "a text", *found);
    return found == nullptr ? std::string() : found->get<std::string>();
}

std::size_t element_count(const json& root, const char* name) {
    return array_member(root, name, "").size();
}

}  // namespace mien
