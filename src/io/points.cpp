// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/io/points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <optional>
#include <string_view>
#include <tuple>

#include "io/json_text.hpp"
#include "io/text.hpp"

#include "mien/error.hpp"

namespace mien {

namespace {

using nlohmann::json;

// A position that lies farther from the surface than this part of the box diagonal is probably in another unit.
constexpr double far_snap = 0.05;

// ISO/IEC 14496-2, figure of the feature points: how many each of the groups 2 to 11 has, 84 in all.
bool is_mpeg4_id(std::string_view id) {
    constexpr std::array<int, 10> counts{14, 14, 6, 4, 4, 1, 10, 15, 10, 6};
    const std::size_t dot = id.find('.');
    if (dot == std::string_view::npos) return false;
    const std::optional<std::int64_t> group = parse_integer(id.substr(0, dot));
    const std::optional<std::int64_t> number = parse_integer(id.substr(dot + 1));
    if (!group || !number || *group < 2 || *group > 11) return false;
    return *number >= 1 && *number <= counts[static_cast<std::size_t>(*group - 2)] &&
           fmt::format("{}.{}", *group, *number) == id;
}

struct Reader {
    const Mesh& mesh;
    std::string prefix;                  // "/points" or nothing
    std::vector<std::uint32_t> surface;  // vertices that a face uses, ascending; filled when first needed
    double size = 0;                     // the box diagonal
    PointsFile result;
    std::map<std::tuple<double, double, double>, std::string> at_place;

    [[noreturn]] void fail(std::initializer_list<std::string_view> names, std::string_view sentence) const {
        throw Error(fmt::format("points {}{}: {}", prefix, json_pointer(names), sentence));
    }
};

std::vector<std::uint32_t> surface_vertices(const Mesh& mesh) {
    std::vector<std::uint32_t> vertices = mesh.face_vertices;
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
}

// An index below `count`.
std::uint32_t read_index(const Reader& reader, std::string_view id, const json& value, std::size_t count) {
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() >= count)
        reader.fail({id}, fmt::format("expected a vertex index from 0, below {}, found {}", count, shown_json(value)));
    return value.get<std::uint32_t>();
}

// ---- vertices of one mesh of the file

bool is_of_mesh(const Part& part, const json& mesh) {
    if (mesh.is_string()) return part.name == mesh.get_ref<const std::string&>();
    return mesh.is_number_unsigned() && mesh.get<std::uint64_t>() == part.mesh;
}

// The parts of the mesh that is named; a name that two meshes have tells nothing.
std::vector<Part> parts_of(const Reader& reader, std::string_view id, const json& mesh) {
    std::vector<Part> parts;
    for (const Part& part : reader.mesh.parts)
        if (is_of_mesh(part, mesh)) parts.push_back(part);
    if (parts.empty())
        reader.fail({id, "mesh"},
                    fmt::format("expected the name or number of a mesh in the file, found {}", shown_json(mesh)));
    for (const Part& part : parts)
        if (part.mesh != parts.front().mesh)
            reader.fail({id, "mesh"}, fmt::format("expected a name that one mesh has, found {} at meshes {} and {}",
                                                  shown_json(mesh), parts.front().mesh, part.mesh));
    return parts;
}

// Vertex `index` of a mesh, counted through its primitives.
std::uint32_t vertex_in(const Reader& reader, std::string_view id, const json& mesh, const json& index) {
    const std::vector<Part> parts = parts_of(reader, id, mesh);
    std::uint64_t count = 0;
    for (const Part& part : parts) count += part.vertex_count;
    std::uint32_t left = read_index(reader, id, index, count);
    for (const Part& part : parts) {
        if (left < part.vertex_count) return part.first_vertex + left;
        left -= part.vertex_count;
    }
    reader.fail({id}, "expected a vertex of the mesh, found none");
}

// ---- positions

double read_coordinate(const Reader& reader, std::string_view id, const json& value) {
    if (!value.is_number() ||
        !(std::abs(value.get<double>()) <= static_cast<double>(std::numeric_limits<float>::max())))
        reader.fail({id}, fmt::format("expected a finite coordinate, found {}", shown_json(value)));
    return value.get<double>();
}

Vec3 read_position(const Reader& reader, std::string_view id, const json& value) {
    if (!value.is_array() || value.size() != 3)
        reader.fail({id}, fmt::format("expected a position of three numbers, found {}", shown_json(value)));
    return {read_coordinate(reader, id, value[0]), read_coordinate(reader, id, value[1]),
            read_coordinate(reader, id, value[2])};
}

// The nearest vertex that a face uses; the first of several equally near.
std::uint32_t nearest(Reader& reader, std::string_view id, const Vec3& position) {
    if (reader.surface.empty()) reader.surface = surface_vertices(reader.mesh);
    if (reader.surface.empty()) reader.fail({id}, "expected a mesh with faces to snap to, found none");
    const auto square = [&](std::uint32_t v) {
        const Vec3 apart = to_double(reader.mesh.positions[v]) - position;
        return dot(apart, apart);
    };
    std::uint32_t best = reader.surface.front();
    double least = square(best);
    for (const std::uint32_t v : reader.surface)
        if (const double candidate = square(v); candidate < least) {
            best = v;
            least = candidate;
        }
    return best;
}

void snap(Reader& reader, const json& value, FeaturePoint& point) {
    const Vec3 position = read_position(reader, point.id, value);
    point.vertex = nearest(reader, point.id, position);
    point.snapped = distance(position, to_double(reader.mesh.positions[point.vertex]));
    if (point.snapped > far_snap * reader.size)
        reader.result.warnings.push_back(
            fmt::format("{}: the position lies {:.3g} away from the surface, {:.0f} % of the head's diagonal", point.id,
                        point.snapped, 100 * point.snapped / reader.size));
}

// ---- values

Axes read_moves(const Reader& reader, std::string_view id, const json& value) {
    const std::string text = value.is_string() ? value.get<std::string>() : "no text";
    std::array<bool, 3> moves{};
    for (const char c : text) {
        const std::size_t axis = std::string_view("xyz").find(c);
        if (axis == std::string_view::npos || moves[axis])
            reader.fail({id, "moves"},
                        fmt::format("expected some of the letters of \"xyz\", found {}", shown_json(value)));
        moves[axis] = true;
    }
    return {moves[0], moves[1], moves[2]};
}

void check_members(const Reader& reader, std::string_view id, const json& value) {
    for (const auto& member : value.items()) {
        const std::string_view key = member.key();
        if (!key.starts_with('_') && key != "vertex" && key != "mesh" && key != "position" && key != "moves")
            reader.fail({id, key}, "expected vertex, mesh, position or moves, found another key");
    }
    if (value.contains("vertex") == value.contains("position"))
        reader.fail({id}, "expected either a vertex or a position, found both or neither");
    if (value.contains("mesh") && value.contains("position"))
        reader.fail({id}, "expected a mesh only beside a vertex, found it beside a position");
}

void read_object(Reader& reader, const json& value, FeaturePoint& point) {
    check_members(reader, point.id, value);
    if (value.contains("moves")) point.moves = read_moves(reader, point.id, value["moves"]);
    if (value.contains("position")) return snap(reader, value["position"], point);
    point.vertex = value.contains("mesh") ? vertex_in(reader, point.id, value["mesh"], value["vertex"])
                                          : read_index(reader, point.id, value["vertex"], vertex_count(reader.mesh));
}

void refuse_shared_place(Reader& reader, const FeaturePoint& point) {
    const Vec3& p = point.position;
    const auto [place, is_new] = reader.at_place.try_emplace({p.x, p.y, p.z}, point.id);
    if (!is_new)
        reader.fail({point.id}, fmt::format("expected a place of its own, found the place of {} (vertex {})",
                                            shown(std::string_view(place->second)), point.vertex));
}

void read_point(Reader& reader, const std::string& id, const json& value) {
    if (id.empty()) reader.fail({id}, "expected the id of a feature point, found nothing");
    FeaturePoint point;
    point.id = id;
    if (value.is_object()) {
        read_object(reader, value, point);
    } else if (value.is_array()) {
        snap(reader, value, point);
    } else {
        point.vertex = read_index(reader, id, value, vertex_count(reader.mesh));
    }
    point.position = to_double(reader.mesh.positions[point.vertex]);
    refuse_shared_place(reader, point);
    if (!is_mpeg4_id(id))
        reader.result.warnings.push_back(
            fmt::format("{}: no feature point of MPEG-4; kept as a point of yours", shown(std::string_view(id))));
    reader.result.points.push_back(std::move(point));
}

void read_nested(Reader& reader, const JsonText& text) {
    const json& points = text.value["points"];
    reader.prefix = "/points";
    if (!points.is_object()) reader.fail({}, fmt::format("expected an object, found {}", shown_json(points)));
    for (const std::string& id : keys_of(text, "points")) read_point(reader, id, points[id]);
}

}  // namespace

PointsFile parse_points(std::span<const std::byte> bytes, const Mesh& mesh) {
    const JsonText text = parse_json_text(bytes, "points");
    Reader reader{mesh, {}, {}, diagonal(bounding_box(mesh)), {}, {}};
    if (text.value.contains("points")) {
        read_nested(reader, text);
    } else {
        for (const std::string& id : keys_of(text, "")) read_point(reader, id, text.value[id]);
    }
    if (reader.result.points.empty()) throw Error("points: expected feature points, found none");
    return std::move(reader.result);
}

namespace {

std::string moves_text(const Axes& moves) {
    return std::string(moves.x ? "x" : "") + (moves.y ? "y" : "") + (moves.z ? "z" : "");
}

}  // namespace

std::string format_points(std::span<const FeaturePoint> points) {
    std::string text = "{\n  \"points\": {";
    for (std::size_t i = 0; i < points.size(); ++i) {
        const FeaturePoint& p = points[i];
        text += fmt::format("{}\n    {}: ", i > 0 ? "," : "", json(p.id).dump());
        text += p.moves == Axes{} ? fmt::format("{}", p.vertex)
                                  : fmt::format(R"({{"vertex": {}, "moves": "{}"}})", p.vertex, moves_text(p.moves));
    }
    return text + "\n  }\n}\n";
}

}  // namespace mien
