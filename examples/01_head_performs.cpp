// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// A head performs a take: the whole film. usage: 01_head_performs HEAD POINTS TAKE MAP OUT.glb

#include <cstdio>

#include "mien/algorithms/head.hpp"
#include "mien/algorithms/retarget.hpp"
#include "mien/algorithms/rig_biharmonic.hpp"
#include "mien/algorithms/skin.hpp"
#include "mien/error.hpp"
#include "mien/io/gltf.hpp"
#include "mien/io/read.hpp"
#include "mien/io/write.hpp"

int main(int argc, char** argv) try {
    if (argc != 6) return std::fputs("usage: 01_head_performs HEAD POINTS TAKE MAP OUT.glb\n", stderr), 2;
    const mien::Face face = mien::read_face(argv[1], argv[2]);
    const mien::Take captured = mien::rename_points(mien::read_take(argv[3]), mien::read_marker_map(argv[4]));
    const mien::Take still = mien::remove_head_motion(captured);

    // The performer's points become this head's points, and only those that move hold the skin.
    const mien::Take onto = mien::retarget(mien::fit_retarget(still, face), still);
    const mien::Rig rig = mien::rig_biharmonic(mien::with_points(face, onto.points));
    const mien::Skin skin = mien::make_skin(rig, onto);

    mien::write_file(argv[5], mien::format_glb(face.mesh, rig, skin, onto), {.overwrite = true});
    std::printf("%zu points move %zu vertices, %.2g off at most\n", rig.points.size(), vertex_count(rig),
                skin.max_error);
} catch (const mien::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
