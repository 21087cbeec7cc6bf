// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "render/model.hpp"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <map>
#include <string>

#include "render/pictures.hpp"
#include "render/shaders.hpp"

#include "mien/error.hpp"

namespace mien {

namespace {

// What the moving pass reads of a vertex.
struct StillVertex {
    Vec3f rest, normal, tangent;
    float hand = 1;
    std::array<std::int32_t, 4> rows{};
    std::array<std::int32_t, 2> joints{};
};
static_assert(sizeof(StillVertex) == 64);

constexpr GLsizei posed_stride = 6 * sizeof(float);

bool is_even(const Vec3f& v) {
    return v.x == v.y && v.y == v.z;
}
bool is_plain(const Rows::Entry& entry) {
    return is_even(entry.weight) && is_even(entry.along_t) && is_even(entry.along_b);
}

Texel plain_texel(const Rows::Entry& entry) {
    return {static_cast<float>(entry.index), entry.weight.x, entry.along_t.x, entry.along_b.x};
}

// Splits the rows into entries that move all axes alike, a texel each, and the others, three texels each.
void lay_out(const Geometry& geometry, std::vector<StillVertex>& vertices, std::vector<Texel>& plain,
             std::vector<Texel>& full, std::vector<Texel>& bones) {
    const auto count = [](const std::vector<Texel>& list) { return static_cast<std::int32_t>(list.size()); };
    for (std::size_t v = 0; v < geometry.positions.size(); ++v) {
        StillVertex& out = vertices[v];
        out = {geometry.positions[v], geometry.normals[v], geometry.tangents[v], geometry.hands[v], {}, {}};
        out.rows = {count(plain), 0, count(full) / 3, 0};
        for (std::uint32_t e = geometry.moves.starts[v]; e < geometry.moves.starts[v + 1]; ++e) {
            const Rows::Entry& entry = geometry.moves.entries[e];
            if (is_plain(entry)) {
                plain.push_back(plain_texel(entry));
                continue;
            }
            const auto& [w, t, b] = std::tie(entry.weight, entry.along_t, entry.along_b);
            full.push_back({static_cast<float>(entry.index), w.x, w.y, w.z});
            full.push_back({t.x, t.y, t.z, 0});
            full.push_back({b.x, b.y, b.z, 0});
        }
        out.rows[1] = count(plain) - out.rows[0];
        out.rows[3] = count(full) / 3 - out.rows[2];
        out.joints[0] = count(bones);
        for (std::uint32_t e = geometry.joints.starts[v]; e < geometry.joints.starts[v + 1]; ++e)
            bones.push_back(plain_texel(geometry.joints.entries[e]));
        out.joints[1] = count(bones) - out.joints[0];
    }
}

std::vector<std::uint32_t> edges_of(const Geometry& geometry) {
    std::vector<std::array<std::uint32_t, 2>> edges;
    for (std::size_t i = 0; i < geometry.triangles.size(); ++i) {
        const std::uint32_t a = geometry.triangles[i], b = geometry.triangles[i % 3 == 2 ? i - 2 : i + 1];
        edges.push_back({std::min(a, b), std::max(a, b)});
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    std::vector<std::uint32_t> list;
    for (const auto& edge : edges) list.insert(list.end(), edge.begin(), edge.end());
    return list;
}

void float_attribute(GLuint location, GLint size, std::size_t stride, std::size_t at) {
    glEnableVertexAttribArray(location);
    glVertexAttribPointer(location, size, GL_FLOAT, GL_FALSE, static_cast<GLsizei>(stride), buffer_offset(at));
}

GlName move_array_of(const GlName& still) {
    GlName array(GlName::Kind::vertex_array);
    glBindVertexArray(array.name());
    glBindBuffer(GL_ARRAY_BUFFER, still.name());
    float_attribute(0, 3, sizeof(StillVertex), offsetof(StillVertex, rest));
    float_attribute(1, 3, sizeof(StillVertex), offsetof(StillVertex, normal));
    float_attribute(2, 4, sizeof(StillVertex), offsetof(StillVertex, tangent));
    for (const GLuint location : {3U, 4U}) {
        glEnableVertexAttribArray(location);
        glVertexAttribIPointer(
            location, location == 3 ? 4 : 2, GL_INT, sizeof(StillVertex),
            buffer_offset(location == 3 ? offsetof(StillVertex, rows) : offsetof(StillVertex, joints)));
    }
    glBindVertexArray(0);
    return array;
}

void add_map(std::vector<Texel>& rows, const Affine& map) {
    const auto number = [](double x) { return static_cast<float>(x); };
    const auto& [a, b, c] = map.columns;
    rows.push_back({number(a.x), number(b.x), number(c.x), number(map.offset.x)});
    rows.push_back({number(a.y), number(b.y), number(c.y), number(map.offset.y)});
    rows.push_back({number(a.z), number(b.z), number(c.z), number(map.offset.z)});
}

// The turn about a centre that stays.
Affine turn_about(const Quaternion& turn, const Vec3& centre) {
    const Affine map{{rotate(turn, Vec3{1, 0, 0}), rotate(turn, Vec3{0, 1, 0}), rotate(turn, Vec3{0, 0, 1})}, {}};
    return {map.columns, centre - turned(map, centre)};
}

}  // namespace

StillModel make_still(const Scene& scene, const Geometry& geometry) {
    StillModel still;
    std::vector<StillVertex> vertices(geometry.positions.size());
    std::vector<Texel> plain, full, bones;
    lay_out(geometry, vertices, plain, full, bones);
    still.vertices = vertices.size();
    still.pieces = geometry.pieces;
    still.materials = scene.materials;
    still.still = filled_buffer(GL_ARRAY_BUFFER, std::span<const StillVertex>(vertices));
    still.uvs = filled_buffer(GL_ARRAY_BUFFER, std::span(geometry.uvs));
    if (!geometry.eyes.empty()) still.eyes = filled_buffer(GL_ARRAY_BUFFER, std::span(geometry.eyes));
    still.move_array = move_array_of(still.still);
    glBindVertexArray(0);
    still.indices = filled_buffer(GL_ELEMENT_ARRAY_BUFFER, std::span(geometry.triangles));
    const std::vector<std::uint32_t> edges = edges_of(geometry);
    still.edges = filled_buffer(GL_ELEMENT_ARRAY_BUFFER, std::span(edges));
    still.edge_count = static_cast<GLsizei>(edges.size());
    fill(still.plain, plain, "influences");
    fill(still.full, full, "thirds of influences");
    fill(still.bones, bones, "influences of joints");
    still.amount_count = geometry.amount_count;
    still.joint_count = geometry.joint_count;
    still.millimetre = geometry.millimetre;
    upload_pictures(still, scene);
    check_gl("a model");
    return still;
}

Instance make_instance(std::shared_ptr<const StillModel> still) {
    Instance instance;
    instance.still = std::move(still);
    instance.posed = GlName(GlName::Kind::buffer);
    instance.array = GlName(GlName::Kind::vertex_array);
    glBindVertexArray(instance.array.name());
    glBindBuffer(GL_ARRAY_BUFFER, instance.posed.name());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(instance.still->vertices * posed_stride), nullptr,
                 GL_DYNAMIC_COPY);
    float_attribute(0, 3, posed_stride, 0);
    float_attribute(1, 3, posed_stride, 3 * sizeof(float));
    glBindBuffer(GL_ARRAY_BUFFER, instance.still->uvs.name());
    float_attribute(2, 2, sizeof(Vec2f), 0);
    if (instance.still->eyes.name() != 0) {
        glBindBuffer(GL_ARRAY_BUFFER, instance.still->eyes.name());
        float_attribute(3, 3, sizeof(Vec3f), 0);
    }
    glBindVertexArray(0);
    check_gl("a model's pose");
    return instance;
}

void set_values(Instance& instance, std::span<const float> values) {
    instance.painted = !values.empty();
    if (!instance.painted) return;
    const bool first = instance.values.name() == 0;
    if (first) instance.values = GlName(GlName::Kind::buffer);
    glBindVertexArray(instance.array.name());
    glBindBuffer(GL_ARRAY_BUFFER, instance.values.name());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(values.size_bytes()), values.data(), GL_DYNAMIC_DRAW);
    if (first) float_attribute(4, 1, sizeof(float), 0);
    glBindVertexArray(0);
}

Amounts amounts_of(const StillModel& still, const ScenePose& pose) {
    Amounts amounts;
    amounts.amounts.resize(still.amount_count);
    for (std::size_t n = 0; n < still.scene.nodes.size(); ++n) {
        const std::uint32_t first = still.tables.node_amounts[n], end = still.tables.node_amounts[n + 1];
        for (std::uint32_t m = 0; first + m < end && m < pose.morph_weights[n].size(); ++m) {
            const float w = pose.morph_weights[n][m];
            amounts.amounts[first + m] = {w, w, w, 0};
        }
        add_map(amounts.maps, pose.worlds[n]);
    }
    for (const SceneSkin& skin : still.scene.skins)
        for (const Affine& map : joint_maps(still.scene, skin, pose)) add_map(amounts.maps, map);
    return amounts;
}

Amounts amounts_of(const StillModel& still, std::span<const Vec3f> displacements, std::span<const float> weights) {
    Amounts amounts;
    const std::size_t points = still.rig.points.size();
    const std::size_t known = still.rig.prior ? still.rig.prior->shapes.size() : 0;
    amounts.amounts.resize(points + known + still.shapes);
    for (std::size_t k = 0; k < displacements.size(); ++k) {
        const Vec3f& d = displacements[k];
        amounts.amounts[k] = {d.x, d.y, d.z, 0};
    }
    std::vector<float> shown(known);
    if (known > 0 && !displacements.empty()) shape_weights(*still.rig.prior, displacements, shown);
    for (std::size_t s = 0; s < known; ++s) amounts.amounts[points + s] = {shown[s], shown[s], shown[s], 0};
    for (std::size_t s = 0; s < weights.size(); ++s)
        amounts.amounts[points + known + s] = {weights[s], weights[s], weights[s], 0};
    add_map(amounts.maps, {});
    for (const Eyeball& eyeball : still.rig.eyeballs)
        add_map(amounts.maps, displacements.empty()
                                  ? Affine{}
                                  : turn_about(eyeball_turn(still.rig, eyeball, displacements), eyeball.centre));
    return amounts;
}

Mover::Mover()
    : program_(shaders::move_vertex, shaders::move_fragment,
               std::array<const char*, 2>{"posed_position", "posed_normal"}),
      nowhere_(GlName::Kind::framebuffer),
      pixel_(GlName::Kind::renderbuffer) {
    glBindFramebuffer(GL_FRAMEBUFFER, nowhere_.name());
    glBindRenderbuffer(GL_RENDERBUFFER, pixel_.name());
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, 1, 1);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, pixel_.name());
    program_.use();
    int unit = 0;
    for (const char* list : {"plain", "full", "bones", "amounts", "maps"}) program_.set(list, unit++);
    int bits = 0;
    while ((1 << bits) < list_width) ++bits;
    program_.set("width_bits", bits);
}

void Mover::run(const Instance& instance, Amounts amounts) {
    const StillModel& still = *instance.still;
    fill(amounts_, amounts.amounts, "points and shapes");
    fill(maps_, amounts.maps, "rows of joints");
    int unit = 0;
    for (const GlList* list : {&still.plain, &still.full, &still.bones, &static_cast<const GlList&>(amounts_),
                               &static_cast<const GlList&>(maps_)})
        bind_texture(unit++, list->texture.name());
    glBindFramebuffer(GL_FRAMEBUFFER, nowhere_.name());
    program_.use();
    glBindVertexArray(still.move_array.name());
    glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, instance.posed.name());
    glEnable(GL_RASTERIZER_DISCARD);
    glBeginTransformFeedback(GL_POINTS);
    glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>(still.vertices));
    glEndTransformFeedback();
    glDisable(GL_RASTERIZER_DISCARD);
    glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, 0);
    glBindVertexArray(0);
}

void read_posed(const Instance& instance, std::size_t which, std::span<Vec3f> out) {
    const std::size_t bytes = instance.still->vertices * posed_stride;
    glBindBuffer(GL_ARRAY_BUFFER, instance.posed.name());
    const auto* from = static_cast<const std::byte*>(
        glMapBufferRange(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(bytes), GL_MAP_READ_BIT));
    if (from == nullptr) throw Error("render: expected the driver to hand out posed vertices, found that it does not");
    for (std::size_t v = 0; v < out.size(); ++v)
        std::memcpy(&out[v], from + v * posed_stride + which * sizeof(Vec3f), sizeof(Vec3f));
    glUnmapBuffer(GL_ARRAY_BUFFER);
}

}  // namespace mien
