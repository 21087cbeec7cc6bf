// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// PNG and JPEG files put together from their specifications, byte by byte, so that no library judges itself.

#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace mien::picture_text {

inline std::string big_endian(std::uint32_t number, int bytes) {
    std::string text;
    for (int b = bytes - 1; b >= 0; --b) text += static_cast<char>(number >> (8 * b) & 255U);
    return text;
}

/// PNG specification, annex D.
inline std::uint32_t crc(std::string_view text) {
    std::uint32_t sum = 0xffffffffU;
    for (const char c : text) {
        sum ^= static_cast<std::uint8_t>(c);
        for (int bit = 0; bit < 8; ++bit) sum = (sum & 1U) != 0 ? 0xedb88320U ^ sum >> 1U : sum >> 1U;
    }
    return ~sum;
}

inline std::string chunk(const std::string& name, const std::string& data) {
    return big_endian(static_cast<std::uint32_t>(data.size()), 4) + name + data + big_endian(crc(name + data), 4);
}

/// The bytes as one stored block of a zlib stream (RFC 1950, 1951).
inline std::string stored(const std::string& data) {
    std::uint32_t a = 1, b = 0;
    for (const char c : data) {
        a = (a + static_cast<std::uint8_t>(c)) % 65521;
        b = (b + a) % 65521;
    }
    const auto size = static_cast<std::uint32_t>(data.size());
    const auto little = [](std::uint32_t n) {
        return std::string{static_cast<char>(n & 255U), static_cast<char>(n >> 8U & 255U)};
    };
    return std::string("\x78\x01\x01", 3) + little(size) + little(~size) + data + big_endian(b << 16U | a, 4);
}

/// What the header of a PNG says.
struct PngKind {
    std::uint32_t width = 1, height = 1;
    int depth = 8;
    int colour = 6;  ///< 0 grey, 2 RGB, 3 palette, 4 grey and alpha, 6 RGBA
    int interlace = 0;
};

/// `rows`: each a filter byte and its samples. `before`: chunks between header and pixels.
inline std::string png(const PngKind& kind, const std::string& rows, const std::string& before = {}) {
    std::string header = big_endian(kind.width, 4) + big_endian(kind.height, 4);
    for (const int byte : {kind.depth, kind.colour, 0, 0, kind.interlace}) header += static_cast<char>(byte);
    return "\x89PNG\r\n\x1a\n" + chunk("IHDR", header) + before + chunk("IDAT", stored(rows)) + chunk("IEND", "");
}

/// Numbers as the bytes of a text.
inline std::string bytes_of(const std::vector<int>& numbers) {
    std::string text;
    for (const int number : numbers) text += static_cast<char>(number);
    return text;
}

/// One pixel.
inline std::string dot(int red, int green, int blue, int alpha = 255) {
    return png({}, bytes_of({0, red, green, blue, alpha}));
}

/// A JPEG of one colour, 8 x 8, coded by hand (ITU T.81): in every block only the mean differs from nothing. `means`:
/// one per ink, 128 for none, otherwise from 144 on; ink 0 is brightness, 1 and 2 are the colour differences.
struct JpegKind {
    std::vector<int> means{128};
    bool progressive = false;
    std::uint32_t width = 8, height = 8;
    int scans = 1;
};

inline std::string segment(int marker, const std::string& data) {
    return bytes_of({0xff, marker}) + big_endian(static_cast<std::uint32_t>(data.size()) + 2, 2) + data;
}

/// Differences of 8 to 11 bits' size have two-bit codes here, and none at all the code 0.
inline std::string jpeg_bits(const JpegKind& kind) {
    std::string bits;
    for (const int mean : kind.means) {
        const int difference = (mean - 128) * 8;
        if (difference == 0) bits += '0';
        if (difference != 0) {
            const bool nine = difference > 255;
            bits += nine ? "110" : "10";
            for (int b = nine ? 8 : 7; b >= 0; --b) bits += (difference >> b & 1) != 0 ? '1' : '0';
        }
        if (!kind.progressive) bits += '0';  // no more coefficients
    }
    while (bits.size() % 8 != 0) bits += '1';
    std::string data;
    for (std::size_t i = 0; i < bits.size(); i += 8)
        data += static_cast<char>(std::stoi(bits.substr(i, 8), nullptr, 2));
    return data;
}

inline std::string jpeg(const JpegKind& kind) {
    const int inks = static_cast<int>(kind.means.size());
    std::string frame = bytes_of({8}) + big_endian(kind.height, 2) + big_endian(kind.width, 2) + bytes_of({inks});
    std::string scan = bytes_of({inks});
    for (int ink = 1; ink <= inks; ++ink) {
        frame += bytes_of({ink, 0x11, 0});
        scan += bytes_of({ink, 0});
    }
    scan += bytes_of({0, kind.progressive ? 0 : 63, 0});
    // Lengths 1, 2 and 3 have one code each: no difference, one of 8 bits, one of 9.
    const std::string direct = bytes_of({0x00, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 8, 9});
    const std::string rest = bytes_of({0x10, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    std::string text = bytes_of({0xff, 0xd8}) + segment(0xdb, std::string(1, '\0') + std::string(64, '\1')) +
                       segment(kind.progressive ? 0xc2 : 0xc0, frame) + segment(0xc4, direct) + segment(0xc4, rest);
    for (int s = 0; s < kind.scans; ++s) text += segment(0xda, scan) + jpeg_bits(kind);
    return text + bytes_of({0xff, 0xd9});
}

}  // namespace mien::picture_text
