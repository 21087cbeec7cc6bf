// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// MDD and PC2 have no standard text; their layouts are those of the common importers (Blender's mesh cache reads both).
// Bytes are put one by one, so the order in the file does not depend on the machine.

#include "mien/io/point_cache.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <fmt/format.h>
#include <limits>
#include <ostream>
#include <string>
#include <string_view>
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
