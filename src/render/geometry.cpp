// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "render/geometry.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>
#include <optional>
#include <set>

#include "render/slopes.hpp"

#include "mien/error.hpp"

namespace mien {

namespace {

// A normal through the map: the inverse transpose, without its division.
Vec3f turned_normal(const Affine& map, const Vec3f& normal) {
    const auto& [a, b, c] = map.columns;
    const double side = determinant(map) < 0 ? -1 : 1;
    const Vec3 n = side * (static_cast<double>(normal.x) * cross(b, c) + static_cast<double>(normal.y) * cross(c, a) +
                           static_cast<double>(normal.z) * cross(a, b));
    const double size = length(n);
    return size > 0 ? to_float(n / size) : normal;
}

std::size_t vertices_of(const Scene& scene) {
    return std::accumulate(scene.surfaces.begin(), scene.surfaces.end(), std::size_t{0},
                           [](std::size_t sum, const Surface& surface) { return sum + surface.positions.size(); });
}

// Adds a surface's triangles, turned over where its rest map mirrors them.
void add_piece(Geometry& geometry, const Surface& surface, bool mirrored) {
    const auto first = static_cast<std::uint32_t>(geometry.positions.size() - surface.positions.size());
    const auto from = static_cast<std::uint32_t>(geometry.triangles.size());
    for (std::size_t i = 0; i + 2 < surface.triangles.size(); i += 3) {
        const std::uint32_t a = first + surface.triangles[i], b = first + surface.triangles[i + 1],
                            c = first + surface.triangles[i + 2];
        geometry.triangles.insert(geometry.triangles.end(), {a, mirrored ? c : b, mirrored ? b : c});
    }
    geometry.pieces.push_back({first, static_cast<std::uint32_t>(surface.positions.size()), from,
                               static_cast<std::uint32_t>(geometry.triangles.size()) - from, surface.material});
}

// Copies what every vertex has; normals stay zero where the file has none.
void add_vertices(Geometry& geometry, const Surface& surface) {
    const std::size_t size = geometry.positions.size() + surface.positions.size();
    geometry.positions.insert(geometry.positions.end(), surface.positions.begin(), surface.positions.end());
    geometry.normals.insert(geometry.normals.end(), surface.normals.begin(), surface.normals.end());
    geometry.uvs.insert(geometry.uvs.end(), surface.uvs.begin(), surface.uvs.end());
    geometry.normals.resize(size);
    geometry.uvs.resize(size);
}

using Row = std::vector<Rows::Entry>;

void close_row(Rows& rows, Row& row) {
    std::sort(row.begin(), row.end(), [](const auto& a, const auto& b) { return a.index < b.index; });
    for (const Rows::Entry& entry : row) {
        const bool same = rows.entries.size() > rows.starts.back() && rows.entries.back().index == entry.index;
        if (same)
            rows.entries.back().weight += entry.weight;
        else
            rows.entries.push_back(entry);
    }
    rows.starts.push_back(static_cast<std::uint32_t>(rows.entries.size()));
    row.clear();
}

// Sparse shapes as one row per vertex.
std::vector<Row> rows_of(std::span<const MorphTarget> shapes, std::size_t vertices, std::uint32_t first_amount) {
    std::vector<Row> rows(vertices);
    for (std::size_t s = 0; s < shapes.size(); ++s)
        for (std::size_t i = 0; i < shapes[s].vertices.size(); ++i) {
            if (shapes[s].vertices[i] >= vertices)
                throw Error(fmt::format("render: shape \"{}\": expected vertices below {}, found {}", shapes[s].name,
                                        vertices, shapes[s].vertices[i]));
            rows[shapes[s].vertices[i]].push_back(
                {first_amount + static_cast<std::uint32_t>(s), shapes[s].deltas[i], {}, {}});
        }
    return rows;
}

Rows::Entry joint_entry(std::uint32_t joint, float weight) {
    return {joint, {weight, weight, weight}, {}, {}};
}

// The joints of one vertex of a surface that moves as glTF says.
void add_joint_row(Geometry& geometry, const Surface& surface, std::size_t v, const SceneTables& tables) {
    Row row;
    if (surface.influences == 0) {
        row.push_back(joint_entry(surface.node, 1));
    } else {
        for (std::size_t i = v * surface.influences; i < (v + 1) * surface.influences; ++i)
            if (surface.weights[i] != 0)
                row.push_back(joint_entry(tables.skin_joints[*surface.skin] + surface.joints[i], surface.weights[i]));
    }
    close_row(geometry.joints, row);
}

void require_triangles(const Geometry& geometry) {
    if (geometry.triangles.empty()) throw Error("render: expected a scene with at least one triangle, found none");
}

// The map of every vertex of a surface as the scene rests: one for all without a skin.
struct RestMaps {
    std::vector<Affine> worlds;
    std::vector<std::vector<Affine>> skins;  // the joints' maps
};

RestMaps rest_maps(const Scene& scene) {
    const ScenePose pose = rest_pose(scene);
    RestMaps maps{pose.worlds, {}};
    for (const SceneSkin& skin : scene.skins) maps.skins.push_back(joint_maps(scene, skin, pose));
    return maps;
}

Affine map_at(const RestMaps& maps, const Surface& surface, std::size_t v) {
    if (surface.influences == 0) return maps.worlds[surface.node];
    Affine sum{{Vec3{}, Vec3{}, Vec3{}}, {}};
    for (std::size_t i = v * surface.influences; i < (v + 1) * surface.influences; ++i) {
        const Affine& joint = maps.skins[*surface.skin][surface.joints[i]];
        const double weight = surface.weights[i];
        for (std::size_t c = 0; c < 3; ++c) sum.columns[c] += weight * joint.columns[c];
        sum.offset += weight * joint.offset;
    }
    return sum;
}

// Puts the vertices of the last surface where they rest in the scene.
void bake(Geometry& geometry, const Surface& surface, const RestMaps& maps, std::span<const float> morph_weights) {
    const std::size_t first = geometry.positions.size() - surface.positions.size();
    for (std::size_t m = 0; m < surface.morphs.size() && m < morph_weights.size(); ++m)
        for (std::size_t i = 0; i < surface.morphs[m].vertices.size(); ++i)
            geometry.positions[first + surface.morphs[m].vertices[i]] += morph_weights[m] * surface.morphs[m].deltas[i];
    for (std::size_t v = 0; v < surface.positions.size(); ++v) {
        const Affine map = map_at(maps, surface, v);
        Vec3f& p = geometry.positions[first + v];
        Vec3f& n = geometry.normals[first + v];
        p = to_float(moved(map, to_double(p)));
        n = turned_normal(map, n);
    }
}

void check_sources(const Movement& movement, std::span<const std::uint32_t> sources) {
    if (movement.rig == nullptr) return;
    const std::size_t rigged = vertex_count(*movement.rig);
    for (const std::uint32_t v : sources)
        if (v >= rigged)
            throw Error(
                fmt::format("render: expected a rig with a row for vertex {}, found one of {} rows", v, rigged));
}

// The shapes of the rig's prior, then the movement's own.
std::vector<MorphTarget> all_shapes(const Movement& movement) {
    std::vector<MorphTarget> all;
    if (movement.rig != nullptr && movement.rig->prior) all = movement.rig->prior->shapes;
    all.insert(all.end(), movement.shapes.begin(), movement.shapes.end());
    return all;
}

// The rig's rows, the shapes' rows and the eyeballs' joints of every vertex.
void add_movement(Geometry& geometry, const Movement& movement, std::span<const std::uint32_t> sources) {
    const std::size_t vertices = geometry.positions.size();
    const Rig* rig = movement.rig;
    const auto points = static_cast<std::uint32_t>(rig != nullptr ? rig->points.size() : 0);
    std::size_t used = rig != nullptr ? vertex_count(*rig) : 0;
    for (const std::uint32_t source : sources) used = std::max<std::size_t>(used, source + 1U);
    const std::vector<MorphTarget> all = all_shapes(movement);
    const std::vector<Row> shapes = rows_of(all, used, points);
    std::vector<std::uint32_t> joint(shapes.size(), 0);
    for (std::size_t e = 0; rig != nullptr && e < rig->eyeballs.size(); ++e)
        for (const std::uint32_t v : rig->eyeballs[e].vertices) joint[v] = static_cast<std::uint32_t>(e + 1);
    Row row;
    for (std::size_t v = 0; v < vertices; ++v) {
        const std::uint32_t source = sources[v];
        if (rig != nullptr) {
            geometry.positions[v] = rig->rest[source];
            for (std::uint32_t e = rig->row_starts[source]; e < rig->row_starts[source + 1]; ++e)
                row.push_back({rig->row_points[e], rig->weights[e], {}, {}});
        }
        row.insert(row.end(), shapes[source].begin(), shapes[source].end());
        close_row(geometry.moves, row);
        row.push_back(joint_entry(joint[source], 1));
        close_row(geometry.joints, row);
    }
    geometry.amount_count = points + all.size();
    geometry.joint_count = 1 + (rig != nullptr ? rig->eyeballs.size() : 0);
}

// The material that all vertices of an eyeball wear, or nothing when there are several.
std::optional<std::uint32_t> only_material(const Geometry& geometry, const std::vector<bool>& on_eyeball) {
    std::set<std::uint32_t> worn;
    for (const Piece& piece : geometry.pieces)
        for (std::uint32_t v = piece.first_vertex; v < piece.first_vertex + piece.vertex_count; ++v)
            if (on_eyeball[v]) worn.insert(piece.material);
    return worn.size() == 1 ? std::optional(*worn.begin()) : std::nullopt;
}

// An eyeball of a single material is wet. Without a picture it has no iris of its own: its vertices get their direction
// as seen from its centre, so that one can be drawn.
void add_eye(Geometry& geometry, const Scene& scene, const Rig& rig, std::span<const std::uint32_t> sources,
             const Eyeball& eyeball) {
    std::vector<bool> in_rig(vertex_count(rig), false), on_eyeball(geometry.positions.size(), false);
    for (const std::uint32_t v : eyeball.vertices) in_rig[v] = true;
    for (std::size_t v = 0; v < on_eyeball.size(); ++v) on_eyeball[v] = in_rig[sources[v]];
    const auto material = only_material(geometry, on_eyeball);
    if (!material) return;
    for (Piece& piece : geometry.pieces)
        if (piece.material == *material && piece.vertex_count > 0 && on_eyeball[piece.first_vertex]) piece.wet = true;
    if (scene.materials[*material].colour_picture) return;
    Vec3 axis = eyeball.point ? rig.points[*eyeball.point].position - eyeball.centre : Vec3{0, 0, 1};
    if (!(length(axis) > 0)) axis = {0, 0, 1};
    const Vec3 z = axis / length(axis);
    const Vec3 across = cross(Vec3{0, 1, 0}, z);
    const Vec3 x = length(across) > 1e-6 ? across / length(across) : Vec3{1, 0, 0};
    const Vec3 y = cross(z, x);
    geometry.eyes.resize(geometry.positions.size());
    for (std::size_t v = 0; v < on_eyeball.size(); ++v) {
        const Vec3 d = to_double(geometry.positions[v]) - eyeball.centre;
        if (on_eyeball[v] && length(d) > 0)
            geometry.eyes[v] = to_float(Vec3{dot(d, x), dot(d, y), dot(d, z)} / length(d));
    }
}

}  // namespace

std::vector<std::uint32_t> mesh_vertices(const Scene& scene) {
    std::vector<std::uint32_t> list;
    for (const Surface& surface : scene.surfaces) {
        list.insert(list.end(), surface.mesh_vertices.begin(), surface.mesh_vertices.end());
        if (!surface.mesh_vertices.empty()) continue;
        const std::uint32_t next = list.empty() ? 0 : list.back() + 1;
        list.resize(list.size() + surface.positions.size());
        std::iota(list.end() - static_cast<std::ptrdiff_t>(surface.positions.size()), list.end(), next);
    }
    return list;
}

SceneTables tables_of(const Scene& scene) {
    SceneTables tables;
    tables.node_amounts.assign(scene.nodes.size() + 1, 0);
    for (const Surface& surface : scene.surfaces) {
        std::uint32_t& count = tables.node_amounts[surface.node + 1];
        count = std::max(count, static_cast<std::uint32_t>(surface.morphs.size()));
    }
    std::partial_sum(tables.node_amounts.begin(), tables.node_amounts.end(), tables.node_amounts.begin());
    tables.joints = static_cast<std::uint32_t>(scene.nodes.size());
    for (const SceneSkin& skin : scene.skins) {
        tables.skin_joints.push_back(tables.joints);
        tables.joints += static_cast<std::uint32_t>(skin.joints.size());
    }
    return tables;
}

Geometry geometry_of(const Scene& scene) {
    const SceneTables tables = tables_of(scene);
    const RestMaps maps = rest_maps(scene);
    Geometry geometry;
    geometry.amount_count = tables.node_amounts.back();
    geometry.joint_count = tables.joints;
    for (const Surface& surface : scene.surfaces) {
        add_vertices(geometry, surface);
        const bool mirrored = !surface.positions.empty() && determinant(map_at(maps, surface, 0)) < 0;
        geometry.hands.resize(geometry.positions.size(), mirrored ? -1.0F : 1.0F);
        add_piece(geometry, surface, mirrored);
        std::vector<Row> morphs = rows_of(surface.morphs, surface.positions.size(), tables.node_amounts[surface.node]);
        for (std::size_t v = 0; v < surface.positions.size(); ++v) {
            close_row(geometry.moves, morphs[v]);
            add_joint_row(geometry, surface, v, tables);
        }
    }
    require_triangles(geometry);
    add_slopes(geometry);
    return geometry;
}

Geometry geometry_of(const Scene& scene, const Movement& movement) {
    const RestMaps maps = rest_maps(scene);
    const ScenePose rest = rest_pose(scene);
    Geometry geometry;
    geometry.positions.reserve(vertices_of(scene));
    for (const Surface& surface : scene.surfaces) {
        add_vertices(geometry, surface);
        bake(geometry, surface, maps, rest.morph_weights[surface.node]);
        add_piece(geometry, surface, !surface.positions.empty() && determinant(map_at(maps, surface, 0)) < 0);
    }
    geometry.hands.assign(geometry.positions.size(), 1.0F);
    require_triangles(geometry);
    const std::vector<std::uint32_t> sources = mesh_vertices(scene);
    check_sources(movement, sources);
    add_movement(geometry, movement, sources);
    if (movement.rig != nullptr) {
        for (const Eyeball& eyeball : movement.rig->eyeballs) add_eye(geometry, scene, *movement.rig, sources, eyeball);
        if (!movement.rig->points.empty()) geometry.millimetre = eye_distance(movement.rig->points) / 63;
    }
    add_slopes(geometry);
    return geometry;
}

}  // namespace mien
