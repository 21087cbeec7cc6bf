// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Reads FDP, FaceDefTables, FaceDefMesh and FaceDefTransform of ISO/IEC 14496-1 from BIFS text: what Laftsidis et al.,
// section 3, load into their player. The field that a FaceDefTransform changes is told by which of its three
// definitions is there, since sources differ about the numbers of `fieldId`.

#include "mien/io/fdp_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <numeric>
#include <optional>
#include <unordered_map>
#include <unordered_set>

#include "io/bifs_text.hpp"
#include "io/fdp_points.hpp"
#include "io/text.hpp"

#include "mien/error.hpp"

namespace mien {

namespace {

constexpr std::size_t most_nested = 64;

// A shape of the scene graph: where its vertices begin in the mesh, how many they are, and what was done to them.
struct Surface {
    std::size_t first_vertex = 0, vertices = 0;
    Affine map;
};

// A Transform with a name, and what its parents do.
struct Joint {
    std::uint32_t node = 0;  // of the table
    Affine parent;
    std::size_t first_face = 0, end_face = 0;
};

// The scene graph as a mesh.
class Graph {
public:
    explicit Graph(const BifsText& text) : text_(text) {}

    void add(const BifsField& children) {
        for (const BifsChild& child : children.nodes) visit(child, children.line, {}, 0);
        const std::size_t faces = face_count(mesh_);
        for (const auto& [transform, joint] : joints_) name_vertices(joint, faces);
        if (!textured_) mesh_.corner_uvs.clear();
    }

    [[nodiscard]] const Surface* surface(const BifsNode* node) const {
        const auto found = surfaces_.find(node);
        return found == surfaces_.end() ? nullptr : &found->second;
    }
    [[nodiscard]] const Joint* joint(const BifsNode* node) const {
        const auto found = joints_.find(node);
        return found == joints_.end() ? nullptr : &found->second;
    }
    Mesh& mesh() { return mesh_; }
    std::vector<FatNode>& nodes() { return nodes_; }

private:
    void visit(const BifsChild& child, std::size_t line, const Affine& world, std::size_t depth) {
        if (depth >= most_nested) fail_at_line(line, fmt::format("expected a scene at most {} deep", most_nested));
        if (child.node == no_bifs_node)
            fail_at_line(line, fmt::format("expected a node called {}, found none", shown(child.use)));
        const BifsNode& node = text_.nodes[child.node];
        if (!visited_.insert(&node).second)
            fail_at_line(line, fmt::format("expected each part of the head once, found {} again", shown(node.name)));
        if (node.type == "IndexedFaceSet") return add_surface(node, world);
        const bool transform = node.type == "Transform";
        const Affine local = transform ? map_of_transform(node) : Affine{};
        const Affine here = local == Affine{} ? world : world == Affine{} ? local : world * local;
        const std::size_t first_face = face_count(mesh_);
        for (const std::string_view field : {"children", "geometry"})
            if (const BifsField* children = find_field(node, field))
                for (const BifsChild& next : children->nodes) visit(next, children->line, here, depth + 1);
        if (transform && !node.name.empty()) add_joint(node, world, first_face);
    }

    void add_joint(const BifsNode& node, const Affine& parent, std::size_t first_face) {
        const Vec3 centre = vector_of(node, "center", {}) + vector_of(node, "translation", {});
        joints_.emplace(&node, Joint{static_cast<std::uint32_t>(nodes_.size()), parent, first_face, face_count(mesh_)});
        nodes_.push_back({plain_name(node.name), {}, parent == Affine{} ? centre : moved(parent, centre)});
    }

    // Those of its faces; all where it holds every face.
    void name_vertices(const Joint& joint, std::size_t faces) {
        std::vector<std::uint32_t>& vertices = nodes_[joint.node].vertices;
        if (joint.first_face == 0 && joint.end_face == faces) {
            vertices.resize(mesh_.positions.size());
            std::iota(vertices.begin(), vertices.end(), 0U);
            return;
        }
        const auto corner = [&](std::size_t f) {
            return mesh_.face_vertices.begin() + static_cast<std::ptrdiff_t>(mesh_.face_starts[f]);
        };
        vertices.assign(corner(joint.first_face), corner(joint.end_face));
        std::sort(vertices.begin(), vertices.end());
        vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    }

    void add_surface(const BifsNode& node, const Affine& world) {
        const BifsNode* coord = node_of(text_, node, "coord", "Coordinate");
        if (coord == nullptr) fail_at_line(node.line, "expected a coord of the IndexedFaceSet, found none");
        const Surface surface = add_positions(*coord, node.line, world);
        surfaces_.emplace(&node, surface);
        Part part;
        part.name = plain_name(node.name);
        part.mesh = static_cast<std::uint32_t>(mesh_.parts.size());
        part.first_vertex = static_cast<std::uint32_t>(surface.first_vertex);
        part.vertex_count = static_cast<std::uint32_t>(surface.vertices);
        part.first_face = static_cast<std::uint32_t>(face_count(mesh_));
        add_faces(node, surface);
        part.face_count = static_cast<std::uint32_t>(face_count(mesh_)) - part.first_face;
        mesh_.parts.push_back(std::move(part));
    }

    // Shapes may share their vertices, if they stand at the same place.
    Surface add_positions(const BifsNode& coord, std::size_t line, const Affine& world) {
        const auto [found, is_new] = coordinates_.emplace(&coord, Surface{mesh_.positions.size(), 0, world});
        if (!is_new && !(found->second.map == world))
            fail_at_line(line, "expected a shared Coordinate at one place, found it at two");
        if (!is_new) return found->second;
        const std::span<const double> numbers = numbers_of(coord, "point", 3);
        for (std::size_t i = 0; i < numbers.size(); i += 3) {
            const Vec3 p{numbers[i], numbers[i + 1], numbers[i + 2]};
            const Vec3f position = to_float(world == Affine{} ? p : moved(world, p));
            if (!is_finite(position)) fail_at_line(coord.line, "expected points that are finite, found others");
            mesh_.positions.push_back(position);
        }
        found->second.vertices = mesh_.positions.size() - found->second.first_vertex;
        return found->second;
    }

    void add_faces(const BifsNode& node, const Surface& surface) {
        const std::vector<std::int32_t> corners = integers_of(node, "coordIndex");
        const BifsNode* texture = node_of(text_, node, "texCoord", "TextureCoordinate");
        const std::span<const double> uvs =
            texture == nullptr ? std::span<const double>{} : numbers_of(*texture, "point", 2);
        std::vector<std::int32_t> uv_corners = integers_of(node, "texCoordIndex");
        if (uv_corners.empty()) uv_corners = corners;
        if (!uvs.empty() && uv_corners.size() < corners.size() - (corners.empty() || corners.back() >= 0 ? 0U : 1U))
            fail_at_line(node.line, fmt::format("expected {} numbers in texCoordIndex, found {}", corners.size(),
                                                uv_corners.size()));
        textured_ = textured_ || !uvs.empty();
        std::vector<std::uint32_t> face;
        std::vector<Vec2f> face_uvs;
        const auto close = [&] {
            if (face.size() >= 3) {
                add_face(mesh_, face);
                mesh_.corner_uvs.insert(mesh_.corner_uvs.end(), face_uvs.begin(), face_uvs.end());
            }
            face.clear();
            face_uvs.clear();
        };
        for (std::size_t i = 0; i < corners.size(); ++i) {
            if (corners[i] < 0) {
                close();
                continue;
            }
            face.push_back(vertex_at(node, corners[i], surface));
            face_uvs.push_back(uvs.empty() ? Vec2f{} : uv_at(node, uvs, uv_corners[i]));
        }
        close();
    }

    static std::uint32_t vertex_at(const BifsNode& node, std::int32_t index, const Surface& surface) {
        if (static_cast<std::size_t>(index) >= surface.vertices)
            fail_at_line(find_field(node, "coordIndex")->line,
                         fmt::format("expected a vertex below {}, found {}", surface.vertices, index));
        return static_cast<std::uint32_t>(surface.first_vertex + static_cast<std::size_t>(index));
    }

    // The picture's origin is its lower left corner here.
    static Vec2f uv_at(const BifsNode& node, std::span<const double> uvs, std::int32_t index) {
        const std::size_t count = uvs.size() / 2, i = index < 0 ? count : static_cast<std::size_t>(index);
        if (i >= count)
            fail_at_line(node.line, fmt::format("expected a texture coordinate below {}, found {}", count, index));
        const Vec2f uv{static_cast<float>(uvs[2 * i]), static_cast<float>(1 - uvs[2 * i + 1])};
        if (!std::isfinite(uv.x) || !std::isfinite(uv.y))
            fail_at_line(node.line, "expected texture coordinates that are finite, found others");
        return uv;
    }

    const BifsText& text_;
    Mesh mesh_;
    std::vector<FatNode> nodes_;
    bool textured_ = false;
    std::unordered_set<const BifsNode*> visited_;
    std::unordered_map<const BifsNode*, Surface> surfaces_, coordinates_;
    std::unordered_map<const BifsNode*, Joint> joints_;
};

// ---- tables

class Tables {
public:
    Tables(const BifsText& text, const Graph& graph, const Fapu& fapu, const FdpTextOptions& options)
        : text_(text), graph_(graph), fapu_(fapu), options_(options) {}

    [[nodiscard]] std::vector<FaceDefTables> read(const BifsField& field) const {
        std::vector<FaceDefTables> tables;
        for (const BifsChild& child : field.nodes) tables.push_back(table(node(child, field.line)));
        std::sort(tables.begin(), tables.end(), [](const FaceDefTables& a, const FaceDefTables& b) {
            return std::pair(a.fap, a.high_level_select) < std::pair(b.fap, b.high_level_select);
        });
        return tables;
    }

private:
    [[nodiscard]] const BifsNode& node(const BifsChild& child, std::size_t line) const {
        if (child.node == no_bifs_node)
            fail_at_line(line, fmt::format("expected a node called {}, found none", shown(child.use)));
        return text_.nodes[child.node];
    }

    static std::int32_t integer(const BifsNode& node, std::string_view name, std::int32_t otherwise) {
        const std::vector<std::int32_t> numbers = integers_of(node, name);
        if (numbers.size() > 1)
            fail_at_line(node.line, fmt::format("expected one number for {}, found {}", name, numbers.size()));
        return numbers.empty() ? otherwise : numbers.front();
    }

    [[nodiscard]] FaceDefTables table(const BifsNode& node) const {
        FaceDefTables table;
        table.fap = integer(node, "fapID", 1);
        if (table.fap < 1 || table.fap > static_cast<int>(fap_count))
            fail_at_line(node.line, fmt::format("expected a fapID from 1 to {}, found {}", fap_count, table.fap));
        if (table.fap <= 2) table.high_level_select = integer(node, "highLevelSelect", 1);
        if (const BifsField* meshes = find_field(node, "faceDefMesh"))
            for (const BifsChild& child : meshes->nodes)
                table.meshes.push_back(mesh(this->node(child, meshes->line), table.fap));
        if (const BifsField* transforms = find_field(node, "faceDefTransform"))
            for (const BifsChild& child : transforms->nodes) add_transforms(table, this->node(child, transforms->line));
        return table;
    }

    // What the numbers of a table are multiplied by.
    [[nodiscard]] double unit(const BifsNode& node, int fap) const {
        if (!options_.displacements_in_units || fap <= 2) return 1;
        const double length = unit_length(fapu_, fap_info(fap).unit);
        if (length > least_unit) return length;
        fail_at_line(node.line,
                     fmt::format("expected the unit of FAP {} ({}) from the points or a WorldInfo, found none", fap,
                                 fap_info(fap).name));
    }

    [[nodiscard]] const BifsNode& target(const BifsNode& node) const {
        const BifsField* field = find_field(node, "faceSceneGraphNode");
        if (field == nullptr || field->nodes.empty())
            fail_at_line(node.line, fmt::format("expected a faceSceneGraphNode of {}, found none", node.type));
        return this->node(field->nodes.front(), field->line);
    }

    [[nodiscard]] const Surface& surface(const BifsNode& node) const {
        const BifsNode* named = &target(node);
        if (named->type == "Shape") named = node_of(text_, *named, "geometry", "IndexedFaceSet");
        const Surface* found = graph_.surface(named);
        if (found == nullptr)
            fail_at_line(node.line, "expected an IndexedFaceSet of the faceSceneGraph, found another node");
        return *found;
    }

    [[nodiscard]] FaceDefMesh mesh(const BifsNode& node, int fap) const {
        const Surface& surface = this->surface(node);
        const std::vector<std::int32_t> vertices = integers_of(node, "coordIndex");
        const std::span<const double> numbers = numbers_of(node, "displacements", 3);
        FaceDefMesh mesh;
        mesh.borders = integers_of(node, "intervalBorders");
        check_counts(node, mesh.borders, vertices.size(), numbers.size() / 3);
        const double unit = this->unit(node, fap);
        const std::size_t intervals = mesh.borders.size() - 1;
        for (const std::size_t i : ascending(vertices)) {
            mesh.vertices.push_back(vertex_at(node, vertices[i], surface));
            for (std::size_t j = 0; j < intervals; ++j) {
                const double sign = options_.downward_below_zero && mesh.borders[j + 1] <= 0 ? -unit : unit;
                mesh.displacements.push_back(
                    displacement(surface.map, sign, numbers.subspan(3 * (i * intervals + j), 3)));
            }
        }
        return mesh;
    }

    static void check_counts(const BifsNode& node, const std::vector<std::int32_t>& borders, std::size_t vertices,
                             std::size_t displacements) {
        if (borders.size() < 2)
            fail_at_line(node.line, fmt::format("expected two intervalBorders or more, found {}", borders.size()));
        if (displacements != vertices * (borders.size() - 1))
            fail_at_line(node.line,
                         fmt::format("expected {} displacements for {} vertices and {} borders, found {}",
                                     vertices * (borders.size() - 1), vertices, borders.size(), displacements));
    }

    // The order in which the vertices ascend.
    static std::vector<std::size_t> ascending(const std::vector<std::int32_t>& vertices) {
        std::vector<std::size_t> order(vertices.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::stable_sort(order.begin(), order.end(),
                         [&](std::size_t a, std::size_t b) { return vertices[a] < vertices[b]; });
        return order;
    }

    static std::uint32_t vertex_at(const BifsNode& node, std::int32_t index, const Surface& surface) {
        if (index < 0 || static_cast<std::size_t>(index) >= surface.vertices)
            fail_at_line(node.line,
                         fmt::format("expected vertices below {} in coordIndex, found {}", surface.vertices, index));
        return static_cast<std::uint32_t>(surface.first_vertex + static_cast<std::size_t>(index));
    }

    static Vec3f displacement(const Affine& map, double unit, std::span<const double> d) {
        const Vec3 way{unit * d[0], unit * d[1], unit * d[2]};
        return to_float(map == Affine{} ? way : turned(map, way));
    }

    void add_transforms(FaceDefTables& table, const BifsNode& node) const {
        const Joint* joint = graph_.joint(&target(node));
        if (joint == nullptr)
            fail_at_line(node.line, "expected a Transform with a name in the faceSceneGraph, found another node");
        FaceDefTransform transform;
        transform.node = joint->node;
        if (find_field(node, "rotationDef") != nullptr) {
            const AxisAngle turn = axis_angle_of(node, "rotationDef");
            transform.field = TransformField::rotation;
            transform.axis = turned_axis(joint->parent, turn.axis);
            transform.angle = turn.angle * unit_length(fapu_, FapUnit::angle);
            table.transforms.push_back(transform);
        }
        add_stretches(table, node, *joint);
    }

    void add_stretches(FaceDefTables& table, const BifsNode& node, const Joint& joint) const {
        FaceDefTransform transform;
        transform.node = joint.node;
        if (find_field(node, "scaleDef") != nullptr) {
            transform.field = TransformField::scale;
            transform.scale = unit(node, table.fap) * vector_of(node, "scaleDef", {1, 1, 1});
            table.transforms.push_back(transform);
            transform.scale = {};
        }
        if (find_field(node, "translationDef") != nullptr) {
            transform.field = TransformField::translation;
            const Vec3 way = unit(node, table.fap) * vector_of(node, "translationDef", {});
            transform.translation = joint.parent == Affine{} ? way : turned(joint.parent, way);
            table.transforms.push_back(transform);
        }
    }

    static Vec3 turned_axis(const Affine& parent, const Vec3& axis) {
        if (parent == Affine{}) return axis;
        const Vec3 result = turned(parent, axis);
        return length(result) > 0 ? result / length(result) : axis;
    }

    const BifsText& text_;
    const Graph& graph_;
    const Fapu& fapu_;
    const FdpTextOptions& options_;
};

// ---- points and units

// Coordinates that no head has stand for those that are not given.
constexpr double not_given = 1e38;

std::vector<FeaturePoint> read_points(const BifsText& text, const BifsNode& fdp) {
    const BifsNode* coord = node_of(text, fdp, "featurePointsCoord", "Coordinate");
    if (coord == nullptr) return {};
    const std::span<const double> numbers = numbers_of(*coord, "point", 3);
    const std::span<const StandardPoint> standard = standard_points();
    if (numbers.size() != 3 * standard.size())
        fail_at_line(coord->line,
                     fmt::format("expected {} feature points, found {}", standard.size(), numbers.size() / 3));
    std::vector<FeaturePoint> points;
    for (std::size_t i = 0; i < standard.size(); ++i) {
        const std::span<const double> xyz = numbers.subspan(3 * i, 3);
        if (std::all_of(xyz.begin(), xyz.end(), [](double c) { return std::abs(c) < not_given; }))
            points.push_back({std::string(standard[i].id), 0, {xyz[0], xyz[1], xyz[2]}, {}, 0});
    }
    return points;
}

// Pairs of a name and a value in the strings of WorldInfo: "FAPU IRISD0 0.01 ES0 0.06 ...", "unit m".
struct World {
    Fapu fapu;
    std::string unit;
    bool tells = false;  // units of the face
};

void read_units(const BifsField& field, Words& words, World& world) {
    world.tells = true;
    for (std::string_view name = words.next(); !name.empty(); name = words.next()) {
        const auto known =
            std::find_if(named_units.begin(), named_units.end(), [&](const NamedUnit& u) { return u.name == name; });
        const std::string_view value = words.next();
        const std::optional<double> number = parse_double(value);
        if (known == named_units.end() || !number || !(*number >= 0) || !std::isfinite(*number))
            fail_at_line(field.line, fmt::format("expected a unit of the face and its size from 0, found {} {}",
                                                 shown(name), shown(value)));
        world.fapu.*(known->distance) = *number;
    }
}

World read_world(const BifsText& text) {
    World world;
    for (const BifsNode& node : text.nodes) {
        const BifsField* info = node.type == "WorldInfo" ? find_field(node, "info") : nullptr;
        if (info == nullptr) continue;
        for (const std::string& line : info->strings) {
            Words words(line);
            const std::string_view key = words.next();
            if (key == "FAPU") read_units(*info, words, world);
            if (key == "unit") world.unit = words.next();
        }
    }
    return world;
}

void read_face(const BifsText& text, const BifsNode& node, const FdpTextOptions& options, bool has_units, Fdp& fdp) {
    fdp.points = read_points(text, node);
    if (!has_units) fdp.fapu = units_of_points(fdp.points);
    Graph graph(text);
    if (const BifsField* scene = find_field(node, "faceSceneGraph")) graph.add(*scene);
    if (const BifsField* tables = find_field(node, "faceDefTables"))
        fdp.fat.tables = Tables(text, graph, fdp.fapu, options).read(*tables);
    fdp.mesh = std::move(graph.mesh());
    fdp.fat.nodes = std::move(graph.nodes());
    name_vertices(fdp.points, fdp.mesh);
    check_fat(fdp.fat, vertex_count(fdp.mesh));
}

}  // namespace

Fdp parse_fdp_text(std::span<const std::byte> bytes, const FdpTextOptions& options) {
    const BifsText text = parse_bifs(bytes);
    const World world = read_world(text);
    Fdp fdp;
    fdp.fapu = world.fapu;
    const auto face =
        std::find_if(text.nodes.begin(), text.nodes.end(), [](const BifsNode& n) { return n.type == "FDP"; });
    if (face == text.nodes.end() && !world.tells)
        throw Error("fdp: expected an FDP node, or FAPU in a WorldInfo, found neither");
    if (face != text.nodes.end()) read_face(text, *face, options, world.tells, fdp);
    fdp.mesh.unit = world.unit;
    return fdp;
}

}  // namespace mien
