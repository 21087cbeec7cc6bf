// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// A rig as the piecewise linear functions of single parameters that ISO/IEC 14496-1 calls a face animation table.
// Between two borders the table goes straight from what the rig does at the one to what it does at the other; a border
// is put in where that is farthest off, until it is near enough everywhere.

#include "mien/algorithms/bake_fat.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "mien/algorithms/deform.hpp"
#include "mien/algorithms/play_faps.hpp"
#include "mien/error.hpp"

namespace mien {

namespace {

// Values at which a parameter is tried, on both sides of zero; those beyond its range are left out, but never the first
// four: with 1024 units a lid closes.
constexpr std::array<std::int32_t, 8> tried{128, 256, 512, 768, 1024, 1536, 2048, 4096};
constexpr std::size_t always_tried = 5;
// Angles are tried to a turn of half a radian.
constexpr std::array<std::int32_t, 3> tried_angles{12500, 25000, 50000};

std::vector<std::int32_t> values_of(int fap) {
    const Fap& info = fap_info(fap);
    std::vector<std::int32_t> above;
    if (info.unit == FapUnit::angle) {
        above.assign(tried_angles.begin(), tried_angles.end());
    } else {
        const std::int32_t most = info.intra.high * info.quant_step;
        for (std::size_t i = 0; i < tried.size(); ++i)
            if (i < always_tried || tried[i] <= most) above.push_back(tried[i]);
    }
    std::vector<std::int32_t> values(above.rbegin(), above.rend());
    for (std::int32_t& value : values) value = -value;
    values.push_back(0);
    values.insert(values.end(), above.begin(), above.end());
    return values;
}

constexpr int head_pitch = 48, head_roll = 50;

bool turns_head(int fap) {
    return fap >= head_pitch && fap <= head_roll;
}

// Every parameter alone at every value that is tried, played on the rig as one stream: what no parameter tells is
// carried by the skin, which is worked out once.
class Player {
public:
    Player(const Rig& rig, const Mesh& mesh, const Fapu& fapu, const FapMask& sent) : vertices_(vertex_count(rig)) {
        FapStream stream;
        for (int fap = 3; fap <= static_cast<int>(fap_count); ++fap) {
            first_row_[fap_index(fap)] = stream.frames.size();
            for (const std::int32_t value : values_of(fap)) {
                FapFrame frame;
                frame.number = static_cast<std::uint32_t>(stream.frames.size());
                frame.mask = sent;
                frame.value[fap_index(fap)] = value;
                stream.frames.push_back(frame);
            }
        }
        sequence_ = deform(rig, mesh, play_faps({mesh, rig.points}, stream, fapu));
    }

    [[nodiscard]] std::vector<std::vector<Vec3f>> play(int fap) const {
        std::vector<std::vector<Vec3f>> rows(values_of(fap).size(), std::vector<Vec3f>(vertices_));
        for (std::size_t r = 0; r < rows.size(); ++r) sequence_.positions(first_row_[fap_index(fap)] + r, rows[r]);
        return rows;
    }

private:
    std::size_t vertices_;
    std::array<std::size_t, fap_count> first_row_{};
    MeshSequence sequence_;
};

// The rows at which borders lie, ascending, and how far the straight lines between them are off elsewhere.
class Borders {
public:
    Borders(const std::vector<std::int32_t>& values, const std::vector<std::vector<Vec3f>>& offsets)
        : values_(values), offsets_(offsets) {}

    std::vector<std::size_t> find(double tolerance) const {
        const std::size_t zero = values_.size() / 2;
        std::vector<std::size_t> borders{0, zero, values_.size() - 1};
        while (const auto worst = farthest(borders, tolerance))
            borders.insert(std::upper_bound(borders.begin(), borders.end(), *worst), *worst);
        return borders;
    }

private:
    [[nodiscard]] std::optional<std::size_t> farthest(const std::vector<std::size_t>& borders, double tolerance) const {
        double most = tolerance;
        std::optional<std::size_t> worst;
        for (std::size_t i = 0; i + 1 < borders.size(); ++i)
            for (std::size_t r = borders[i] + 1; r < borders[i + 1]; ++r)
                if (const double off = off_by(r, borders[i], borders[i + 1]); off > most) {
                    most = off;
                    worst = r;
                }
        return worst;
    }

    [[nodiscard]] double off_by(std::size_t r, std::size_t from, std::size_t to) const {
        const auto share =
            static_cast<float>(values_[r] - values_[from]) / static_cast<float>(values_[to] - values_[from]);
        float most = 0;
        for (std::size_t v = 0; v < offsets_[r].size(); ++v) {
            const Vec3f straight = (1 - share) * offsets_[from][v] + share * offsets_[to][v];
            most = std::max(most, distance(offsets_[r][v], straight));
        }
        return most;
    }

    const std::vector<std::int32_t>& values_;
    const std::vector<std::vector<Vec3f>>& offsets_;
};

// The vertices that move at all, by the greatest of their offsets.
std::vector<std::uint32_t> moving(const std::vector<std::vector<Vec3f>>& offsets, double sparsity) {
    std::vector<float> reach(offsets.front().size());
    for (const std::vector<Vec3f>& row : offsets)
        for (std::size_t v = 0; v < row.size(); ++v) reach[v] = std::max(reach[v], length(row[v]));
    const float most = reach.empty() ? 0 : *std::max_element(reach.begin(), reach.end());
    std::vector<std::uint32_t> vertices;
    for (std::uint32_t v = 0; v < reach.size(); ++v)
        if (reach[v] > 0 && reach[v] >= sparsity * most) vertices.push_back(v);
    return vertices;
}

FaceDefMesh mesh_table(const std::vector<std::int32_t>& values, const std::vector<std::vector<Vec3f>>& offsets,
                       const std::vector<std::size_t>& borders, double sparsity) {
    FaceDefMesh mesh;
    for (const std::size_t row : borders) mesh.borders.push_back(values[row]);
    mesh.vertices = moving(offsets, sparsity);
    for (const std::uint32_t v : mesh.vertices)
        for (std::size_t j = 0; j + 1 < borders.size(); ++j) {
            const auto width = static_cast<float>(mesh.borders[j + 1] - mesh.borders[j]);
            mesh.displacements.push_back((offsets[borders[j + 1]][v] - offsets[borders[j]][v]) / width);
        }
    return mesh;
}

class Baker {
public:
    Baker(const Rig& rig, const Mesh& mesh, const Fapu& fapu, const BakeFatOptions& options)
        : rig_(rig), fapu_(fapu), options_(options), player_(rig, mesh, fapu, options.sent), turns_(vertex_count(rig)) {
        for (const Eyeball& eyeball : rig.eyeballs)
            for (const std::uint32_t v : eyeball.vertices) turns_[v] = true;
    }

    BakedFat bake() {
        add_nodes();
        for (int fap = 3; fap <= static_cast<int>(fap_count); ++fap)
            if (options_.sent[fap_index(fap)]) add_table(fap);
        if (rows_ > 0) result_.alone.mean = std::sqrt(sum_ / (static_cast<double>(rows_ * vertex_count(rig_))));
        return std::move(result_);
    }

private:
    void add_nodes() {
        for (const Eyeball& eyeball : rig_.eyeballs)
            result_.fat.nodes.push_back({eyeball.name, eyeball.vertices, eyeball.centre});
        if (!options_.head) return;
        FatNode head{"head", std::vector<std::uint32_t>(vertex_count(rig_)), fapu_.neck};
        std::iota(head.vertices.begin(), head.vertices.end(), 0U);
        result_.fat.nodes.push_back(std::move(head));
    }

    void add_table(int fap) {
        FaceDefTables table;
        table.fap = fap;
        if (turns_head(fap)) {
            if (options_.head) add_turn(table, static_cast<std::uint32_t>(result_.fat.nodes.size() - 1));
        } else {
            for (std::size_t e = 0; e < rig_.eyeballs.size(); ++e) add_eye(table, e);
            add_mesh(table);
        }
        if (table.meshes.empty() && table.transforms.empty()) return;
        result_.fat.tables.push_back(std::move(table));
        if (!turns_head(fap)) measure(fap);
    }

    static void add_turn(FaceDefTables& table, std::uint32_t node) {
        FaceDefTransform turn;
        turn.node = node;
        const FapAxis axis = fap_info(table.fap).axis;
        turn.axis = axis == FapAxis::turn_x ? Vec3{1, 0, 0} : axis == FapAxis::turn_y ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
        turn.angle = fap_info(table.fap).sign * 1e-5;
        table.transforms.push_back(turn);
    }

    void add_eye(FaceDefTables& table, std::size_t e) const {
        const Fap& fap = fap_info(table.fap);
        const Eyeball& eyeball = rig_.eyeballs[e];
        const bool aims = eyeball.point && rig_.points[*eyeball.point].id == fap.point;
        if (aims && (fap.axis == FapAxis::turn_x || fap.axis == FapAxis::turn_y))
            add_turn(table, static_cast<std::uint32_t>(e));
    }

    void add_mesh(FaceDefTables& table) {
        values_ = values_of(table.fap);
        rows_of_fap_ = player_.play(table.fap);
        std::vector<std::vector<Vec3f>> offsets = rows_of_fap_;
        for (std::vector<Vec3f>& row : offsets)
            for (std::size_t v = 0; v < row.size(); ++v) row[v] = turns_[v] ? Vec3f{} : row[v] - rig_.rest[v];
        const std::vector<std::size_t> borders =
            Borders(values_, offsets).find(options_.tolerance * eye_distance(rig_.points));
        FaceDefMesh mesh = mesh_table(values_, offsets, borders, options_.sparsity);
        if (!mesh.vertices.empty()) table.meshes.push_back(std::move(mesh));
    }

    void measure(int fap) {
        std::vector<Vec3f> positions(vertex_count(rig_));
        Fat one{result_.fat.nodes, {result_.fat.tables.back()}};
        for (std::size_t r = 0; r < values_.size(); ++r) {
            FapFrame frame;
            frame.mask.set(fap_index(fap));
            frame.value[fap_index(fap)] = values_[r];
            deform(one, rig_.rest, frame, positions);
            for (std::size_t v = 0; v < positions.size(); ++v) {
                const double off = distance(positions[v], rows_of_fap_[r][v]);
                sum_ += off * off;
                result_.alone.max = std::max(result_.alone.max, off);
            }
        }
        rows_ += values_.size();
    }

    const Rig& rig_;
    const Fapu& fapu_;
    const BakeFatOptions& options_;
    Player player_;
    std::vector<bool> turns_;  // per vertex: of an eyeball
    std::vector<std::int32_t> values_;
    std::vector<std::vector<Vec3f>> rows_of_fap_;
    BakedFat result_;
    double sum_ = 0;
    std::size_t rows_ = 0;
};

}  // namespace

BakedFat bake_fat(const Rig& rig, const Mesh& mesh, const Fapu& fapu, const BakeFatOptions& options) {
    if (vertex_count(mesh) != vertex_count(rig))
        throw Error(fmt::format("bake: expected the mesh of the rig with {} vertices, found {}", vertex_count(rig),
                                vertex_count(mesh)));
    return Baker(rig, mesh, fapu, options).bake();
}

FatError fat_error(const Fat& fat, const FapStream& stream, const MeshSequence& truth) {
    if (stream.frames.size() != truth.times.size())
        throw Error(fmt::format("table error: expected a row for each of {} frames, found {}", stream.frames.size(),
                                truth.times.size()));
    const MeshSequence played = deform(fat, truth.mesh, stream);
    std::vector<Vec3f> ours(vertex_count(truth.mesh)), theirs(ours.size());
    FatError error;
    double sum = 0;
    for (std::size_t r = 0; r < truth.times.size(); ++r) {
        played.positions(r, ours);
        truth.positions(r, theirs);
        for (std::size_t v = 0; v < ours.size(); ++v) {
            const double off = distance(ours[v], theirs[v]);
            sum += off * off;
            error.max = std::max(error.max, off);
        }
    }
    const double count = static_cast<double>(ours.size()) * static_cast<double>(truth.times.size());
    error.mean = count > 0 ? std::sqrt(sum / count) : 0;
    return error;
}

}  // namespace mien
