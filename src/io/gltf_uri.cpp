// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The uris of glTF 2.0 (specification, 2.8): base64 of RFC 4648, percent-encoding of RFC 3986.

#include "io/gltf_uri.hpp"

#include <array>
#include <cstdint>

#include "io/gltf_json.hpp"
#include "io/text.hpp"

namespace mien {

namespace {

constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr std::uint8_t no_digit = 255;

std::array<std::uint8_t, 256> digit_values() {
    std::array<std::uint8_t, 256> values{};
    values.fill(no_digit);
    for (std::size_t i = 0; i < digits.size(); ++i)
        values[static_cast<unsigned char>(digits[i])] = static_cast<std::uint8_t>(i);
    return values;
}

// Without the padding at its end, which some leave out.
std::string_view unpadded(std::string_view text) {
    for (int i = 0; i < 2 && !text.empty() && text.back() == '='; ++i) text.remove_suffix(1);
    return text;
}

std::vector<std::byte> decode_base64(std::string_view text, const std::string& pointer) {
    static const std::array<std::uint8_t, 256> values = digit_values();
    const std::string_view body = unpadded(text);
    if (body.size() % 4 == 1) fail_at(pointer, "base64 in whole groups", "one digit left over");
    std::vector<std::byte> bytes;
    bytes.reserve(body.size() / 4 * 3 + 2);
    std::uint32_t bits = 0;
    unsigned waiting = 0;
    for (const char c : body) {
        const std::uint8_t value = values[static_cast<unsigned char>(c)];
        if (value == no_digit) fail_at(pointer, "base64", shown(std::string_view(&c, 1)));
        bits = bits << 6 | value;
        waiting += 6;
        if (waiting < 8) continue;
        waiting -= 8;
        bytes.push_back(static_cast<std::byte>(bits >> waiting & 255U));
    }
    return bytes;
}

int hex_value(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

// A percent sign without two digits stands for itself: exporters that forget to encode are many.
std::string percent_decoded(std::string_view uri) {
    std::string path;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const bool encoded =
            uri[i] == '%' && i + 2 < uri.size() && hex_value(uri[i + 1]) >= 0 && hex_value(uri[i + 2]) >= 0;
        path += encoded ? static_cast<char>(hex_value(uri[i + 1]) * 16 + hex_value(uri[i + 2])) : uri[i];
        if (encoded) i += 2;
    }
    return path;
}

bool starts_with(std::span<const std::byte> bytes, std::string_view magic) {
    return as_text(bytes).substr(0, magic.size()) == magic;
}

}  // namespace

bool is_data_uri(std::string_view uri) {
    return equal_but_case(uri.substr(0, 5), "data:");
}

std::vector<std::byte> decode_data_uri(std::string_view uri, const std::string& pointer) {
    constexpr std::string_view mark = ";base64";
    const std::size_t comma = uri.find(',');
    if (comma == std::string_view::npos || comma < mark.size() || uri.substr(comma - mark.size(), mark.size()) != mark)
        fail_at(pointer, "a data: URI with ;base64,", shown(uri));
    return decode_base64(uri.substr(comma + 1), pointer);
}

std::string relative_path(std::string_view uri, const std::string& pointer) {
    std::string path = percent_decoded(uri);
    const bool absolute = path.empty() || path[0] == '/' || path[0] == '\\';
    const bool scheme = uri.substr(0, uri.find('/')).find(':') != std::string_view::npos;
    if (absolute || scheme || path.find('\0') != std::string::npos)
        fail_at(pointer, "a relative uri of a file beside the document", shown(uri));
    return path;
}

std::string_view picture_type(std::span<const std::byte> bytes) {
    using namespace std::string_view_literals;
    if (starts_with(bytes, "\x89PNG\r\n\x1a\n"sv)) return "image/png";
    if (starts_with(bytes, "\xff\xd8\xff"sv)) return "image/jpeg";
    if (starts_with(bytes, "RIFF"sv) && bytes.size() >= 12 && starts_with(bytes.subspan(8), "WEBP"sv))
        return "image/webp";
    if (starts_with(bytes, "\xabKTX 20\xbb\r\n\x1a\n"sv)) return "image/ktx2";
    return {};
}

}  // namespace mien
