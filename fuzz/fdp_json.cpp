// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "mien/io/fdp_json.hpp"

#include "fuzz.hpp"

#include "mien/algorithms/deform.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace mien;
    return fuzz::run(data, size, parse_fdp_json, [](const Fdp& fdp) {
        check_fat(fdp.fat, vertex_count(fdp.mesh));
        for (const std::uint32_t v : fdp.mesh.face_vertices)
            fuzz::expect(v < vertex_count(fdp.mesh), "vertices in range");
        FapFrame frame;
        frame.mask.set();
        frame.value.fill(-600);
        std::vector<Vec3f> positions(vertex_count(fdp.mesh));
        deform(fdp.fat, fdp.mesh.positions, frame, positions);
        const std::string text = format_fdp_json(fdp);
        const Fdp again = parse_fdp_json(std::as_bytes(std::span<const char>(text)));
        fuzz::expect(format_fdp_json(again) == text, "what is written reads back equal");
    });
}
