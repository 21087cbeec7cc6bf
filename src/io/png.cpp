// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// PNG by libpng. Its errors jump: between setjmp and the last call of the library no object is made that has to be
// destroyed. Before anything is allocated, the size that the file states is held against what its bytes can be
// unpacked to.

#include "mien/io/png.hpp"

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstdint>
#include <cstring>
#include <fmt/format.h>
#include <png.h>
#include <string>

#include "io/text.hpp"

#include "mien/error.hpp"

namespace mien {

namespace {

constexpr std::uint64_t most_pixels = std::uint64_t{1} << 26;

// The most that deflate makes of a byte (Deutsch, RFC 1951: 258 bytes for two bits).
constexpr std::uint64_t most_growth = 1032;

constexpr std::size_t signature_size = 8;

// The bytes while libpng reads them, and what it says when it gives up.
struct Source {
    std::span<const std::byte> bytes;
    std::size_t at = 0;
    std::array<char, 128> complaint{};
};

void copy_sentence(std::array<char, 128>& to, const char* sentence) {
    std::strncpy(to.data(), sentence, to.size() - 1);
}

void take_bytes(png_structp png, png_bytep to, std::size_t size) {
    auto& source = *static_cast<Source*>(png_get_io_ptr(png));
    if (size > source.bytes.size() - source.at) png_error(png, "the end of the file");
    std::memcpy(to, source.bytes.data() + source.at, size);
    source.at += size;
}

[[noreturn]] void stop(png_structp png, png_const_charp sentence) {
    copy_sentence(*static_cast<std::array<char, 128>*>(png_get_error_ptr(png)), sentence);
    png_longjmp(png, 1);
}

void pass_over(png_structp, png_const_charp) {}

// libpng's two structs, for reading or for writing as `made` says; destroyed with this one by `destroy`.
struct Structs {
    using Destroy = void (*)(png_structpp, png_infopp);
    png_structp png;
    png_infop info;
    Destroy destroy;
    Structs(png_structp made, Destroy by)
        : png(made), info(made != nullptr ? png_create_info_struct(made) : nullptr), destroy(by) {}
    Structs(const Structs&) = delete;
    Structs& operator=(const Structs&) = delete;
    ~Structs() { destroy(&png, &info); }
};

void destroy_reader(png_structpp png, png_infopp info) {
    png_destroy_read_struct(png, info, nullptr);
}

[[noreturn]] void refuse(const Source& source) {
    throw Error(fmt::format("png byte {}: expected a picture, found {}", source.at, shown(source.complaint.data())));
}

// Everything in front of the pixels; false when libpng gave up.
bool read_header(const Structs& reader, Source& source) {
    if (setjmp(png_jmpbuf(reader.png))) return false;
    png_set_read_fn(reader.png, &source, take_bytes);
    png_set_user_limits(reader.png, 1U << 24U, 1U << 24U);
    png_set_chunk_cache_max(reader.png, 64);
    png_set_chunk_malloc_max(reader.png, 1U << 23U);
    // What lies beside the pixels and their palette is passed over unread.
    png_set_keep_unknown_chunks(reader.png, PNG_HANDLE_CHUNK_NEVER, nullptr, 0);
    png_read_info(reader.png, reader.info);
    return true;
}

// Rows of red, green, blue and alpha of 8 bits each, whatever the file holds.
bool read_pixels(const Structs& reader, std::uint8_t* rgba, std::size_t row_size, std::uint32_t height) {
    if (setjmp(png_jmpbuf(reader.png))) return false;
    png_set_expand(reader.png);
    png_set_scale_16(reader.png);
    png_set_gray_to_rgb(reader.png);
    png_set_add_alpha(reader.png, 255, PNG_FILLER_AFTER);
    const int passes = png_set_interlace_handling(reader.png);
    png_read_update_info(reader.png, reader.info);
    if (png_get_rowbytes(reader.png, reader.info) != row_size) png_error(reader.png, "rows of another size");
    for (int pass = 0; pass < passes; ++pass)
        for (std::uint32_t row = 0; row < height; ++row)
            png_read_row(reader.png, rgba + std::size_t{row} * row_size, nullptr);
    png_read_end(reader.png, nullptr);
    return true;
}

void check_stated_size(const Structs& reader, std::uint32_t width, std::uint32_t height, std::size_t bytes) {
    if (std::uint64_t{width} * height > most_pixels)
        throw Error(fmt::format("png: expected at most {} pixels, found {} x {}", most_pixels, width, height));
    const std::uint64_t bits = std::uint64_t{png_get_bit_depth(reader.png, reader.info)} *
                               png_get_channels(reader.png, reader.info) * width * height;
    if (bits / 8 / most_growth > bytes)
        throw Error(fmt::format("png: expected pixels that {} bytes can hold, found {} x {}", bytes, width, height));
}

// The bytes that libpng writes.
struct Sink {
    std::vector<std::byte> bytes;
    std::array<char, 128> complaint{};
};

void put_bytes(png_structp png, png_bytep from, std::size_t size) {
    auto& bytes = static_cast<Sink*>(png_get_io_ptr(png))->bytes;
    const auto* const first = reinterpret_cast<const std::byte*>(from);
    bytes.insert(bytes.end(), first, first + size);
}

void put_nothing(png_structp) {}

bool is_opaque(const Picture& picture) {
    for (std::size_t i = 3; i < picture.rgba.size(); i += 4)
        if (picture.rgba[i] != 255) return false;
    return true;
}

bool write_pixels(const Structs& writer, Sink& sink, const Picture& picture, bool opaque) {
    if (setjmp(png_jmpbuf(writer.png))) return false;
    png_set_write_fn(writer.png, &sink, put_bytes, put_nothing);
    png_set_user_limits(writer.png, 0x7fffffff, 0x7fffffff);
    png_set_IHDR(writer.png, writer.info, picture.width, picture.height, 8,
                 opaque ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGB_ALPHA, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_BASE,
                 PNG_FILTER_TYPE_BASE);
    png_set_sRGB(writer.png, writer.info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_set_compression_level(writer.png, 4);
    png_write_info(writer.png, writer.info);
    if (opaque) png_set_filler(writer.png, 0, PNG_FILLER_AFTER);
    for (std::size_t row = 0; row < picture.height; ++row)
        png_write_row(writer.png, picture.rgba.data() + row * picture.width * 4);
    png_write_end(writer.png, nullptr);
    return true;
}

}  // namespace

Picture parse_png(std::span<const std::byte> bytes) {
    Source source{bytes};
    if (bytes.size() < signature_size ||
        png_sig_cmp(reinterpret_cast<png_const_bytep>(bytes.data()), 0, signature_size) != 0)
        throw Error("png byte 0: expected the signature of a PNG, found other bytes");
    const Structs reader(png_create_read_struct(PNG_LIBPNG_VER_STRING, &source.complaint, stop, pass_over),
                         destroy_reader);
    if (reader.info == nullptr) throw Error("png: expected memory for a picture, found none");
    if (!read_header(reader, source)) refuse(source);
    Picture picture{png_get_image_width(reader.png, reader.info), png_get_image_height(reader.png, reader.info), {}};
    check_stated_size(reader, picture.width, picture.height, bytes.size());
    picture.rgba.resize(std::size_t{picture.width} * picture.height * 4);
    if (!read_pixels(reader, picture.rgba.data(), std::size_t{picture.width} * 4, picture.height)) refuse(source);
    return picture;
}

std::vector<std::byte> format_png(const Picture& picture) {
    if (picture.rgba.empty() || picture.rgba.size() != std::uint64_t{picture.width} * picture.height * 4)
        throw Error(fmt::format("png: expected 4 numbers for each of {} x {} pixels, found {}", picture.width,
                                picture.height, picture.rgba.size()));
    Sink sink;
    const Structs writer(png_create_write_struct(PNG_LIBPNG_VER_STRING, &sink.complaint, stop, pass_over),
                         png_destroy_write_struct);
    if (writer.info == nullptr || !write_pixels(writer, sink, picture, is_opaque(picture)))
        throw Error(
            fmt::format("png: cannot write {} x {} pixels: {}", picture.width, picture.height, sink.complaint.data()));
    return std::move(sink.bytes);
}

}  // namespace mien
