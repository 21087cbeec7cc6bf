// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/io/fdp_text.hpp"

#include "fuzz.hpp"

#include "mien/algorithms/deform.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace mien;
    return fuzz::run(
        data, size, [](std::span<const std::byte> bytes) { return parse_fdp_text(bytes); },
        [](const Fdp& fdp) {
            check_fat(fdp.fat, vertex_count(fdp.mesh));
            for (const std::uint32_t v : fdp.mesh.face_vertices)
                fuzz::expect(v < vertex_count(fdp.mesh), "vertices in range");
            fuzz::expect(fdp.mesh.corner_uvs.empty() || fdp.mesh.corner_uvs.size() == fdp.mesh.face_vertices.size(),
                         "a texture coordinate per corner");
            FapFrame frame;
            frame.mask.set();
            frame.value.fill(600);
            frame.viseme = {1, 2, 40, false};
            std::vector<Vec3f> positions(vertex_count(fdp.mesh));
            deform(fdp.fat, fdp.mesh.positions, frame, positions);
            std::string text;
            try {
                text = format_fdp_text(fdp);
            } catch (const Error&) {
                return;  // a unit is missing, or nodes have other vertices than a tree of shapes can say
            }
            const Fdp again = parse_fdp_text(std::as_bytes(std::span<const char>(text)));
            fuzz::expect(again.fat.tables.size() == fdp.fat.tables.size(), "tables come back");
            for (std::size_t t = 0; t < fdp.fat.tables.size(); ++t)
                for (std::size_t m = 0; m < fdp.fat.tables[t].meshes.size(); ++m)
                    fuzz::expect(
                        again.fat.tables[t].meshes[m].displacements == fdp.fat.tables[t].meshes[m].displacements,
                        "displacements come back equal");
        });
}
