// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// Writes face definitions as BIFS text. One Coordinate holds all vertices of the head, so that their numbers are those
// of the mesh; every IndexedFaceSet uses it. Displacements are in units of the FAP, written with as few digits as give
// the same number back when they are multiplied by the unit.

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "io/bifs_text.hpp"
#include "io/fdp_points.hpp"
#include "io/scene_tree.hpp"
#include "io/text.hpp"

#include "mien/error.hpp"
#include "mien/io/fdp_text.hpp"

namespace mien {

namespace {

// ---- numbers

// The number with the fewest digits that `reads_back` accepts; all that a double has where none is accepted.
template <class ReadsBack>
void append_shortest(std::string& text, double number, const ReadsBack& reads_back) {
    constexpr int fewest = 6;
    std::array<char, 40> buffer;
    for (int digits = fewest; digits <= std::numeric_limits<double>::max_digits10; ++digits) {
        char* end =
            std::to_chars(buffer.data(), buffer.data() + buffer.size(), number, std::chars_format::general, digits).ptr;
        double read = 0;
        std::from_chars(buffer.data(), end, read);
        if (!reads_back(read) && digits < std::numeric_limits<double>::max_digits10) continue;
        text.append(buffer.data(), end);
        return;
    }
}

// What times the unit is this number.
void append_in_units(std::string& text, float number, double unit) {
    if (number == 0) {
        text += std::signbit(number) ? "-0" : "0";
        return;
    }
    append_shortest(text, number / unit, [&](double read) { return static_cast<float>(unit * read) == number; });
}

void append_vector(std::string& text, const Vec3f& v, double unit) {
    append_in_units(text, v.x, unit);
    text += ' ';
    append_in_units(text, v.y, unit);
    text += ' ';
    append_in_units(text, v.z, unit);
}

void append_position(std::string& text, const Vec3f& v) {
    append_number(text, v.x);
    text += ' ';
    append_number(text, v.y);
    text += ' ';
    append_number(text, v.z);
}

void append_vector(std::string& text, const Vec3& v) {
    append_number(text, v.x);
    text += ' ';
    append_number(text, v.y);
    text += ' ';
    append_number(text, v.z);
}

// A double is not always a product of a unit and another one; the quotient gives the nearest that is, and itself again.
Vec3 in_units(const Vec3& v, double unit) {
    return {v.x / unit, v.y / unit, v.z / unit};
}

std::string escaped(std::string_view text) {
    std::string quoted;
    for (const char c : text) {
        if (c == '"' || c == '\\') quoted += '\\';
        quoted += c;
    }
    return quoted;
}

// ---- the writer

class Writer {
public:
    explicit Writer(const Fdp& fdp) : fdp_(fdp), tree_(scene_tree(fdp.mesh, fdp.fat)) {
        for (const FatNode& node : fdp.fat.nodes) node_names_.push_back(unique_name(node.name));
    }

    std::string write() {
        text_ = "# MPEG-4 face definition as BIFS text, by mien\nGroup {\n  children [\n";
        add_world();
        if (has_units_only()) return std::move(text_) + "  ]\n}\n";
        add_face();
        return std::move(text_) + "  ]\n}\n";
    }

private:
    std::string unique_name(const std::string& name) {
        const std::string plain = bifs_name(name);
        std::string unique = plain;
        while (unique.empty() || !names_.insert(unique).second) unique = fmt::format("{}%_{}", plain, ++used_[plain]);
        return unique;
    }

    [[nodiscard]] bool has_units() const {
        return std::any_of(named_units.begin(), named_units.end(),
                           [&](const NamedUnit& u) { return fdp_.fapu.*(u.distance) > 0; });
    }

    [[nodiscard]] bool has_units_only() const {
        const TreeNode& scene = tree_.nodes.back();
        return has_units() && fdp_.points.empty() && scene.shapes.empty() && scene.nodes.empty();
    }

    void add_world() {
        text_ += "    WorldInfo {\n      title \"Face definition\"\n      info [";
        if (has_units()) {
            text_ += " \"FAPU";
            for (const NamedUnit& unit : named_units) {
                text_ += fmt::format(" {} ", unit.name);
                append_number(text_, fdp_.fapu.*(unit.distance));
            }
            text_ += '"';
        }
        if (!fdp_.mesh.unit.empty()) text_ += fmt::format(" \"unit {}\"", escaped(fdp_.mesh.unit));
        text_ += " ]\n    }\n";
    }

    void add_face() {
        text_ += "    Face {\n      fdp FDP {\n";
        if (!fdp_.points.empty()) add_points();
        if (const TreeNode& scene = tree_.nodes.back(); !scene.shapes.empty() || !scene.nodes.empty()) {
            text_ += "        faceSceneGraph [\n";
            add_node(scene, "          ");
            text_ += "        ]\n";
        }
        if (!fdp_.fat.tables.empty()) {
            text_ += "        faceDefTables [\n";
            for (const FaceDefTables& table : fdp_.fat.tables) add_table(table);
            text_ += "        ]\n";
        }
        text_ += "      }\n    }\n";
    }

    void add_points() {
        text_ += "        featurePointsCoord Coordinate { point [\n";
        for (const StandardPoint& standard : standard_points()) {
            const auto i = find_point(fdp_.points, standard.id);
            text_ += "          ";
            if (i)
                append_vector(text_, fdp_.points[*i].position);
            else
                text_ += "+inf +inf +inf";
            text_ += fmt::format(" # {}\n", standard.id);
        }
        text_ += "        ] }\n";
    }

    void add_node(const TreeNode& node, const std::string& margin) {
        for (const std::uint32_t inner : node.nodes) {
            text_ += fmt::format("{}DEF {} Transform {{\n{}  center ", margin, node_names_[inner], margin);
            append_vector(text_, fdp_.fat.nodes[inner].centre);
            text_ += fmt::format("\n{}  children [\n", margin);
            add_node(tree_.nodes[inner], margin + "    ");
            text_ += fmt::format("{}  ]\n{}}}\n", margin, margin);
        }
        for (const TreeShape& shape : node.shapes) add_shape(shape, margin);
    }

    void add_shape(const TreeShape& shape, const std::string& margin) {
        const bool is_first = shape_name_.empty();
        const std::string name = unique_name(shape.name);
        if (is_first) shape_name_ = name;
        text_ += fmt::format("{}Shape {{\n{}  appearance Appearance {{ material Material {{ }} }}\n", margin, margin);
        text_ += fmt::format("{}  geometry DEF {} IndexedFaceSet {{\n", margin, name);
        add_coordinates(is_first, margin + "    ");
        add_faces(shape, margin + "    ");
        text_ += fmt::format("{}  }}\n{}}}\n", margin, margin);
    }

    // All vertices and all texture coordinates of the head stand in its first shape.
    void add_coordinates(bool is_first, const std::string& margin) {
        if (!is_first) {
            text_ += fmt::format("{}coord USE {}\n", margin, vertices_name_);
            if (!fdp_.mesh.corner_uvs.empty()) text_ += fmt::format("{}texCoord USE {}\n", margin, uvs_name_);
            return;
        }
        vertices_name_ = unique_name("Vertices");
        text_ += fmt::format("{}coord DEF {} Coordinate {{ point [\n", margin, vertices_name_);
        for (const Vec3f& position : fdp_.mesh.positions) {
            append_position(text_, position);
            text_ += '\n';
        }
        text_ += fmt::format("{}] }}\n", margin);
        if (!fdp_.mesh.corner_uvs.empty()) add_uvs(margin);
    }

    void add_uvs(const std::string& margin) {
        uvs_name_ = unique_name("TextureCoordinates");
        text_ += fmt::format("{}texCoord DEF {} TextureCoordinate {{ point [\n", margin, uvs_name_);
        std::map<std::pair<float, float>, std::uint32_t> known;
        for (const Vec2f& uv : fdp_.mesh.corner_uvs) {
            const auto [found, is_new] = known.emplace(std::pair(uv.x, uv.y), static_cast<std::uint32_t>(known.size()));
            uv_corners_.push_back(found->second);
            if (!is_new) continue;
            append_number(text_, uv.x);
            text_ += ' ';
            append_shortest(text_, 1 - static_cast<double>(uv.y),
                            [&](double read) { return static_cast<float>(1 - read) == uv.y; });
            text_ += '\n';
        }
        text_ += fmt::format("{}] }}\n", margin);
    }

    void add_faces(const TreeShape& shape, const std::string& margin) {
        add_corners(shape, margin, "coordIndex", fdp_.mesh.face_vertices);
        if (!uv_corners_.empty()) add_corners(shape, margin, "texCoordIndex", uv_corners_);
    }

    void add_corners(const TreeShape& shape, const std::string& margin, std::string_view field,
                     const std::vector<std::uint32_t>& corners) {
        text_ += fmt::format("{}{} [\n", margin, field);
        for (const std::uint32_t f : shape.faces) {
            for (std::uint32_t c = fdp_.mesh.face_starts[f]; c < fdp_.mesh.face_starts[f + 1]; ++c) {
                append_integer(corners[c]);
                text_ += ' ';
            }
            text_ += "-1\n";
        }
        text_ += fmt::format("{}]\n", margin);
    }

    void append_integer(std::uint32_t number) {
        std::array<char, 12> buffer;
        text_.append(buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), number).ptr);
    }

    [[nodiscard]] double unit(int fap) const {
        if (fap <= 2) return 1;
        const double length = unit_length(fdp_.fapu, fap_info(fap).unit);
        if (!(length > least_unit))
            throw Error(fmt::format("fdp text: expected the unit of FAP {} ({}) above 0, found {}", fap,
                                    fap_info(fap).name, length));
        return length;
    }

    void add_table(const FaceDefTables& table) {
        text_ += fmt::format("          FaceDefTables {{\n            fapID {}\n", table.fap);
        if (table.high_level_select > 0)
            text_ += fmt::format("            highLevelSelect {}\n", table.high_level_select);
        if (!table.meshes.empty()) {
            text_ += "            faceDefMesh [\n";
            for (const FaceDefMesh& mesh : table.meshes) add_mesh(mesh, unit(table.fap));
            text_ += "            ]\n";
        }
        if (!table.transforms.empty()) {
            text_ += "            faceDefTransform [\n";
            for (const FaceDefTransform& transform : table.transforms) add_transform(transform, table.fap);
            text_ += "            ]\n";
        }
        text_ += "          }\n";
    }

    void add_mesh(const FaceDefMesh& mesh, double unit) {
        text_ += fmt::format("              FaceDefMesh {{\n                faceSceneGraphNode USE {}\n", shape_name_);
        text_ += fmt::format("                intervalBorders [ {} ]\n                coordIndex [",
                             fmt::join(mesh.borders, " "));
        for (const std::uint32_t v : mesh.vertices) {
            text_ += ' ';
            append_integer(v);
        }
        text_ += " ]\n                displacements [\n";
        for (const Vec3f& d : mesh.displacements) {
            append_vector(text_, d, unit);
            text_ += '\n';
        }
        text_ += "                ]\n              }\n";
    }

    // The numbers of the fields are those of the coding table of the standard's Transform.
    void add_transform(const FaceDefTransform& transform, int fap) {
        const auto begin = [&](int id, std::string_view field) {
            text_ += fmt::format("              FaceDefTransform {{ faceSceneGraphNode USE {} fieldId {} {} ",
                                 node_names_[transform.node], id, field);
        };
        if (transform.field == TransformField::rotation) {
            begin(2, "rotationDef");
            append_vector(text_, transform.axis);
            text_ += ' ';
            append_number(text_, transform.angle / unit_length(fdp_.fapu, FapUnit::angle));
        } else if (transform.field == TransformField::scale) {
            begin(3, "scaleDef");
            append_vector(text_, in_units(transform.scale, unit(fap)));
        } else {
            begin(5, "translationDef");
            append_vector(text_, in_units(transform.translation, unit(fap)));
        }
        text_ += " }\n";
    }

    const Fdp& fdp_;
    SceneTree tree_;
    std::set<std::string> names_;
    std::map<std::string, int> used_;  // how often each was asked for again
    std::vector<std::string> node_names_;
    std::string shape_name_, vertices_name_, uvs_name_, text_;
    std::vector<std::uint32_t> uv_corners_;
};

}  // namespace

std::string format_fdp_text(const Fdp& fdp) {
    check_fat(fdp.fat, vertex_count(fdp.mesh));
    return Writer(fdp).write();
}

}  // namespace mien
