// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// What others would send: vertices in 16 bits, compressed as EXT_meshopt_compression says. Deltas are quantised to the
// range of the largest one.

#include "mien/io/baked_size.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <meshoptimizer.h>
#include <span>
#include <vector>

#include "mien/error.hpp"

namespace mien {

namespace {

using Quantised = std::array<std::int16_t, 4>;  // x, y, z and what glTF fills up with

template <class Element>
std::size_t compressed(const std::vector<Element>& elements) {
    if (elements.empty()) return 0;
    std::vector<unsigned char> bytes(meshopt_encodeVertexBufferBound(elements.size(), sizeof(Element)));
    return meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), elements.data(), elements.size(), sizeof(Element));
}

std::size_t compressed_indices(const Mesh& mesh) {
    std::vector<std::uint32_t> indices;
    for (std::size_t f = 0; f < face_count(mesh); ++f) {
        const auto corners = face(mesh, f);
        for (std::size_t k = 1; k + 1 < corners.size(); ++k)
            indices.insert(indices.end(), {corners[0], corners[k], corners[k + 1]});
    }
    std::vector<unsigned char> bytes(meshopt_encodeIndexBufferBound(indices.size(), vertex_count(mesh)));
    return meshopt_encodeIndexBuffer(bytes.data(), bytes.size(), indices.data(), indices.size());
}

std::vector<Quantised> quantised(std::span<const Vec3f> moves, double largest) {
    constexpr double steps = 32767;
    std::vector<Quantised> result;
    result.reserve(moves.size());
    const auto step = [&](float x) { return static_cast<std::int16_t>(std::lround(steps * x / largest)); };
    for (const Vec3f& d : moves) result.push_back({step(d.x), step(d.y), step(d.z), 0});
    return result;
}

double largest_of(std::span<const Vec3f> moves) {
    double largest = 0;
    for (const Vec3f& d : moves) {
        if (!is_finite(d)) throw Error("size of an animation: expected finite positions, found others");
        largest = std::max<double>({largest, std::abs(d.x), std::abs(d.y), std::abs(d.z)});
    }
    return largest;
}

std::size_t target_size(std::span<const Vec3f> moves) {
    const double largest = largest_of(moves);
    return compressed(quantised(moves, largest > 0 ? largest : 1));
}

}  // namespace

BakedSize baked_size(const MeshSequence& sequence, const MorphTrack& track) {
    const std::size_t vertices = vertex_count(sequence.mesh), rows = sequence.times.size();
    BakedSize size;
    constexpr std::size_t header = 8, number = 4;
    size.point_cache = header + number * rows * (1 + 3 * vertices);
    const std::size_t model = compressed_indices(sequence.mesh) + target_size(sequence.mesh.positions);
    size.morph_per_row = size.morph_track = model;
    std::vector<Vec3f> row(vertices);
    for (std::size_t r = 0; r < rows; ++r) {
        sequence.positions(r, row);
        for (std::size_t v = 0; v < vertices; ++v) row[v] = row[v] - sequence.mesh.positions[v];
        size.morph_per_row += target_size(row);
    }
    for (const MorphTarget& target : track.targets) {
        std::fill(row.begin(), row.end(), Vec3f{});
        for (std::size_t i = 0; i < target.vertices.size(); ++i) row[target.vertices[i]] = target.deltas[i];
        size.morph_track += target_size(row);
    }
    std::vector<std::array<std::int16_t, 2>> weights;
    double largest = 1e-9;
    for (const float w : track.weights) largest = std::max<double>(largest, std::abs(w));
    for (std::size_t t = 0; t < track.targets.size(); ++t)
        for (std::size_t r = 0; r < track.times.size(); ++r)
            weights.push_back(
                {static_cast<std::int16_t>(std::lround(32767 * track.weights[r * track.targets.size() + t] / largest)),
                 0});
    size.morph_track += compressed(weights);
    return size;
}

}  // namespace mien
