// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/io/fdp_json.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <string_view>
#include <utility>

#include "io/fdp_points.hpp"
#include "io/json_text.hpp"
#include "io/text.hpp"

#include "mien/error.hpp"

namespace mien {

namespace {

using nlohmann::json;

// A value with the place where it lies.
struct Node {
    const json& value;
    std::string place;

    [[noreturn]] void fail(std::string_view expected) const {
        throw Error(
            fmt::format("fdp {}: expected {}, found {}", place.empty() ? "/" : place, expected, shown_json(value)));
    }
    [[nodiscard]] bool has(std::string_view key) const { return value.contains(key); }
};

void check_keys(const Node& node, std::initializer_list<std::string_view> known) {
    if (!node.value.is_object()) node.fail("an object");
    for (const auto& member : node.value.items()) {
        const std::string_view key = member.key();
        if (key.starts_with('_') || std::find(known.begin(), known.end(), key) != known.end()) continue;
        throw Error(fmt::format("fdp {}{}: expected none but the keys {}, found another", node.place,
                                json_pointer({key}), fmt::join(known, ", ")));
    }
}

Node member(const Node& node, std::string_view key) {
    const auto found = node.value.find(std::string(key));
    if (found == node.value.end())
        throw Error(fmt::format("fdp {}: expected the key {}, found none", node.place.empty() ? "/" : node.place, key));
    return {*found, node.place + json_pointer({key})};
}

Node element(const Node& node, std::size_t i) {
    return {node.value[i], fmt::format("{}/{}", node.place, i)};
}

const Node& array_of(const Node& node) {
    if (!node.value.is_array()) node.fail("an array");
    return node;
}

double number_of(const Node& node) {
    if (!node.value.is_number()) node.fail("a number");
    const auto number = node.value.get<double>();
    if (!std::isfinite(number)) node.fail("a finite number");
    return number;
}

template <class Integer>
bool fits(const json& value) {
    using Limits = std::numeric_limits<Integer>;
    if (value.is_number_unsigned()) return value.get<std::uint64_t>() <= std::uint64_t{Limits::max()};
    return value.is_number_integer() && value.get<std::int64_t>() >= std::int64_t{Limits::min()};
}

template <class Integer>
[[noreturn]] void fail_integer(const Node& node) {
    node.fail(std::numeric_limits<Integer>::min() < 0 ? "a whole number of 32 bits" : "a whole number from 0");
}

template <class Integer>
Integer integer_of(const Node& node) {
    if (!fits<Integer>(node.value)) fail_integer<Integer>(node);
    return node.value.get<Integer>();
}

std::string text_of(const Node& node) {
    if (!node.value.is_string()) node.fail("a text");
    return node.value.get<std::string>();
}

template <class Read>
auto list_of(const Node& node, const Read& read) {
    std::vector<decltype(read(node))> list;
    list.reserve(array_of(node).value.size());
    for (std::size_t i = 0; i < node.value.size(); ++i) list.push_back(read(element(node, i)));
    return list;
}

// Floats in rows of `tuple`; read without a place for each, which takes the time of the rest.
std::vector<float> floats_of(const Node& node, std::size_t tuple) {
    std::vector<float> numbers;
    numbers.reserve(array_of(node).value.size());
    for (std::size_t i = 0; i < node.value.size(); ++i) {
        const json& value = node.value[i];
        const float number = value.is_number() ? value.get<float>() : std::numeric_limits<float>::infinity();
        if (!std::isfinite(number)) element(node, i).fail("a number that a float can hold");
        numbers.push_back(number);
    }
    if (numbers.size() % tuple != 0) node.fail(fmt::format("a multiple of {} numbers", tuple));
    return numbers;
}

std::vector<Vec3f> vectors_of(const Node& node) {
    const std::vector<float> numbers = floats_of(node, 3);
    std::vector<Vec3f> vectors;
    vectors.reserve(numbers.size() / 3);
    for (std::size_t i = 0; i < numbers.size(); i += 3) vectors.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
    return vectors;
}

Vec3 vector_of(const Node& node) {
    if (!node.value.is_array() || node.value.size() != 3) node.fail("three numbers");
    return {number_of(element(node, 0)), number_of(element(node, 1)), number_of(element(node, 2))};
}

template <class Integer>
std::vector<Integer> integers_of(const Node& node) {
    std::vector<Integer> integers;
    integers.reserve(array_of(node).value.size());
    for (std::size_t i = 0; i < node.value.size(); ++i) {
        if (!fits<Integer>(node.value[i])) fail_integer<Integer>(element(node, i));
        integers.push_back(node.value[i].get<Integer>());
    }
    return integers;
}

// ---- the model

void read_faces(const Node& node, Mesh& mesh) {
    for (std::size_t f = 0; f < array_of(node).value.size(); ++f) {
        const std::vector<std::uint32_t> corners = integers_of<std::uint32_t>(element(node, f));
        if (corners.size() < 3) element(node, f).fail("three corners or more");
        if (*std::max_element(corners.begin(), corners.end()) >= mesh.positions.size())
            element(node, f).fail(fmt::format("vertices below {}", mesh.positions.size()));
        add_face(mesh, corners);
    }
}

// The first and the number of a part's vertices or faces, of which the mesh has so many.
std::pair<std::uint32_t, std::uint32_t> run_of(const Node& node, std::size_t all) {
    const std::vector<std::uint32_t> run = integers_of<std::uint32_t>(node);
    if (run.size() != 2 || std::size_t{run[0]} + run[1] > all)
        node.fail(fmt::format("the first and the number of some of {}", all));
    return {run[0], run[1]};
}

Part read_part(const Node& node, const Mesh& mesh) {
    check_keys(node, {"name", "mesh", "primitive", "vertices", "faces"});
    const auto [first_vertex, vertices] = run_of(member(node, "vertices"), mesh.positions.size());
    const auto [first_face, faces] = run_of(member(node, "faces"), face_count(mesh));
    const auto number = integer_of<std::uint32_t>;
    return {text_of(member(node, "name")),
            number(member(node, "mesh")),
            number(member(node, "primitive")),
            first_vertex,
            vertices,
            first_face,
            faces};
}

Mesh read_mesh(const Node& file) {
    Mesh mesh;
    if (file.has("unit")) mesh.unit = text_of(member(file, "unit"));
    if (file.has("positions")) mesh.positions = vectors_of(member(file, "positions"));
    if (file.has("faces")) read_faces(member(file, "faces"), mesh);
    if (file.has("uvs")) {
        const std::vector<float> uvs = floats_of(member(file, "uvs"), 2);
        if (uvs.size() != 2 * mesh.face_vertices.size())
            throw Error(fmt::format("fdp /uvs: expected two numbers for each of {} corners, found {}",
                                    mesh.face_vertices.size(), uvs.size()));
        for (std::size_t i = 0; i < uvs.size(); i += 2) mesh.corner_uvs.push_back({uvs[i], uvs[i + 1]});
    }
    if (file.has("parts"))
        mesh.parts = list_of(member(file, "parts"), [&](const Node& node) { return read_part(node, mesh); });
    return mesh;
}

// ---- points, units and tables

std::vector<FeaturePoint> read_points(const Node& node, const Mesh& mesh) {
    if (!node.value.is_object()) node.fail("an object");
    std::vector<FeaturePoint> points;
    for (const auto& entry : node.value.items()) {
        if (entry.key().starts_with('_')) continue;
        points.push_back(
            {entry.key(), 0, vector_of(Node{entry.value(), node.place + json_pointer({entry.key()})}), {}, 0});
    }
    const auto rank = [](const FeaturePoint& point) {
        const std::span<const StandardPoint> all = standard_points();
        return std::find_if(all.begin(), all.end(), [&](const StandardPoint& p) { return p.id == point.id; }) -
               all.begin();
    };
    std::stable_sort(points.begin(), points.end(),
                     [&](const FeaturePoint& a, const FeaturePoint& b) { return rank(a) < rank(b); });
    name_vertices(points, mesh);
    return points;
}

Fapu read_units(const Node& node) {
    check_keys(node, {"IRISD0", "ES0", "ENS0", "MNS0", "MW0"});
    Fapu fapu;
    for (const NamedUnit& unit : named_units) {
        if (!node.has(unit.name)) continue;
        const Node value = member(node, unit.name);
        if (number_of(value) < 0) value.fail("a distance from 0");
        fapu.*(unit.distance) = number_of(value);
    }
    return fapu;
}

FatNode read_node(const Node& node) {
    check_keys(node, {"name", "centre", "vertices"});
    return {text_of(member(node, "name")), integers_of<std::uint32_t>(member(node, "vertices")),
            vector_of(member(node, "centre"))};
}

FaceDefMesh read_def_mesh(const Node& node) {
    check_keys(node, {"borders", "vertices", "displacements"});
    return {integers_of<std::int32_t>(member(node, "borders")), integers_of<std::uint32_t>(member(node, "vertices")),
            vectors_of(member(node, "displacements"))};
}

FaceDefTransform read_transform(const Node& node) {
    check_keys(node, {"node", "axis", "angle", "translation", "scale"});
    FaceDefTransform transform;
    transform.node = integer_of<std::uint32_t>(member(node, "node"));
    if (node.has("translation")) {
        transform.field = TransformField::translation;
        transform.translation = vector_of(member(node, "translation"));
    } else if (node.has("scale")) {
        transform.field = TransformField::scale;
        transform.scale = vector_of(member(node, "scale"));
    } else {
        transform.axis = vector_of(member(node, "axis"));
        transform.angle = number_of(member(node, "angle"));
    }
    return transform;
}

FaceDefTables read_table(const Node& node) {
    check_keys(node, {"fap", "select", "meshes", "transforms"});
    FaceDefTables table;
    table.fap = integer_of<std::int32_t>(member(node, "fap"));
    if (node.has("select")) table.high_level_select = integer_of<std::int32_t>(member(node, "select"));
    if (node.has("meshes")) table.meshes = list_of(member(node, "meshes"), read_def_mesh);
    if (node.has("transforms")) table.transforms = list_of(member(node, "transforms"), read_transform);
    return table;
}

}  // namespace

Fdp parse_fdp_json(std::span<const std::byte> bytes) {
    const std::string_view text = as_text(bytes);
    check_json_depth(text, "fdp");
    const json value = parse_json(text, "fdp");
    const Node file{value, ""};
    check_keys(file, {"unit", "units", "points", "positions", "faces", "uvs", "parts", "nodes", "tables"});
    Fdp fdp;
    fdp.mesh = read_mesh(file);
    if (file.has("points")) fdp.points = read_points(member(file, "points"), fdp.mesh);
    fdp.fapu = file.has("units") ? read_units(member(file, "units")) : units_of_points(fdp.points);
    if (file.has("nodes")) fdp.fat.nodes = list_of(member(file, "nodes"), read_node);
    if (file.has("tables")) fdp.fat.tables = list_of(member(file, "tables"), read_table);
    check_fat(fdp.fat, vertex_count(fdp.mesh));
    return fdp;
}

namespace {

std::string quoted(const std::string& text) {
    return json(text).dump(-1, ' ', false, json::error_handler_t::replace);
}

// Elements between commas, with line breaks now and then.
template <class List, class Append>
void append_list(std::string& text, const List& list, const Append& append, std::size_t per_line = 0) {
    text += '[';
    for (std::size_t i = 0; i < list.size(); ++i) {
        if (i > 0) text += ',';
        if (per_line > 0 && i % per_line == 0) text += '\n';
        append(list[i]);
    }
    text += ']';
}

class Writer {
public:
    explicit Writer(const Fdp& fdp) : fdp_(fdp) {}

    std::string write() {
        text_ = "{\n  \"unit\": " + quoted(fdp_.mesh.unit);
        add_units();
        add_points();
        add_mesh();
        if (!fdp_.fat.nodes.empty()) {
            begin("nodes");
            append_list(
                text_, fdp_.fat.nodes, [&](const FatNode& node) { add_node(node); }, 1);
        }
        if (!fdp_.fat.tables.empty()) {
            begin("tables");
            append_list(
                text_, fdp_.fat.tables, [&](const FaceDefTables& table) { add_table(table); }, 1);
        }
        return std::move(text_) + "\n}\n";
    }

private:
    void begin(std::string_view key) { text_ += fmt::format(",\n  \"{}\": ", key); }

    // A zero below zero needs its point: without one it is an integer, which has no such zero.
    template <class T>
    void add_number(T number) {
        append_number(text_, number);
        if (number == 0 && std::signbit(number)) text_ += ".0";
    }

    template <class T>
    void add_vector(const BasicVec3<T>& v) {
        add_number(v.x);
        text_ += ',';
        add_number(v.y);
        text_ += ',';
        add_number(v.z);
    }

    template <class Integers>
    void add_integers(const Integers& integers) {
        text_ += fmt::format("[{}]", fmt::join(integers, ","));
    }

    void add_units() {
        begin("units");
        text_ += '{';
        for (const NamedUnit& unit : named_units) {
            text_ += fmt::format("{}\"{}\": ", &unit == named_units.data() ? "" : ", ", unit.name);
            append_number(text_, fdp_.fapu.*(unit.distance));
        }
        text_ += '}';
    }

    void add_points() {
        if (fdp_.points.empty()) return;
        begin("points");
        text_ += '{';
        for (const FeaturePoint& point : fdp_.points) {
            text_ += fmt::format("{}\n    {}: [", &point == fdp_.points.data() ? "" : ",", quoted(point.id));
            add_vector(point.position);
            text_ += ']';
        }
        text_ += '}';
    }

    void add_mesh() {
        const Mesh& mesh = fdp_.mesh;
        if (mesh.positions.empty()) return;
        begin("positions");
        append_list(
            text_, mesh.positions, [&](const Vec3f& p) { add_vector(p); }, 1);
        std::vector<std::span<const std::uint32_t>> faces;
        for (std::size_t f = 0; f < face_count(mesh); ++f) faces.push_back(face(mesh, f));
        begin("faces");
        append_list(
            text_, faces, [&](std::span<const std::uint32_t> corners) { add_integers(corners); }, 8);
        if (!mesh.corner_uvs.empty()) {
            begin("uvs");
            append_list(
                text_, mesh.corner_uvs,
                [&](const Vec2f& uv) {
                    add_number(uv.x);
                    text_ += ',';
                    add_number(uv.y);
                },
                4);
        }
        if (mesh.parts.empty()) return;
        begin("parts");
        append_list(
            text_, mesh.parts,
            [&](const Part& part) {
                text_ +=
                    fmt::format(R"({{"name": {}, "mesh": {}, "primitive": {}, "vertices": [{},{}], "faces": [{},{}]}})",
                                quoted(part.name), part.mesh, part.primitive, part.first_vertex, part.vertex_count,
                                part.first_face, part.face_count);
            },
            1);
    }

    void add_node(const FatNode& node) {
        text_ += fmt::format(R"({{"name": {}, "centre": [)", quoted(node.name));
        add_vector(node.centre);
        text_ += R"(], "vertices": )";
        add_integers(node.vertices);
        text_ += '}';
    }

    void add_table(const FaceDefTables& table) {
        text_ += fmt::format("{{\"fap\": {}", table.fap);
        if (table.high_level_select > 0) text_ += fmt::format(", \"select\": {}", table.high_level_select);
        if (!table.meshes.empty()) {
            text_ += ", \"meshes\": ";
            append_list(
                text_, table.meshes, [&](const FaceDefMesh& mesh) { add_def_mesh(mesh); }, 1);
        }
        if (!table.transforms.empty()) {
            text_ += ", \"transforms\": ";
            append_list(
                text_, table.transforms, [&](const FaceDefTransform& transform) { add_transform(transform); }, 1);
        }
        text_ += '}';
    }

    void add_def_mesh(const FaceDefMesh& mesh) {
        text_ += "{\"borders\": ";
        add_integers(mesh.borders);
        text_ += ", \"vertices\": ";
        add_integers(mesh.vertices);
        text_ += ", \"displacements\": ";
        append_list(
            text_, mesh.displacements, [&](const Vec3f& d) { add_vector(d); }, 4);
        text_ += '}';
    }

    void add_transform(const FaceDefTransform& transform) {
        text_ += fmt::format("{{\"node\": {}, ", transform.node);
        if (transform.field == TransformField::rotation) {
            text_ += "\"axis\": [";
            add_vector(transform.axis);
            text_ += "], \"angle\": ";
            add_number(transform.angle);
        } else {
            const bool scales = transform.field == TransformField::scale;
            text_ += scales ? "\"scale\": [" : "\"translation\": [";
            add_vector(scales ? transform.scale : transform.translation);
            text_ += ']';
        }
        text_ += '}';
    }

    const Fdp& fdp_;
    std::string text_;
};

}  // namespace

std::string format_fdp_json(const Fdp& fdp) {
    check_fat(fdp.fat, vertex_count(fdp.mesh));
    return Writer(fdp).write();
}

}  // namespace mien
