// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Object File Format of Geomview, the text forms with three coordinates. One vertex and one face a line, as every
// writer in use does; Geomview itself would also take them in one stream, but colours of faces have no count and end
// at the end of the line.

#include "mien/io/off.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <string_view>
#include <vector>

#include "io/text.hpp"

#include "mien/error.hpp"

namespace mien {

namespace {

// The next line with something on it before a '#'.
bool next_statement(Lines& lines, std::string_view& statement) {
    while (lines.next()) {
        statement = trimmed(lines.line().substr(0, lines.line().find('#')));
        if (!statement.empty()) return true;
    }
    return false;
}

std::string_view expect_statement(Lines& lines, std::string_view what) {
    std::string_view statement;
    if (!next_statement(lines, statement)) lines.fail(fmt::format("expected {}, found the end of the file", what));
    return statement;
}

// [ST][C][N]OFF: texture coordinates, colours and normals follow the coordinates on the line and are passed over.
// What stands behind the keyword on its line is returned.
std::string_view read_keyword(Lines& lines) {
    Words words(expect_statement(lines, "the keyword OFF"));
    const std::string_view keyword = words.next();
    std::string_view prefix = keyword;
    for (const std::string_view letter : {"ST", "C", "N"})
        if (prefix.starts_with(letter)) prefix.remove_prefix(letter.size());
    if (prefix != "OFF") lines.fail(fmt::format("expected OFF, COFF, NOFF or STOFF, found {}", shown(keyword)));
    const std::string_view rest = trimmed(words.rest());
    if (rest == "BINARY") lines.fail("expected the text form, found BINARY");
    return rest;
}

std::int64_t count(const Lines& lines, Words& words, std::string_view what) {
    const std::string_view word = words.next();
    const std::optional<std::int64_t> number = parse_integer(word);
    if (!number || *number < 0) lines.fail(fmt::format("expected the number of {}, found {}", what, shown(word)));
    return *number;
}

float coordinate(const Lines& lines, Words& words) {
    const std::string_view word = words.next();
    const std::optional<float> number = parse_float(word);
    if (!number || !std::isfinite(*number))
        lines.fail(fmt::format("expected a finite coordinate, found {}", shown(word)));
    return *number;
}

void read_vertices(Lines& lines, std::int64_t vertices, Mesh& mesh) {
    for (std::int64_t v = 0; v < vertices; ++v) {
        Words words(expect_statement(lines, fmt::format("vertex {} of {}", v + 1, vertices)));
        const float x = coordinate(lines, words);
        const float y = coordinate(lines, words);
        mesh.positions.push_back({x, y, coordinate(lines, words)});
    }
}

std::uint32_t vertex_index(const Lines& lines, Words& words, std::size_t vertices) {
    const std::string_view word = words.next();
    const std::optional<std::int64_t> index = parse_integer(word);
    if (!index || *index < 0 || static_cast<std::uint64_t>(*index) >= vertices)
        lines.fail(fmt::format("expected a vertex index from 0, below {}, found {}", vertices, shown(word)));
    return static_cast<std::uint32_t>(*index);
}

// Points and edges (one or two corners) are legal in the format and have no surface: passed over.
void read_face(const Lines& lines, Words& words, Mesh& mesh) {
    const std::int64_t corners = count(lines, words, "corners");
    std::vector<std::uint32_t> indices;
    for (std::int64_t c = 0; c < corners; ++c) indices.push_back(vertex_index(lines, words, mesh.positions.size()));
    if (indices.size() >= 3) add_face(mesh, indices);
}

void read_faces(Lines& lines, std::int64_t faces, Mesh& mesh) {
    for (std::int64_t f = 0; f < faces; ++f) {
        Words words(expect_statement(lines, fmt::format("face {} of {}", f + 1, faces)));
        read_face(lines, words, mesh);
    }
}

}  // namespace

Mesh parse_off(std::span<const std::byte> bytes) {
    check_text(bytes, "off");
    Lines lines(as_text(bytes), "off");
    const std::string_view rest = read_keyword(lines);
    Words counts(rest.empty() ? expect_statement(lines, "the counts of vertices, faces and edges") : rest);
    const std::int64_t vertices = count(lines, counts, "vertices");
    const std::int64_t faces = count(lines, counts, "faces");
    count(lines, counts, "edges");
    if (faces == 0) lines.fail("expected faces, found a count of 0");

    Mesh mesh;
    read_vertices(lines, vertices, mesh);
    read_faces(lines, faces, mesh);
    std::string_view more;
    if (next_statement(lines, more))
        lines.fail(fmt::format("expected the end of the file after {} faces, found {}", faces, shown(more)));
    return mesh;
}

}  // namespace mien
