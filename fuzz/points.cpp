// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/io/points.hpp"

#include <array>
#include <cmath>

#include "fuzz.hpp"

namespace {

// Two meshes, the second with two primitives.
mien::Mesh two_triangles() {
    mien::Mesh mesh;
    for (int i = 0; i < 6; ++i) mesh.positions.push_back({static_cast<float>(i), static_cast<float>(i % 3 == 1), 0});
    mien::add_face(mesh, std::array<std::uint32_t, 3>{0, 1, 2});
    mien::add_face(mesh, std::array<std::uint32_t, 3>{3, 4, 5});
    mesh.parts = {{"eye", 0, 0, 0, 3, 0, 1}, {"head", 1, 0, 3, 2, 1, 1}, {"head", 1, 1, 5, 1, 2, 0}};
    return mesh;
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace mien;
    const Mesh mesh = two_triangles();
    const auto parse = [&](std::span<const std::byte> bytes) { return parse_points(bytes, mesh); };
    return fuzz::run(data, size, parse, [&](const PointsFile& file) {
        fuzz::expect(!file.points.empty(), "points");
        for (const FeaturePoint& point : file.points)
            fuzz::expect(point.vertex < vertex_count(mesh) && std::isfinite(point.snapped), "a vertex of the mesh");
        const PointsFile again = parse(std::as_bytes(std::span<const char>(format_points(file.points))));
        fuzz::expect(again.points.size() == file.points.size(), "what is written reads back equal");
    });
}
