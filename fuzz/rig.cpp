// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "fuzz.hpp"
#include "glb_mutator.hpp"
#include "io/promise.hpp"

#include "mien/io/gltf.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace mien;
    return fuzz::run(data, size, parse_rig, [](const RigFile& file) {
        fuzz::expect(hostile::keeps_promise(file.mesh), "indices and numbers of the head");
        fuzz::expect(file.mesh.positions.size() == file.rig.rest.size(), "a head of as many vertices as the rig");
        fuzz::expect(file.rig.row_starts.back() == file.rig.weights.size(), "rows that hold all weights");
        for (const std::uint16_t point : file.rig.row_points) fuzz::expect(point < file.rig.points.size(), "points");
        if (file.rig.prior)
            fuzz::expect(hostile::keeps_promise(*file.rig.prior, file.rig), "a prior that can be solved");
    });
}
