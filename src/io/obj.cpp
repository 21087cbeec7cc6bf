// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Wavefront OBJ, the polygonal part of its specification (Appendix B1 of the Advanced Visualizer manual). Lines,
// points, curves, surfaces and materials are passed over. An index may name a vertex that comes later in the file,
// which the specification leaves open, so the range of positive indices is checked at the end.

#include "mien/io/obj.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "io/text.hpp"

#include "mien/error.hpp"

namespace mien {

namespace {

constexpr std::uint32_t no_index = std::numeric_limits<std::uint32_t>::max();

// The largest index that was asked for in one of the lists, and where: compared with the list when all is read.
struct Demand {
    std::uint64_t index = 0;
    std::size_t line = 0;
};

// One corner of a face: indices from 0 into the three lists; no_index where the corner names none.
struct Corner {
    std::uint32_t vertex = no_index, uv = no_index, normal = no_index;
};

struct ObjFile {
    Lines lines;
    Mesh mesh;
    std::vector<Vec2f> uvs;
    std::uint64_t normals = 0;
    std::vector<std::uint32_t> corner_uvs;  // index into uvs per corner of the mesh
    Demand vertex_demand, uv_demand, normal_demand;
    std::string group;                                               // name that the next faces belong to
    bool part_open = false;                                          // the last part is of that name
    bool face_seen = false;                                          // also one of fewer than three corners
    std::map<std::string, std::uint32_t, std::less<>> mesh_numbers;  // group name -> Part::mesh
    std::vector<std::uint32_t> runs;                                 // per Part::mesh: parts so far
};

float coordinate(const ObjFile& file, Words& words, std::string_view what) {
    const std::string_view word = words.next();
    const std::optional<float> number = parse_float(word);
    if (!number || !std::isfinite(*number)) file.lines.fail(fmt::format("expected {}, found {}", what, shown(word)));
    return *number;
}

void read_vertex(ObjFile& file, Words& words) {
    const float x = coordinate(file, words, "a finite x of a vertex");
    const float y = coordinate(file, words, "a finite y of a vertex");
    const float z = coordinate(file, words, "a finite z of a vertex");
    file.mesh.positions.push_back({x, y, z});
}

// v is optional; OBJ counts it upwards from the bottom of the picture.
void read_uv(ObjFile& file, Words& words) {
    const float u = coordinate(file, words, "a finite u of a texture coordinate");
    Words ahead = words;
    const float v = ahead.next().empty() ? 0 : coordinate(file, words, "a finite v of a texture coordinate");
    file.uvs.push_back({u, 1 - v});
}

// An index as written, counted from 1 or backwards from the last entry, as an index from 0. `count` entries are there
// by now.
std::uint32_t resolve(const ObjFile& file, std::string_view text, std::uint64_t count, Demand& demand,
                      std::string_view list) {
    const std::optional<std::int64_t> index = parse_integer(text);
    const auto entries = static_cast<std::int64_t>(count);
    if (!index || *index == 0 || *index < -entries || *index >= no_index)
        file.lines.fail(
            fmt::format("expected a {} index from 1, or back from -1 to -{}, found {}", list, count, shown(text)));
    const auto resolved = static_cast<std::uint32_t>(*index > 0 ? *index - 1 : entries + *index);
    if (resolved >= demand.index) demand = {std::uint64_t{resolved} + 1, file.lines.number()};
    return resolved;
}

// v, v/vt, v//vn or v/vt/vn.
Corner read_corner(ObjFile& file, std::string_view word) {
    const std::size_t first = std::min(word.find('/'), word.size());
    const std::size_t second = std::min(word.find('/', std::min(first + 1, word.size())), word.size());
    const std::string_view uv = first < word.size() ? word.substr(first + 1, second - first - 1) : std::string_view();
    const std::string_view normal = second < word.size() ? word.substr(second + 1) : std::string_view();
    Corner corner;
    corner.vertex = resolve(file, word.substr(0, first), file.mesh.positions.size(), file.vertex_demand, "vertex");
    if (!uv.empty()) corner.uv = resolve(file, uv, file.uvs.size(), file.uv_demand, "texture coordinate");
    if (!normal.empty()) corner.normal = resolve(file, normal, file.normals, file.normal_demand, "normal");
    return corner;
}

// A run of faces with one name is a part; runs that share a name are primitives of one mesh.
void start_part(ObjFile& file) {
    const auto [number, is_new] =
        file.mesh_numbers.try_emplace(file.group, static_cast<std::uint32_t>(file.mesh_numbers.size()));
    if (is_new) file.runs.push_back(0);
    Part part;
    part.name = file.group;
    part.mesh = number->second;
    part.primitive = file.runs[part.mesh]++;
    part.first_face = static_cast<std::uint32_t>(face_count(file.mesh));
    file.mesh.parts.push_back(std::move(part));
    file.part_open = true;
}

void read_face(ObjFile& file, Words& words) {
    file.face_seen = true;
    std::vector<Corner> corners;
    for (std::string_view word = words.next(); !word.empty() && word.front() != '#'; word = words.next())
        corners.push_back(read_corner(file, word));
    if (corners.size() < 3) return;
    if (!file.part_open) start_part(file);
    for (const Corner& corner : corners) {
        file.mesh.face_vertices.push_back(corner.vertex);
        file.corner_uvs.push_back(corner.uv);
    }
    file.mesh.face_starts.push_back(static_cast<std::uint32_t>(file.mesh.face_vertices.size()));
    ++file.mesh.parts.back().face_count;
}

// Names are compared here and not at every face, which would cost the length of the name each time.
void read_group(ObjFile& file, std::string_view name) {
    file.group = name;
    file.part_open = !file.mesh.parts.empty() && file.mesh.parts.back().name == name;
}

void read_statement(ObjFile& file) {
    Words words(file.lines.line());
    const std::string_view keyword = words.next();
    if (keyword == "v") read_vertex(file, words);
    if (keyword == "vt") read_uv(file, words);
    if (keyword == "vn") ++file.normals;
    if (keyword == "f") read_face(file, words);
    if (keyword == "g" || keyword == "o") read_group(file, trimmed(words.rest()));
}

// A backslash at the end of a line joins the next one to it.
void read_statements(ObjFile& file) {
    while (file.lines.next()) {
        while (file.lines.line().ends_with('\\') && file.lines.join_next()) {
        }
        read_statement(file);
    }
}

void check_demand(const ObjFile& file, const Demand& demand, std::uint64_t count, std::string_view list) {
    if (demand.index > count)
        file.lines.fail_at(demand.line,
                           fmt::format("expected a {} index from 1 to {}, found {}", list, count, demand.index));
}

void check_all(const ObjFile& file) {
    check_demand(file, file.vertex_demand, file.mesh.positions.size(), "vertex");
    check_demand(file, file.uv_demand, file.uvs.size(), "texture coordinate");
    check_demand(file, file.normal_demand, file.normals, "normal");
    if (!file.face_seen)
        throw Error(fmt::format("obj: expected faces, found none; vertices: {}", file.mesh.positions.size()));
}

// Every corner gets a texture coordinate as soon as one has; those without get the origin.
void assign_uvs(ObjFile& file) {
    const auto& wanted = file.corner_uvs;
    if (std::all_of(wanted.begin(), wanted.end(), [](std::uint32_t uv) { return uv == no_index; })) return;
    for (const std::uint32_t uv : wanted) file.mesh.corner_uvs.push_back(uv == no_index ? Vec2f{} : file.uvs[uv]);
}

// The vertices of a part run from the lowest to the highest that its faces use.
void assign_vertices(Mesh& mesh, Part& part) {
    const auto first = mesh.face_vertices.begin() + mesh.face_starts[part.first_face];
    const auto last = mesh.face_vertices.begin() + mesh.face_starts[part.first_face + part.face_count];
    const auto [low, high] = std::minmax_element(first, last);
    part.first_vertex = *low;
    part.vertex_count = *high - *low + 1;
}

}  // namespace

Mesh parse_obj(std::span<const std::byte> bytes) {
    check_text(bytes, "obj");
    ObjFile file{Lines(as_text(bytes), "obj"), {}, {}, 0, {}, {}, {}, {}, {}, false, false, {}, {}};
    read_statements(file);
    check_all(file);
    assign_uvs(file);
    for (Part& part : file.mesh.parts) assign_vertices(file.mesh, part);
    return std::move(file.mesh);
}

}  // namespace mien
