// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// JPEG by libjpeg-turbo. Its errors jump: between setjmp and the last call of the library no object is made that has to
// be destroyed. Before anything is allocated, the size that the file states is held against its bytes: every block of
// 8 x 8 pixels takes a bit at least. A file that ends too early is refused, and so is one that goes over its pixels
// again and again.

#include "mien/io/jpeg.hpp"

#include <array>
#include <csetjmp>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <fmt/format.h>
#include <jpeglib.h>
#include <string>

#include "io/text.hpp"

#include "mien/error.hpp"

namespace mien {

namespace {

constexpr std::uint64_t most_pixels = std::uint64_t{1} << 26;
constexpr std::uint64_t most_pixels_per_byte = 512;
constexpr int most_scans = 100;

// The library's struct and what it needs beside it, destroyed with this one.
struct Reader {
    jpeg_decompress_struct jpeg{};
    jpeg_error_mgr errors{};
    jpeg_source_mgr source{};
    jpeg_progress_mgr progress{};
    std::jmp_buf out{};
    std::array<char, JMSG_LENGTH_MAX> complaint{};
    std::span<const std::byte> bytes;

    explicit Reader(std::span<const std::byte> all) : bytes(all) {}
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;
    ~Reader() { jpeg_destroy_decompress(&jpeg); }
};

Reader& reader_of(j_common_ptr jpeg) {
    return *static_cast<Reader*>(jpeg->client_data);
}

[[noreturn]] void stop(j_common_ptr jpeg) {
    Reader& reader = reader_of(jpeg);
    reader.errors.format_message(jpeg, reader.complaint.data());
    std::longjmp(reader.out, 1);
}

[[noreturn]] void stop_with(j_decompress_ptr jpeg, const char* sentence) {
    Reader& reader = reader_of(reinterpret_cast<j_common_ptr>(jpeg));
    std::snprintf(reader.complaint.data(), reader.complaint.size(), "%s", sentence);
    std::longjmp(reader.out, 1);
}

void print_nothing(j_common_ptr) {}
void pass_over(j_common_ptr, int) {}
void nothing_to_do(j_decompress_ptr) {}

boolean refill(j_decompress_ptr jpeg) {
    stop_with(jpeg, "the end of the file");
}

void skip(j_decompress_ptr jpeg, long count) {
    if (count <= 0) return;
    if (static_cast<std::size_t>(count) > jpeg->src->bytes_in_buffer) stop_with(jpeg, "the end of the file");
    jpeg->src->next_input_byte += count;
    jpeg->src->bytes_in_buffer -= static_cast<std::size_t>(count);
}

void count_scans(j_common_ptr jpeg) {
    auto* const decompress = reinterpret_cast<j_decompress_ptr>(jpeg);
    if (decompress->input_scan_number > most_scans) stop_with(decompress, "more than 100 scans");
}

void set_up(Reader& reader) {
    reader.jpeg.err = jpeg_std_error(&reader.errors);
    reader.errors.error_exit = stop;
    reader.errors.output_message = print_nothing;
    reader.errors.emit_message = pass_over;
    reader.jpeg.client_data = &reader;
    reader.source.next_input_byte = reinterpret_cast<const JOCTET*>(reader.bytes.data());
    reader.source.bytes_in_buffer = reader.bytes.size();
    reader.source.init_source = nothing_to_do;
    reader.source.fill_input_buffer = refill;
    reader.source.skip_input_data = skip;
    reader.source.resync_to_restart = jpeg_resync_to_restart;
    reader.source.term_source = nothing_to_do;
    reader.progress.progress_monitor = count_scans;
}

// Everything in front of the pixels; false when the library gave up.
bool read_header(Reader& reader) {
    if (setjmp(reader.out)) return false;
    jpeg_create_decompress(&reader.jpeg);
    reader.jpeg.src = &reader.source;
    reader.jpeg.progress = &reader.progress;
    jpeg_read_header(&reader.jpeg, TRUE);
    return true;
}

bool read_pixels(Reader& reader, std::uint8_t* rgba, std::size_t row_size) {
    if (setjmp(reader.out)) return false;
    reader.jpeg.out_color_space = JCS_EXT_RGBA;
    // One of several ways to the same picture, the same on every machine.
    reader.jpeg.dct_method = JDCT_ISLOW;
    jpeg_start_decompress(&reader.jpeg);
    while (reader.jpeg.output_scanline < reader.jpeg.output_height) {
        JSAMPROW row = rgba + std::size_t{reader.jpeg.output_scanline} * row_size;
        jpeg_read_scanlines(&reader.jpeg, &row, 1);
    }
    return true;
}

[[noreturn]] void refuse(const Reader& reader) {
    throw Error(fmt::format("jpeg byte {}: expected a picture, found {}",
                            reader.bytes.size() - reader.source.bytes_in_buffer, shown(reader.complaint.data())));
}

void check_stated_size(const Reader& reader) {
    const std::uint32_t width = reader.jpeg.image_width, height = reader.jpeg.image_height;
    const std::uint64_t pixels = std::uint64_t{width} * height;
    if (pixels > most_pixels)
        throw Error(fmt::format("jpeg: expected at most {} pixels, found {} x {}", most_pixels, width, height));
    if (pixels / most_pixels_per_byte > reader.bytes.size())
        throw Error(fmt::format("jpeg: expected pixels that {} bytes can hold, found {} x {}", reader.bytes.size(),
                                width, height));
    if (reader.jpeg.num_components != 1 && reader.jpeg.num_components != 3)
        throw Error(fmt::format("jpeg: expected grey or three colours, found {} inks", reader.jpeg.num_components));
}

}  // namespace

Picture parse_jpeg(std::span<const std::byte> bytes) {
    Reader reader(bytes);
    set_up(reader);
    if (!read_header(reader)) refuse(reader);
    check_stated_size(reader);
    Picture picture{reader.jpeg.image_width, reader.jpeg.image_height, {}};
    picture.rgba.resize(std::size_t{picture.width} * picture.height * 4);
    if (!read_pixels(reader, picture.rgba.data(), std::size_t{picture.width} * 4)) refuse(reader);
    return picture;
}

}  // namespace mien
