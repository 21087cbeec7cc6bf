// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The face animation table of ISO/IEC 14496-1, which Laftsidis et al. fill in section 2.2 and play in section 3. For a
// value f between the borders I_1 .. I_n with I_k = 0 and the vectors D_j of the intervals [I_j, I_j+1] a vertex goes
//
//     f > 0:  sum over whole intervals from 0 to I_j of (I_j+1 - I_j) D_j  +  (f - I_j) D_j
//     f < 0:  the same walked downwards, every step negative
//
// Sources differ about the sign below zero, and the paper gives no test: with signed steps a plain linear table has the
// same vector on both sides. The unit of the FAP is in D here.

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "algorithms/fat_steps.hpp"
#include "algorithms/rotation.hpp"

#include "mien/algorithms/deform.hpp"

namespace mien {

double fat_step(std::span<const std::int32_t> borders, std::size_t j, double value) noexcept {
    constexpr double no_end = std::numeric_limits<double>::infinity();
    const double low = j == 0 ? -no_end : borders[j];
    const double high = j + 2 == borders.size() ? no_end : borders[j + 1];
    return std::clamp(value, low, high) - std::clamp(0.0, low, high);
}

double fat_value(const FapFrame& frame, const FaceDefTables& table) noexcept {
    if (!frame.mask[fap_index(table.fap)]) return 0;
    const auto selected = [&](std::uint8_t select, int amount) {
        return select == table.high_level_select ? amount : 0;
    };
    if (table.fap == 1)
        return selected(frame.viseme.select1, frame.viseme.blend) +
               selected(frame.viseme.select2, 63 - frame.viseme.blend);
    if (table.fap == 2)
        return selected(frame.expression.select1, frame.expression.intensity1) +
               selected(frame.expression.select2, frame.expression.intensity2);
    return frame.value[fap_index(table.fap)];
}

namespace {

void add_offsets(const FaceDefMesh& mesh, double f, std::span<Vec3f> positions) noexcept {
    const std::size_t intervals = mesh.borders.size() - 1;
    for (std::size_t j = 0; j < intervals; ++j) {
        const auto way = static_cast<float>(fat_step(mesh.borders, j, f));
        if (way == 0) continue;
        for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
            positions[mesh.vertices[i]] += way * mesh.displacements[i * intervals + j];
    }
}

Quaternion turn_about(const Vec3& axis, double angle) noexcept {
    const double s = std::sin(angle / 2);
    return {s * axis.x, s * axis.y, s * axis.z, std::cos(angle / 2)};
}

// Roll is the first of the turns, pitch the second, yaw the last: Ry Rx Rz, as in faps.cpp. A jaw's comes before.
int turn_order(int fap) noexcept {
    const FapAxis axis = fap_info(fap).axis;
    return axis == FapAxis::turn_z ? 1 : axis == FapAxis::turn_x ? 2 : axis == FapAxis::turn_y ? 3 : 0;
}
constexpr int last_turn = 3;

struct Placement {
    Quaternion turn;
    Vec3 scale{1, 1, 1}, shift;
    bool moves = false;
};

void add_transform(Placement& placement, const FaceDefTransform& transform, double f) noexcept {
    placement.moves = true;
    if (transform.field == TransformField::rotation)
        placement.turn = turn_about(transform.axis, f * transform.angle) * placement.turn;
    else if (transform.field == TransformField::translation)
        placement.shift += f * transform.translation;
    else
        placement.scale += f * transform.scale;
}

Placement placement_of(const Fat& fat, std::size_t node, const FapFrame& frame) noexcept {
    Placement placement;
    for (int order = 0; order <= last_turn; ++order)
        for (const FaceDefTables& table : fat.tables) {
            if (turn_order(table.fap) != order) continue;
            const double f = fat_value(frame, table);
            if (f == 0) continue;
            for (const FaceDefTransform& transform : table.transforms)
                if (transform.node == node) add_transform(placement, transform, f);
        }
    return placement;
}

Affine map_of(const Placement& placement, const Vec3& centre) noexcept {
    const Affine about_origin = affine_map({}, placement.turn, placement.scale);
    return {about_origin.columns, centre + placement.shift - turned(about_origin, centre)};
}

}  // namespace

Affine fat_map(const Fat& fat, std::size_t node, const FapFrame& frame) noexcept {
    const Placement placement = placement_of(fat, node, frame);
    return placement.moves ? map_of(placement, fat.nodes[node].centre) : Affine{};
}

Pose fat_pose(const Fat& fat, std::size_t node, const FapFrame& frame) noexcept {
    const Placement placement = placement_of(fat, node, frame);
    if (!placement.moves) return {};
    const Vec3& centre = fat.nodes[node].centre;
    return {placement.turn, centre + placement.shift - rotate(placement.turn, centre)};
}

void deform(const Fat& fat, std::span<const Vec3f> rest, const FapFrame& frame, std::span<Vec3f> positions) noexcept {
    assert(rest.size() == positions.size());
    std::copy(rest.begin(), rest.end(), positions.begin());
    for (const FaceDefTables& table : fat.tables) {
        const double f = fat_value(frame, table);
        if (f == 0) continue;
        for (const FaceDefMesh& mesh : table.meshes) add_offsets(mesh, f, positions);
    }
    for (std::size_t n = 0; n < fat.nodes.size(); ++n) {
        const Affine map = fat_map(fat, n, frame);
        if (map == Affine{}) continue;
        for (const std::uint32_t v : fat.nodes[n].vertices)
            positions[v] = to_float(moved(map, to_double(positions[v])));
    }
}

MeshSequence deform(const Fat& fat, const Mesh& mesh, const FapStream& stream) {
    check_fat(fat, vertex_count(mesh));
    struct Performance {
        Fat fat;
        std::vector<Vec3f> rest;
        std::vector<FapFrame> frames;
    };
    MeshSequence sequence{mesh, {}, {}};
    for (const FapFrame& frame : stream.frames) sequence.times.push_back(frame.number / stream.rate);
    const auto performance = std::make_shared<const Performance>(Performance{fat, mesh.positions, stream.frames});
    sequence.positions = [performance](std::size_t r, std::span<Vec3f> positions) {
        deform(performance->fat, performance->rest, performance->frames[r], positions);
    };
    return sequence;
}

}  // namespace mien
