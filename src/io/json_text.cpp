// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "io/json_text.hpp"

#include <fmt/format.h>
#include <set>

#include "io/text.hpp"

#include "mien/error.hpp"

namespace mien {

namespace {

using nlohmann::json;

// What is open at a place of the text: an object with its keys so far, or an array.
struct Open {
    std::set<std::string> keys;
    std::string last_key;
};

struct KeyWatch {
    std::string_view format;
    JsonText& result;
    std::vector<Open> open;

    void see_key(const std::string& key) {
        if (!open.back().keys.insert(key).second)
            throw Error(fmt::format("{} {}: expected each key once, found it twice", format, json_pointer({key})));
        open.back().last_key = key;
        if (open.size() == 1) result.keys.push_back({true, "", key});
        if (open.size() == 2) result.keys.push_back({false, open[0].last_key, key});
    }

    void see(json::parse_event_t event, const json& value) {
        using Event = json::parse_event_t;
        if (event == Event::object_start || event == Event::array_start) open.emplace_back();
        if (event == Event::object_end || event == Event::array_end) open.pop_back();
        if (event == Event::key) see_key(value.get_ref<const std::string&>());
    }
};

// The parser's own sentence speaks of its insides; what helps is the place.
[[noreturn]] void fail_parse(const json::exception& error, std::string_view format) {
    if (const auto* parse = dynamic_cast<const json::parse_error*>(&error))
        throw Error(fmt::format("{} byte {}: expected JSON text in UTF-8, found something else", format, parse->byte));
    throw Error(fmt::format("{}: expected numbers in the range of a double, found a larger one", format));
}

}  // namespace

// Before a parser sees the text: nothing of it may cost memory or stack by the depth of a stranger's brackets.
void check_json_depth(std::string_view text, std::string_view format) {
    constexpr std::size_t deepest = 64;
    std::size_t depth = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (in_string && c == '\\') ++i;
        if (c == '"') in_string = !in_string;
        if (in_string) continue;
        if (c == '[' || c == '{') ++depth;
        if ((c == ']' || c == '}') && depth > 0) --depth;
        if (depth > deepest)
            throw Error(
                fmt::format("{} byte {}: expected at most {} levels of brackets, found more", format, i, deepest));
    }
}

json parse_json(std::string_view text, std::string_view format) {
    check_json_depth(text, format);
    try {
        return json::parse(text.begin(), text.end());
    } catch (const json::exception& error) {
        fail_parse(error, format);
    }
}

JsonText parse_json_text(std::span<const std::byte> bytes, std::string_view format) {
    check_json_depth(as_text(bytes), format);
    JsonText result;
    KeyWatch watch{format, result, {}};
    try {
        const std::string_view text = as_text(bytes);
        result.value = json::parse(text.begin(), text.end(), [&](int, json::parse_event_t event, json& value) {
            watch.see(event, value);
            return true;
        });
    } catch (const json::exception& error) {
        fail_parse(error, format);
    }
    if (!result.value.is_object())
        throw Error(fmt::format("{}: expected an object outside, found {}", format, shown_json(result.value)));
    return result;
}

std::vector<std::string> keys_of(const JsonText& text, std::string_view parent) {
    std::vector<std::string> names;
    for (const JsonText::Key& key : text.keys)
        if (key.outermost == parent.empty() && key.parent == parent && !key.name.starts_with('_'))
            names.push_back(key.name);
    return names;
}

std::string json_pointer(std::initializer_list<std::string_view> names) {
    constexpr std::size_t longest = 40;
    std::string pointer;
    for (const std::string_view name : names) {
        pointer += '/';
        for (const char c : name.substr(0, longest)) {
            if (c == '~') pointer += "~0";
            if (c == '/') pointer += "~1";
            if (c != '~' && c != '/') pointer += c >= ' ' && c != '\x7f' ? c : '?';
        }
        if (name.size() > longest) pointer += "...";
    }
    return pointer;
}

std::string shown_json(const json& value) {
    if (value.is_object()) return "an object";
    if (value.is_array()) return "an array";
    return shown(std::string_view(value.dump(-1, ' ', true, json::error_handler_t::replace)));
}

}  // namespace mien
