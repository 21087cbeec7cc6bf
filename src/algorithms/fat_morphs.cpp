// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// A face animation table as morph targets. A piecewise linear offset is a sum of one target per interval, whose weight
// is the part of the interval that the value has passed; what turns is linear in the entries of its matrix.

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <string>
#include <utility>

#include "algorithms/fat_steps.hpp"

#include "mien/affine.hpp"
#include "mien/algorithms/bake_fat.hpp"
#include "mien/algorithms/deform.hpp"

namespace mien {

namespace {

// Intervals first .. end - 1 of a table, which do the same.
struct Run {
    std::size_t first = 0, end = 0;
};

// Shares of a vector by which two may differ and be one: what rounding leaves when a straight line is cut in two.
constexpr float same = 1e-4F;

bool does_the_same(const FaceDefMesh& mesh, std::size_t a, std::size_t b) {
    const std::size_t intervals = mesh.borders.size() - 1;
    float most = 0, off = 0;
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        const Vec3f &first = mesh.displacements[i * intervals + a], &second = mesh.displacements[i * intervals + b];
        most = std::max(most, length(first));
        off = std::max(off, distance(first, second));
    }
    return off <= same * most;
}

std::vector<Run> runs_of(const FaceDefMesh& mesh) {
    std::vector<Run> runs;
    for (std::size_t j = 0; j + 1 < mesh.borders.size(); ++j)
        if (!runs.empty() && does_the_same(mesh, runs.back().first, j))
            runs.back().end = j + 1;
        else
            runs.push_back({j, j + 1});
    return runs;
}

// The value at which a run's target has weight 1, less that at which it has 0: its border away from zero.
double width(const FaceDefMesh& mesh, const Run& run) {
    const double low = mesh.borders[run.first], high = mesh.borders[run.end];
    return low < 0 && high > 0 ? high : high > 0 ? high - low : low - high;
}

std::string name_of(const FaceDefTables& table) {
    if (table.fap == 1)
        return fmt::format("viseme_{}", viseme_names[static_cast<std::size_t>(table.high_level_select)].name);
    if (table.fap == 2) return std::string(expression_names[static_cast<std::size_t>(table.high_level_select)]);
    return std::string(fap_info(table.fap).name);
}

// Plain where it is the only one; by its side of zero; by its border where a side has several.
std::string name_of(const FaceDefTables& table, const FaceDefMesh& mesh, const std::vector<Run>& runs, std::size_t r) {
    const bool below = mesh.borders[runs[r].end] <= 0;
    const auto is_below = [&](const Run& run) { return mesh.borders[run.end] <= 0; };
    const auto count_below = static_cast<std::size_t>(std::count_if(runs.begin(), runs.end(), is_below));
    const std::size_t same_side = below ? count_below : runs.size() - count_below;
    std::string name = name_of(table);
    if (below) name += "_below";
    if (same_side > 1) name += fmt::format("_{}", std::abs(mesh.borders[below ? runs[r].first : runs[r].end]));
    return name;
}

struct Axis {
    char name;
    double Vec3::*entry;
};
constexpr std::array<Axis, 3> axes{{{'x', &Vec3::x}, {'y', &Vec3::y}, {'z', &Vec3::z}}};

class Collector {
public:
    Collector(const Fat& fat, const Mesh& mesh, const FapStream& stream) : fat_(fat), mesh_(mesh), stream_(stream) {}

    MorphTrack collect() {
        for (const FaceDefTables& table : fat_.tables)
            for (const FaceDefMesh& mesh : table.meshes) add_mesh(table, mesh);
        const std::size_t frames = stream_.frames.size();
        if (frames > 0)
            for (std::size_t n = 0; n < fat_.nodes.size(); ++n) add_node(n);
        for (const FapFrame& frame : stream_.frames) track_.times.push_back(frame.number / stream_.rate);
        for (std::size_t r = 0; r < frames; ++r)
            for (const std::vector<float>& column : columns_) track_.weights.push_back(column[r]);
        return std::move(track_);
    }

private:
    void add(MorphTarget target, std::vector<float> weights) {
        track_.targets.push_back(std::move(target));
        columns_.push_back(std::move(weights));
    }

    void add_mesh(const FaceDefTables& table, const FaceDefMesh& mesh) {
        const std::vector<Run> runs = runs_of(mesh);
        const std::size_t intervals = mesh.borders.size() - 1;
        for (std::size_t r = 0; r < runs.size(); ++r) {
            const double way = width(mesh, runs[r]);
            MorphTarget target{name_of(table, mesh, runs, r), mesh.vertices, {}};
            for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
                target.deltas.push_back(static_cast<float>(way) * mesh.displacements[i * intervals + runs[r].first]);
            std::vector<float> weights;
            for (const FapFrame& frame : stream_.frames) {
                double passed = 0;
                for (std::size_t j = runs[r].first; j < runs[r].end; ++j)
                    passed += fat_step(mesh.borders, j, fat_value(frame, table));
                weights.push_back(static_cast<float>(passed / way));
            }
            add(std::move(target), std::move(weights));
        }
    }

    // A node of every vertex is the head; what it does is the track's head pose, as far as that is a turn and a shift.
    void add_node(std::size_t n) {
        const FatNode& node = fat_.nodes[n];
        std::vector<Affine> maps;
        for (const FapFrame& frame : stream_.frames) maps.push_back(fat_map(fat_, n, frame));
        if (std::all_of(maps.begin(), maps.end(), [](const Affine& map) { return map == Affine{}; })) return;
        if (node.vertices.size() == vertex_count(mesh_)) return add_head(n);
        for (std::size_t column = 0; column < 3; ++column)
            for (std::size_t row = 0; row < 3; ++row) add_matrix_entry(node, maps, row, column);
        for (std::size_t row = 0; row < 3; ++row) add_shift_entry(node, maps, row);
    }

    // A vertex moves along `row` by its distance from the centre along `column`.
    void add_matrix_entry(const FatNode& node, const std::vector<Affine>& maps, std::size_t row, std::size_t column) {
        const auto weight = [&](const Affine& map) {
            return map.columns[column].*axes[row].entry - Affine{}.columns[column].*axes[row].entry;
        };
        add_entry(node, fmt::format("{} {}{}", node.name, axes[row].name, axes[column].name), weights_of(maps, weight),
                  [&](std::uint32_t v) {
                      Vec3 delta;
                      delta.*axes[row].entry = (to_double(mesh_.positions[v]) - node.centre).*axes[column].entry;
                      return to_float(delta);
                  });
    }

    void add_shift_entry(const FatNode& node, const std::vector<Affine>& maps, std::size_t row) {
        const auto weight = [&](const Affine& map) { return (moved(map, node.centre) - node.centre).*axes[row].entry; };
        Vec3 unit;
        unit.*axes[row].entry = 1;
        add_entry(node, fmt::format("{} {}", node.name, axes[row].name), weights_of(maps, weight),
                  [&](std::uint32_t) { return to_float(unit); });
    }

    template <class Weight>
    static std::vector<float> weights_of(const std::vector<Affine>& maps, const Weight& weight) {
        std::vector<float> weights(maps.size());
        std::transform(maps.begin(), maps.end(), weights.begin(),
                       [&](const Affine& map) { return static_cast<float>(weight(map)); });
        return weights;
    }

    template <class Delta>
    void add_entry(const FatNode& node, std::string name, std::vector<float> weights, const Delta& delta) {
        if (std::all_of(weights.begin(), weights.end(), [](float w) { return w == 0; })) return;
        MorphTarget target{std::move(name), node.vertices, {}};
        for (const std::uint32_t v : node.vertices) target.deltas.push_back(delta(v));
        add(std::move(target), std::move(weights));
    }

    void add_head(std::size_t n) {
        for (const FapFrame& frame : stream_.frames) track_.head.push_back(fat_pose(fat_, n, frame));
    }

    const Fat& fat_;
    const Mesh& mesh_;
    const FapStream& stream_;
    MorphTrack track_;
    std::vector<std::vector<float>> columns_;  // weights, one list per target
};

// How far the targets are from the table, before the head turns.
void measure(MorphTrack& track, const Fat& fat, const Mesh& mesh, const FapStream& stream) {
    Fat still = fat;
    for (FatNode& node : still.nodes)
        if (node.vertices.size() == vertex_count(mesh)) node.vertices.clear();
    std::vector<Vec3f> expected(vertex_count(mesh)), found(expected.size());
    double sum = 0;
    for (std::size_t r = 0; r < stream.frames.size(); ++r) {
        deform(still, mesh.positions, stream.frames[r], expected);
        found = mesh.positions;
        for (std::size_t t = 0; t < track.targets.size(); ++t) {
            const MorphTarget& target = track.targets[t];
            const float weight = track.weights[r * track.targets.size() + t];
            if (weight == 0) continue;
            for (std::size_t i = 0; i < target.vertices.size(); ++i)
                found[target.vertices[i]] += weight * target.deltas[i];
        }
        for (std::size_t v = 0; v < found.size(); ++v) {
            const double off = distance(found[v], expected[v]);
            sum += off * off;
            track.max_error = std::max(track.max_error, off);
        }
    }
    const double count = static_cast<double>(found.size()) * static_cast<double>(stream.frames.size());
    track.mean_error = count > 0 ? std::sqrt(sum / count) : 0;
}

}  // namespace

MorphTrack fat_morphs(const Fat& fat, const Mesh& mesh, const FapStream& stream) {
    check_fat(fat, vertex_count(mesh));
    MorphTrack track = Collector(fat, mesh, stream).collect();
    measure(track, fat, mesh, stream);
    return track;
}

}  // namespace mien
