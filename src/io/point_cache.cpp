// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// MDD and PC2 have no standard text; their layouts are those of the common importers (Blender's mesh cache reads both).
// Bytes are put one by one, so the order in the file does not depend on the machine.

#include "mien/io/point_cache.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <ostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/text.hpp"

#include "mien/error.hpp"

namespace mien {

namespace {

enum class Order { big, little };

void put(std::string& bytes, std::uint32_t word, Order order) {
    for (unsigned i = 0; i < 4; ++i) {
        const unsigned shift = 8 * (order == Order::big ? 3 - i : i);
        bytes += static_cast<char>((word >> shift) & 0xffU);
    }
}

void put(std::string& bytes, float number, Order order) {
    put(bytes, std::bit_cast<std::uint32_t>(number), order);
}

// Both formats count with a signed 32-bit integer.
std::uint32_t count(std::size_t n, std::string_view what) {
    constexpr std::size_t most = std::numeric_limits<std::int32_t>::max();
    if (n > most) throw Error(fmt::format("point cache: expected at most {} {}, found {}", most, what, n));
    return static_cast<std::uint32_t>(n);
}

void write_out(std::ostream& out, const std::string& bytes) {
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

void put_rows(const MeshSequence& sequence, std::ostream& out, Order order) {
    std::vector<Vec3f> positions(vertex_count(sequence.mesh));
    std::string bytes;
    for (std::size_t row = 0; row < sequence.times.size(); ++row) {
        sequence.positions(row, positions);
        bytes.clear();
        for (const Vec3f& p : positions)
            for (const float number : {p.x, p.y, p.z}) put(bytes, number, order);
        write_out(out, bytes);
    }
}

}  // namespace

void format_mdd(const MeshSequence& sequence, std::ostream& out) {
    std::string header;
    put(header, count(sequence.times.size(), "rows"), Order::big);
    put(header, count(vertex_count(sequence.mesh), "vertices"), Order::big);
    for (const double time : sequence.times) put(header, static_cast<float>(time), Order::big);
    write_out(out, header);
    put_rows(sequence, out, Order::big);
}

void format_pc2(const MeshSequence& sequence, std::ostream& out) {
    using namespace std::string_literals;
    std::string header = "POINTCACHE2\0"s;
    put(header, 1U, Order::little);
    put(header, count(vertex_count(sequence.mesh), "vertices"), Order::little);
    put(header, 0.0F, Order::little);
    put(header, 1.0F, Order::little);
    put(header, count(sequence.times.size(), "rows"), Order::little);
    write_out(out, header);
    put_rows(sequence, out, Order::little);
}

namespace {

// The bytes of a cache as numbers: a header, then the rows.
struct Cache {
    std::string_view format;
    Order order = Order::big;
    std::vector<std::byte> bytes;
    std::size_t rows_at = 0;  // where the first row begins

    [[nodiscard]] std::uint32_t word(std::size_t at) const {
        std::uint32_t result = 0;
        for (unsigned i = 0; i < 4; ++i) {
            const unsigned shift = 8 * (order == Order::big ? 3 - i : i);
            result |= std::to_integer<std::uint32_t>(bytes[at + i]) << shift;
        }
        return result;
    }
    [[nodiscard]] float number(std::size_t at) const { return std::bit_cast<float>(word(at)); }
    [[nodiscard]] Vec3f position(std::size_t at) const { return {number(at), number(at + 4), number(at + 8)}; }

    [[noreturn]] void fail(std::size_t at, std::string_view expected, std::string_view found) const {
        throw Error(fmt::format("{} byte {}: expected {}, found {}", format, at, expected, found));
    }
};

// A count, which is signed in the file.
std::uint32_t count_at(const Cache& cache, std::size_t at, std::string_view what) {
    const auto n = static_cast<std::int32_t>(cache.word(at));
    if (n < 1) cache.fail(at, fmt::format("one {} or more", what), std::to_string(n));
    return static_cast<std::uint32_t>(n);
}

void need_header(const Cache& cache, std::size_t size) {
    if (cache.bytes.size() < size) cache.fail(cache.bytes.size(), fmt::format("a header of {} bytes", size), "the end");
}

constexpr std::size_t position_size = 3 * sizeof(float);

// A cache whose counts and numbers are checked.
struct Opened {
    Cache cache;
    std::uint32_t rows = 0, vertices = 0;
    std::size_t vertices_at = 0;  // where their count stands
    double frames_per_row = 0;    // of a PC2
};

// What stands in the counts against the bytes that are there: no count is believed before.
void check_size(const Opened& opened) {
    const Cache& cache = opened.cache;
    const std::uint64_t row_size = std::uint64_t{opened.vertices} * position_size;
    const std::uint64_t there = cache.bytes.size() < cache.rows_at ? 0 : cache.bytes.size() - cache.rows_at;
    if (cache.bytes.size() < cache.rows_at || there % row_size != 0 || there / row_size != opened.rows)
        cache.fail(cache.bytes.size(),
                   fmt::format("the end after {} rows of {} vertices from byte {} on", opened.rows, opened.vertices,
                               cache.rows_at),
                   fmt::format("a file of {} bytes", cache.bytes.size()));
}

void check_numbers(const Cache& cache) {
    for (std::size_t at = cache.rows_at; at < cache.bytes.size(); at += sizeof(float))
        if (!std::isfinite(cache.number(at))) cache.fail(at, "a finite number", std::to_string(cache.number(at)));
}

void check_rate(std::string_view format, double rate) {
    if (!std::isfinite(rate) || rate < 0)
        throw Error(fmt::format("{}: expected a number of rows per second above 0, found {}", format, rate));
}

std::vector<double> even_times(std::size_t rows, double rate) {
    std::vector<double> times(rows);
    for (std::size_t row = 0; row < rows; ++row) times[row] = static_cast<double>(row) / rate;
    return times;
}

// The times of an MDD, seconds from the first.
std::vector<double> own_times(const Cache& cache, std::size_t rows) {
    constexpr std::size_t first = 8;
    std::vector<double> times(rows);
    for (std::size_t row = 0; row < rows; ++row) {
        const std::size_t at = first + row * sizeof(float);
        const double time = double{cache.number(at)} - double{cache.number(first)};
        if (!std::isfinite(time) || (row > 0 && time <= times[row - 1]))
            cache.fail(at, row == 0 ? "a finite time" : "a time above that of the row before, or rows per second given",
                       fmt::format("{}", cache.number(at)));
        times[row] = time;
    }
    return times;
}

Opened open_mdd(std::vector<std::byte> bytes) {
    constexpr std::size_t vertices_at = 4, header = 8;
    Opened opened{{"mdd", Order::big, std::move(bytes)}, 0, 0, vertices_at};
    need_header(opened.cache, header);
    opened.rows = count_at(opened.cache, 0, "row");
    opened.vertices = count_at(opened.cache, vertices_at, "vertex");
    opened.cache.rows_at = header + std::size_t{opened.rows} * sizeof(float);
    check_size(opened);
    check_numbers(opened.cache);
    return opened;
}

Opened open_pc2(std::vector<std::byte> bytes) {
    using namespace std::string_view_literals;
    constexpr std::string_view magic = "POINTCACHE2\0"sv;
    constexpr std::size_t version_at = 12, vertices_at = 16, step_at = 24, rows_at = 28, header = 32;
    Opened opened{{"pc2", Order::little, std::move(bytes), header}, 0, 0, vertices_at};
    const Cache& cache = opened.cache;
    need_header(cache, header);
    if (as_text(cache.bytes).substr(0, magic.size()) != magic)
        cache.fail(0, "\"POINTCACHE2\"", shown(as_text(cache.bytes).substr(0, magic.size())));
    if (cache.word(version_at) != 1) cache.fail(version_at, "version 1", std::to_string(cache.word(version_at)));
    opened.rows = count_at(cache, rows_at, "row");
    opened.vertices = count_at(cache, vertices_at, "vertex");
    opened.frames_per_row = cache.number(step_at);
    if (!std::isfinite(opened.frames_per_row) || !(opened.frames_per_row > 0))
        cache.fail(step_at, "a number of frames per row above 0", fmt::format("{}", opened.frames_per_row));
    check_size(opened);
    check_numbers(cache);
    return opened;
}

MeshSequence rows_of(Opened opened, Mesh head, std::vector<double> times) {
    if (opened.vertices != vertex_count(head))
        opened.cache.fail(opened.vertices_at, fmt::format("{} vertices as the head has", vertex_count(head)),
                          std::to_string(opened.vertices));
    const auto shared = std::make_shared<const Cache>(std::move(opened.cache));
    return {std::move(head), std::move(times), [shared](std::size_t row, std::span<Vec3f> positions) {
                std::size_t at = shared->rows_at + row * positions.size() * position_size;
                for (Vec3f& p : positions) {
                    p = shared->position(at);
                    at += position_size;
                }
            }};
}

}  // namespace

MeshSequence parse_mdd(std::vector<std::byte> bytes, Mesh head, double rate) {
    check_rate("mdd", rate);
    Opened opened = open_mdd(std::move(bytes));
    std::vector<double> times = rate > 0 ? even_times(opened.rows, rate) : own_times(opened.cache, opened.rows);
    return rows_of(std::move(opened), std::move(head), std::move(times));
}

MeshSequence parse_pc2(std::vector<std::byte> bytes, Mesh head, double rate) {
    check_rate("pc2", rate);
    Opened opened = open_pc2(std::move(bytes));
    if (rate == 0) throw Error("pc2: it counts in frames; expected the frames per second to be given, found none");
    const double rows_per_second = rate / opened.frames_per_row;
    if (!std::isfinite(rows_per_second) || !(rows_per_second > 0))
        throw Error(
            fmt::format("pc2: expected a rate that gives rows per second, found {} frames a second and {} a row", rate,
                        opened.frames_per_row));
    std::vector<double> times = even_times(opened.rows, rows_per_second);
    return rows_of(std::move(opened), std::move(head), std::move(times));
}

PointCacheContent check_mdd(std::vector<std::byte> bytes) {
    const Opened opened = open_mdd(std::move(bytes));
    return {opened.rows, opened.vertices, own_times(opened.cache, opened.rows)};
}

PointCacheContent check_pc2(std::vector<std::byte> bytes) {
    const Opened opened = open_pc2(std::move(bytes));
    return {opened.rows, opened.vertices, {}};
}

namespace {

void put_numbers(std::string& text, std::string_view keyword, std::span<const float> numbers) {
    text += keyword;
    for (const float number : numbers) {
        text += ' ';
        append_number(text, number);
    }
    text += '\n';
}

// One corner: v or v/vt, both counted from 1; every corner has a texture coordinate of its own.
void put_corner(std::string& text, std::uint32_t vertex, std::size_t corner, bool textured) {
    text += fmt::format(" {}", vertex + 1);
    if (textured) text += fmt::format("/{}", corner + 1);
}

void put_face(std::string& text, const Mesh& mesh, std::size_t f) {
    text += 'f';
    for (std::size_t corner = mesh.face_starts[f]; corner < mesh.face_starts[f + 1]; ++corner)
        put_corner(text, mesh.face_vertices[corner], corner, !mesh.corner_uvs.empty());
    text += '\n';
}

// A name on a line of its own must not break the line.
std::string one_line(std::string name) {
    for (char& c : name)
        if (c == '\n' || c == '\r' || c == '\\') c = ' ';
    return name;
}

}  // namespace

void format_obj(const Mesh& mesh, std::span<const Vec3f> positions, std::ostream& out) {
    std::string text;
    for (const Vec3f& p : positions) put_numbers(text, "v", std::array{p.x, p.y, p.z});
    for (const Vec2f& uv : mesh.corner_uvs) put_numbers(text, "vt", std::array{uv.x, 1 - uv.y});
    auto part = mesh.parts.begin();
    for (std::size_t f = 0; f < face_count(mesh); ++f) {
        for (; part != mesh.parts.end() && part->first_face <= f; ++part)
            if (part->first_face == f && part->face_count > 0) text += "g " + one_line(part->name) + '\n';
        put_face(text, mesh, f);
    }
    write_out(out, text);
}

}  // namespace mien
