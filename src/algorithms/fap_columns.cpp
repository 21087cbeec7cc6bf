// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "algorithms/fap_columns.hpp"

#include <algorithm>
#include <cmath>

#include "mien/algorithms/replay_error.hpp"
#include "mien/error.hpp"

namespace mien {

FapColumns fap_columns(const MeshSequence& sequence, const FapStream& stream, std::span<const int> left_out) {
    FapColumns columns;
    std::vector<double> times;
    for (const FapFrame& frame : stream.frames) times.push_back(frame.number / stream.rate);
    columns.rows = rows_of_frames(sequence, times);
    const std::span<const FapFrame> frames = std::span(stream.frames).first(columns.rows.size());
    if (frames.empty()) throw Error("animation table: expected frames of the animation, found none");
    for (int fap = 3; fap <= 68; ++fap) {
        if (std::find(left_out.begin(), left_out.end(), fap) != left_out.end()) continue;
        if (std::any_of(frames.begin(), frames.end(), [&](const FapFrame& f) { return f.value[fap_index(fap)] != 0; }))
            columns.faps.push_back(fap);
    }
    columns.values.resize(static_cast<Eigen::Index>(frames.size()), static_cast<Eigen::Index>(columns.faps.size()));
    for (std::size_t r = 0; r < frames.size(); ++r)
        for (std::size_t k = 0; k < columns.faps.size(); ++k)
            columns.values(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(k)) =
                frames[r].value[fap_index(columns.faps[k])];
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
