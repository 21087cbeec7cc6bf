// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "algorithms/fap_columns.hpp"

#include <algorithm>
#include <cmath>

#include "mien/error.hpp"

namespace mien {

namespace {

std::size_t nearest_row(const std::vector<double>& times, double time) {
    const auto after = std::lower_bound(times.begin(), times.end(), time);
    if (after == times.begin()) return 0;
    if (after == times.end()) return times.size() - 1;
    const auto before = after - 1;
    return static_cast<std::size_t>((*after - time < time - *before ? after : before) - times.begin());
}

}  // namespace

FapColumns fap_columns(const MeshSequence& sequence, const FapStream& stream, std::span<const int> transforms) {
    FapColumns columns;
    std::vector<const FapFrame*> frames;
    if (sequence.times.empty()) throw Error("animation table: expected an animation with rows, found none");
    for (const FapFrame& frame : stream.frames) {
        const double time = sequence.times.front() + frame.number / stream.rate;
        if (time > sequence.times.back() + 0.5 / stream.rate) break;
        frames.push_back(&frame);
        columns.rows.push_back(nearest_row(sequence.times, time));
    }
    if (frames.empty()) throw Error("animation table: expected frames of the animation, found none");
    for (int fap = 3; fap <= 68; ++fap) {
        if (std::find(transforms.begin(), transforms.end(), fap) != transforms.end()) continue;
        if (std::any_of(frames.begin(), frames.end(), [&](const FapFrame* f) { return f->value[fap_index(fap)] != 0; }))
            columns.faps.push_back(fap);
    }
    columns.values.resize(static_cast<Eigen::Index>(frames.size()), static_cast<Eigen::Index>(columns.faps.size()));
    for (std::size_t r = 0; r < frames.size(); ++r)
        for (std::size_t k = 0; k < columns.faps.size(); ++k)
            columns.values(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(k)) =
                frames[r]->value[fap_index(columns.faps[k])];
    return columns;
}

double piece(double value, double low, double high) {
    return std::clamp(value, low, high) - std::clamp(0.0, low, high);
}

Eigen::MatrixXd displacements_of(const MeshSequence& sequence, std::span<const std::size_t> rows,
                                 std::span<const std::uint32_t> vertices) {
    Eigen::MatrixXd result(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(3 * vertices.size()));
    std::vector<Vec3f> positions(vertex_count(sequence.mesh));
    for (std::size_t r = 0; r < rows.size(); ++r) {
        sequence.positions(rows[r], positions);
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            const Vec3 d = to_double(positions[vertices[i]]) - to_double(sequence.mesh.positions[vertices[i]]);
            const auto row = static_cast<Eigen::Index>(r), column = static_cast<Eigen::Index>(3 * i);
            result(row, column) = d.x;
            result(row, column + 1) = d.y;
            result(row, column + 2) = d.z;
        }
    }
    return result;
}

}  // namespace mien
